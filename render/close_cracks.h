#pragma once

#include "render/replaced_meshes.h"
#include "scene/camera.h"
#include "scene/scene.h"

namespace burin {

/// Closes the cracks of all meshes that are narrower than a pixel, as the camera sees them in a picture of this size,
/// see stitch_cracks(): nobody can tell them from a surface, but samples that fall into them would be dots. A mesh that
/// several objects have is closed where that holds for all but those wholly behind the eye. An edge that passes the eye
/// stays as it is. To be called before anything is made for the scene's meshes.
/// `threads`: 0 = all cores. `replaced`: gets what they were before.
void close_cracks(Scene& scene, const Camera& camera, int width, int height, int threads,
                  ReplacedMeshes* replaced = nullptr);

}  // namespace burin
