#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "abuffer/screen/screen_surfaces.h"
#include "kernels/tile_kernels.h"

// A count of triangles that shows, before they are sorted to the cells of a block, that each cell will get too many.

namespace burin {

/// Counts the triangles, none of them clipped, that cover a whole block, whose upper left corner is given in 1/256
/// pixel. Each cell of the block has at least so many.
std::size_t count_covering(const ScreenSurfaces& screen, const std::vector<CrossedTriangle>& triangles,
                           glm::ivec2 corner);

}  // namespace burin
