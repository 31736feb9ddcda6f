#pragma once

#include <glm/glm.hpp>

#include "view/surface_set.h"

namespace burin {

/// How far the point of a triangle that is seen at a place on the screen, in pixels, moves on the screen until the next
/// frame: x to the right, y up. `next`: the same surfaces then, seen through the camera of then. What goes behind the
/// eye does not move.
glm::vec2 motion_at(const SurfaceSet& now, const SurfaceSet& next, SurfaceId surface, glm::dvec2 place);

}  // namespace burin
