#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

// Methods that draw polygons need their outlines, which meshes keep as triangles only.

namespace burin {

/// The polygons of a mesh, put together again from their triangles.
class PolygonOutlines {
  public:
    explicit PolygonOutlines(const Mesh& mesh);

    /// The half-edges around a polygon, one after the other as they run around it; where a polygon
    /// has holes, loop after loop. Diagonals between its triangles are left out.
    std::span<const HalfEdge> outline(std::uint32_t polygon) const {
        return part(half_edges_, first_half_edge_, polygon);
    }
    std::span<const std::uint32_t> triangles(std::uint32_t polygon) const {
        return part(triangles_, first_triangle_, polygon);
    }
    std::uint32_t polygon_count() const { return static_cast<std::uint32_t>(first_triangle_.size()) - 1; }

    /// The triangle of the same polygon on the other side of a diagonal; kNoHalfEdge if `h` lies on
    /// the outline of its polygon.
    static HalfEdge across_diagonal(const Mesh& mesh, HalfEdge h);

  private:
    static std::span<const std::uint32_t> part(const std::vector<std::uint32_t>& all,
                                               const std::vector<std::uint32_t>& first, std::uint32_t polygon) {
        return std::span(all).subspan(first[polygon], first[polygon + 1] - first[polygon]);
    }

    std::vector<std::uint32_t> triangles_, first_triangle_;
    std::vector<HalfEdge> half_edges_;
    std::vector<std::uint32_t> first_half_edge_;
};

}  // namespace burin
