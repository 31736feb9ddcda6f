#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace burin {

using HalfEdge = std::uint32_t;

/// Finds border edges of a mesh by place.
///
/// Patches of CAD models are often tessellated one by one: their common boundary is then a pair of
/// borders that nearly coincide, without a shared vertex. Such a *seam* is no border to anyone who
/// looks at the model.
class BorderIndex {
  public:
    struct Segment {
        HalfEdge half_edge = 0;
        std::uint32_t polygon = 0;
        glm::dvec3 a{0.0}, b{0.0};
    };

    BorderIndex() = default;
    explicit BorderIndex(std::vector<Segment> segments);

    std::span<const Segment> segments() const { return segments_; }
    /// The numbers of all segments, those near each other mostly one after the other: for whoever asks what is near each.
    std::span<const std::uint32_t> by_place() const { return order_; }

    /// The border edge of another polygon that runs along `half_edge` at the point `at` on it, if
    /// there is one: nearly parallel, and nearer than 1/20 of the edge's length, which covers the
    /// gaps between two different tessellations of one curve.
    std::optional<HalfEdge> seam_partner(HalfEdge half_edge, const glm::dvec3& at) const;

    /// What seam_partner() chooses from along one edge, wherever the point lies.
    class SeamCandidates {
      public:
        std::optional<HalfEdge> nearest(const glm::dvec3& at) const;
        std::span<const Segment> segments() const { return segments_; }

      private:
        friend class BorderIndex;
        double reach_ = 0;
        std::vector<Segment> segments_;
    };
    void find_candidates(HalfEdge half_edge, SeamCandidates& candidates) const;

    /// Adds the numbers of the segments whose boxes may touch a box, in no order that means anything.
    void find_in_box(const glm::dvec3& low, const glm::dvec3& high, std::vector<std::uint32_t>& found) const;

  private:
    /// A box around segments: those at [first, first + count) of order_ (a leaf), or all of its
    /// children's, which are nodes `first` and `first + 1` (count 0).
    struct Node {
        glm::vec3 low{0.0f}, high{0.0f};
        std::uint32_t first = 0, count = 0;
    };
    const Segment* find(HalfEdge half_edge) const;
    /// Calls visit(number of a segment) for all in boxes that may_be_near(low, high).
    template <typename MayBeNear, typename Visit>
    void visit_leaves(const MayBeNear& may_be_near, const Visit& visit) const;
    /// Calls visit(segment) for those of other polygons that are nearly parallel to `own` and whose boxes
    /// may_be_near(low, high).
    template <typename MayBeNear, typename Visit>
    void search(const Segment& own, const MayBeNear& may_be_near, const Visit& visit) const;
    struct Place {
        glm::vec3 middle;  // twice that
        std::uint32_t segment;
    };
    void build(std::uint32_t node, std::uint32_t first, std::span<Place> places);

    std::vector<Segment> segments_;  // by half-edge
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace burin
