#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/polygon_mesh.h"

// Polygons that a file has twice are found, so that each surface is there once.

namespace burin {

/// The polygons with the same edges as an earlier one, whatever their winding and first corner, in
/// increasing order. `mesh` has the triangles of `polygons`, linked; if all polygons are triangles,
/// `polygons` is not looked at.
std::vector<std::uint32_t> find_duplicates(const PolygonMesh& polygons, const Mesh& mesh);

}  // namespace burin
