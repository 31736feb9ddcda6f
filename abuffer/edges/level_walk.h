#pragma once

#include <glm/glm.hpp>

#include "abuffer/screen/screen_surfaces.h"
#include "mesh/mesh.h"

// Most walks past an edge go on over surfaces that are plainly level, which a quick walk over snapped vertices tells.

namespace burin {

/// Whether a walk over the edge of two triangles at `h`, from a place on it in the direction `out`, surely gets so far
/// beyond it that walk_to_end() would arrive: nothing on its way is deep enough to be a fold, or turns back. All in
/// 1/256 pixel, `out` of length 1. False where that takes a closer look.
bool surely_goes_on(const ScreenSurfaces& screen, std::uint32_t instance, HalfEdge h, glm::dvec2 from, glm::dvec2 out,
                    double distance);

}  // namespace burin
