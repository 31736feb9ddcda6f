#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <utility>
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
        glm::vec3 a{0.0f}, b{0.0f};
    };

    BorderIndex() = default;
    explicit BorderIndex(std::vector<Segment> segments);

    std::span<const Segment> segments() const { return segments_; }

    /// The border edge of another polygon that runs along `half_edge` at the point `at` on it, if
    /// there is one: nearly parallel, and nearer than 1/20 of the edge's length, which covers the
    /// gaps between two different tessellations of one curve.
    std::optional<HalfEdge> seam_partner(HalfEdge half_edge, const glm::dvec3& at) const;

  private:
    using Cell = std::array<std::int64_t, 3>;
    Cell cell_of(const glm::dvec3& p) const;

    std::vector<Segment> segments_;  // by half-edge
    glm::dvec3 low_{0.0};
    double cell_size_ = 1;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> places_;  // (cell's key, segment), sorted
};

}  // namespace burin
