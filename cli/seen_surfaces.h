#pragma once

#include "cli/arguments.h"
#include "output/paths/surface_grid.h"
#include "render/method.h"
#include "scene/scene.h"

namespace burin {

/// Whether a vector file has the surfaces of a scene as filled regions: where they have a look other than paper or
/// none, and the page is no one of lines alone.
bool draws_regions(const Scene& scene, const Arguments& arguments);

/// Sees the surfaces of a scene on a grid that is up to three times as fine as pixels. `area`: of the picture. The
/// scene is as before when it returns.
SurfaceGrid seen_surfaces(Scene& scene, const Camera& camera, PixelRect area, const RunOptions& run);

}  // namespace burin
