#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "mesh/near_segment.h"
#include "mesh/segment_tree.h"

// In heaps of long segments, those that run the same way are found without a look at all others.

namespace burin {

/// Short pieces of segments, in a tree per class of directions. Boxes lie along their class's direction, so they are
/// thin, and few of them lie over each other where thousands of segments cross.
class DirectedSegments {
  public:
    struct Ends {
        glm::dvec3 a, b;
    };

    /// Segments run along each other if the cosine of the angle between them is larger.
    static constexpr double kCosParallel = 0.9;

    DirectedSegments() = default;
    explicit DirectedSegments(std::span<const Ends> segments);

    bool is_empty() const { return classes_.empty(); }

    /// Calls visit(number) for all segments that come as near to the one from `a` to `b` as `margin`, and for others,
    /// some of them several times, until it says false.
    template <typename Visit>
    void visit_near(const glm::dvec3& a, const glm::dvec3& b, double margin, const Visit& visit) const {
        bool goes_on = true;
        for (const Class& c : classes_) {
            if (!goes_on) return;
            c.tree.visit_leaves(NearSegment{c.turn * a, c.turn * b, margin},
                                [&](std::uint32_t i) { return goes_on = visit(i); });
        }
    }

    /// The same, of segments along `direction`, whose length is 1, and of others.
    template <typename Visit>
    void visit_along(const glm::dvec3& direction, const glm::dvec3& a, const glm::dvec3& b, double margin,
                     const Visit& visit) const {
        bool goes_on = true;
        for (const Class& c : classes_) {
            if (!c.may_run_along(direction)) continue;
            c.tree.visit_leaves(NearSegment(c.turn * a, c.turn * b, margin),
                                [&](std::uint32_t i) { return goes_on = visit(i); });
            if (!goes_on) return;
        }
    }

    /// Calls visit(number) for all segments along `direction`, whose length is 1, that may be as near to a point as
    /// `reach`, which visit() may lower meanwhile; and for others.
    template <typename Visit>
    void visit_nearest(const glm::dvec3& direction, const glm::dvec3& at, const double& reach,
                       const Visit& visit) const {
        for (const Class& c : classes_) {
            if (c.may_run_along(direction)) c.tree.visit_nearest(c.turn * at, reach, visit);
        }
    }
    /// The same, but for segments farther than `radius` from the way between two places.
    template <typename Visit>
    void visit_nearest(const glm::dvec3& direction, const glm::dvec3& at, const double& reach, const glm::dvec3& from,
                       const glm::dvec3& to, double radius, const Visit& visit) const {
        for (const Class& c : classes_) {
            if (!c.may_run_along(direction)) continue;
            c.tree.visit_nearest(c.turn * at, reach, NearSegment{c.turn * from, c.turn * to, radius}, visit);
        }
    }

  private:
    /// Segments of similar directions, with their opposites.
    struct Class {
        glm::dmat3 turn{1.0};      ///< to axes of which the first is in the middle of the directions
        double least_cosine = -1;  ///< of the angle between that and whatever runs along a segment of the class
        SegmentTree tree;          ///< of turned pieces

        bool may_run_along(const glm::dvec3& direction) const { return std::abs((turn * direction).x) >= least_cosine; }
    };

    std::vector<Class> classes_;
};

}  // namespace burin
