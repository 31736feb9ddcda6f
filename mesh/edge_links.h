#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

// Triangles learn of their neighbours: half-edges on one edge are linked to a ring.

namespace burin {

/// Links the half-edges of triangles that join the same two vertices into rings, in increasing
/// order (see Mesh::next_on_edge). Winding plays no part. The time is linear in the number of triangles,
/// times a logarithm where very many meet at few vertices.
///
/// `has_twins`, if given, is set to whether a triangle has the same three vertices as an earlier one; true
/// also where very many triangles meet at an edge and it takes more than a look to tell.
std::vector<HalfEdge> link_edges(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertex_count,
                                 bool* has_twins = nullptr);

/// The border edges of a mesh that is linked.
BorderIndex index_borders(const Mesh& mesh);

}  // namespace burin
