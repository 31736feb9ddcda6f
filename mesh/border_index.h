#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "mesh/directed_segments.h"
#include "mesh/point_tree.h"
#include "mesh/segment_tree.h"

// Walks over seams, and the closing of cracks, ask which borders are near a place.

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
    /// The numbers of all segments, those near each other mostly one after the other: for whoever asks what is near
    /// each.
    std::span<const std::uint32_t> by_place() const { return whole_.segments(); }

    /// The border edge of another polygon that runs along `half_edge` at the point `at` on it, if
    /// there is one: nearly parallel, and nearer than 1/20 of the edge's length, which covers the
    /// gaps between two different tessellations of one curve. Where borders lie in a heap, so that
    /// more than four of other polygons are in that reach of an edge on average, the reach is halved
    /// until they are fewer.
    std::optional<HalfEdge> seam_partner(HalfEdge half_edge, const glm::dvec3& at) const;

    /// A straight line through a place, and what is seen near it: nearer than `radius` at the place, and than `radius`
    /// + d * `growth` at the distance d from it.
    struct Sight {
        glm::dvec3 direction{0.0};  ///< its length is 1
        double radius = 0, growth = 0;
    };
    /// Finds the seam partner for a caller that has no use for one that is not seen near the place: returns nothing
    /// only if it is not. Where borders lie in a heap, that is much faster: of all borders in reach, few are seen near
    /// the place.
    std::optional<HalfEdge> seam_partner(HalfEdge half_edge, const glm::dvec3& at, const Sight& sight) const;

    /// How near a partner must be, in lengths of the edge.
    double reach_part() const { return reach_part_; }
    /// Whether any edge may have a partner: not where all borders are one polygon's.
    bool has_partners() const { return reach_part_ > 0; }

    /// Whether segments lie over each other by the dozen, so that many come near an edge.
    bool has_crowds() const { return !directed_.is_empty(); }

    /// What seam_partner() chooses from along one edge, or a part of it, wherever the point lies on that.
    class SeamCandidates {
      public:
        std::optional<HalfEdge> nearest(const glm::dvec3& at) const;
        std::span<const Segment> segments() const { return segments_; }

      private:
        friend class BorderIndex;
        double reach_ = 0;
        std::vector<Segment> segments_;
    };
    /// Lists the candidates whose boxes are within reach of the box of the edge. Returns false, and lists none, if
    /// there are more than `most` segments there, of any direction.
    bool find_candidates(HalfEdge half_edge, std::size_t most, SeamCandidates& candidates) const;
    /// Lists the candidates that are within reach of the edge itself. Returns false, and lists none, if there are more
    /// than `most` segments there, of any direction; `most` is at most kMostNear.
    static constexpr std::size_t kMostNear = 256;
    bool find_near(HalfEdge half_edge, std::size_t most, SeamCandidates& candidates) const;
    /// The same, but returns false only if there are more than `most` that may be partners: in a heap most that come
    /// near an edge cross it.
    bool find_along(HalfEdge half_edge, std::size_t most, SeamCandidates& candidates) const;
    /// A part of an edge, in shares of it.
    struct Stretch {
        double begin = 0, end = 1;
    };
    bool find_along(HalfEdge half_edge, Stretch stretch, std::size_t most, SeamCandidates& candidates) const;

    /// Adds the numbers of the segments whose boxes may touch a box, in no order that means anything.
    void find_in_box(const glm::dvec3& low, const glm::dvec3& high, std::vector<std::uint32_t>& found) const;

  private:
    const Segment* find(HalfEdge half_edge) const;
    struct Nearest;
    void find_nearest(const Segment& own, const glm::dvec3& at, Nearest& nearest) const;
    bool is_crowded() const;
    template <typename Visit>
    void visit_boxes(const glm::dvec3& low, const glm::dvec3& high, const Visit& visit) const;
    bool has_several_polygons() const;
    double reach_part_in_crowd() const;
    bool list_near(HalfEdge half_edge, Stretch stretch, std::size_t most, bool counts_partners_only,
                   SeamCandidates& candidates) const;
    template <typename Visit>
    void visit_nearest(const glm::dvec3& direction, const glm::dvec3& at, const double& reach,
                       const Visit& visit) const;

    std::vector<Segment> segments_;  // by half-edge
    double reach_part_ = 0;          // how near a partner must be, in lengths of the edge
    SegmentTree whole_;              // of whole segments
    /// The lowest and the highest corner of the box around each segment, by which boxes that lie over each other are
    /// told apart, as those of needles through a point, which all have one middle. Empty where directed_ is.
    PointTree<6, float> boxes_;
    DirectedSegments directed_;  // where boxes around whole ones lie over each other by the dozen; else empty
};

}  // namespace burin
