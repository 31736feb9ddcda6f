#pragma once

#include <span>

#include "mesh/box.h"
#include "view/surface_set.h"

namespace burin {

/// Sets what depends on how far the surfaces of a frame reach: how exact their coordinates are,
/// where the near plane is, and what nearness is relative to. Instances and the projection are
/// known. `view_boxes`: around each instance, in view space. `eye_distance`: of the eye from the
/// world's origin.
///
/// One number for the whole scene does for most. In a scene that is much larger than some of its
/// objects, such as a part on a huge ground or beside a marker far away, it would blur these
/// objects or cut them off; there it is found from the meshes.
void set_reach(SurfaceSet& surfaces, std::span<const Box> view_boxes, double eye_distance, glm::dvec2 picture_px);

}  // namespace burin
