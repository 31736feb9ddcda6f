#pragma once

#include <glm/glm.hpp>
#include <span>

#include "render/frame.h"
#include "view/surface_set.h"

namespace burin {

/// How far the point of a triangle that is seen at a place on the screen, in pixels, moves on the screen until the next
/// frame: x to the right, y up. `next`: the same surfaces then, seen through the camera of then. What goes behind the
/// eye does not move.
glm::vec2 motion_at(const SurfaceSet& now, const SurfaceSet& next, SurfaceId surface, glm::dvec2 place);

/// The surfaces of a frame one frame later. `to_world`: of each object, or nothing if none moves; `meshes`: of each
/// object that deforms, else nullptr. A mesh that has not the triangles of the one that is drawn is not taken.
SurfaceSet surfaces_later(const Frame& frame, std::span<const glm::dmat4> to_world, std::span<const Mesh* const> meshes,
                          const Camera& camera);

}  // namespace burin
