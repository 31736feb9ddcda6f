#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace burin {

/// On which side of each triangle its body is, whichever way it is wound: -1 = behind the side from which it is seen
/// counterclockwise, 1 = in front of that side, 0 = the triangle belongs to no body, but to a sheet.
///
/// Triangles that share an edge of two are of one body; it lies where the volume that they enclose is. Of those that enclose
/// nothing, between edges of more than two triangles, it lies behind the first one as that is wound. Time grows with the number
/// of triangles.
std::vector<std::int8_t> find_body_sides(const Mesh& mesh);

}  // namespace burin
