#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "abuffer/screen/screen_surfaces.h"
#include "kernels/tile_kernels.h"

// Heaps of large triangles are told before they are sorted.

namespace burin {

/// How many triangles, none of them clipped, lie over all of a block whose corner is given, in 1/256 pixel. So many are
/// in each of its cells at least.
std::size_t count_covering(const ScreenSurfaces& screen, const std::vector<CrossedTriangle>& triangles,
                           glm::ivec2 corner);

}  // namespace burin
