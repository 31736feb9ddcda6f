#pragma once

#include "output/paths/surface_grid.h"
#include "render/method.h"
#include "scene/scene.h"

namespace burin {

/// Whether the surfaces of a scene have a look other than paper or none, so that vector files have them as filled
/// regions.
bool surfaces_have_look(const Scene& scene);

/// Sees the surfaces of a scene on a grid that is up to three times as fine as pixels. `area`: of the picture. The
/// scene is as before when it returns.
SurfaceGrid seen_surfaces(Scene& scene, const Camera& camera, PixelRect area, const RunOptions& run);

}  // namespace burin
