#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/moving_vertices.h"
#include "mesh/polygon_mesh.h"
#include "mesh/polygon_soup.h"
#include "mesh/round_positions.h"

// Edges that a file marks become marks of polygons' edges, or loose edges if no polygon has them.

namespace burin {

/// The edges that a file marks, each once, and which of them are an edge of a polygon of any
/// object. The others are lines by themselves (docs/decisions/0016-loose-lines.md).
class MarkedEdges {
  public:
    /// `welded`: per vertex of the soup the number of the first one at its place. Marks without
    /// length are left out.
    MarkedEdges(const PolygonSoup& soup, const std::vector<std::uint32_t>& welded);

    bool empty() const { return marks_.empty(); }
    /// Calls visit(number of the mark, its other vertex) for those whose smaller vertex is
    /// `vertex`.
    template <typename Visit>
    void for_marks_from(std::uint32_t vertex, const Visit& visit) const {
        for (std::size_t i = first_from(vertex); i < marks_.size() && marks_[i].vertices[0] == vertex; ++i)
            visit(i, marks_[i].vertices[1]);
    }
    void note_polygon_has(std::size_t mark) { is_of_polygon_[mark] = true; }

    struct Mark {
        std::array<std::uint32_t, 2> vertices;  ///< welded, the smaller one first
        std::uint32_t object;
        auto operator<=>(const Mark&) const = default;
    };
    /// The edges that no polygon has, object by object, once all polygons are looked at.
    std::vector<Mark> loose_edges() const;

  private:
    std::size_t first_from(std::uint32_t vertex) const;

    std::vector<Mark> marks_;  // sorted
    std::vector<bool> is_of_polygon_;
};

/// Gives a mesh the loose edges of its object, with the vertices that it lacks. `rounded`: the soup's. `moving`: gets
/// where these come from; nullptr: nobody asks.
void add_loose_edges(std::span<const MarkedEdges::Mark> edges, const RoundedPositions& rounded, Mesh& mesh,
                     MovingVertices* moving = nullptr);

/// Which of a mesh's marked edges are edges of its polygons, before it is triangulated.
std::vector<bool> marks_of_polygons(const PolygonMesh& polygons);
/// Marks the half-edges of a triangulated mesh, and tells which marks have one.
std::vector<bool> mark_half_edges(const PolygonMesh& polygons, Mesh& mesh);

}  // namespace burin
