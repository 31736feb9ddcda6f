#pragma once

#include "lines/drawing_needs.h"
#include "scene/scene.h"

namespace burin {

/// What the looks of a scene's lines need to be drawn.
DrawingNeeds needs_of(const Scene& scene);

}  // namespace burin
