#pragma once

#include "lines/drawing_needs.h"
#include "scene/scene.h"

namespace burin {

struct SheetNeeds;

/// Says what must be found so that the lines of a scene can be drawn as it wants them: all that finding is told of
/// their looks.
DrawingNeeds needs_of(const Scene& scene);
/// The same for a scene whose lines look as a style sheet says.
DrawingNeeds needs_of(const Scene& scene, const SheetNeeds& sheet);

}  // namespace burin
