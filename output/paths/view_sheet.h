#pragma once

#include <string>

#include "output/paths/vector_drawing.h"

namespace burin {

/// Adds a view to the drawing of a sheet: both are of the same picture. Layers of hidden lines of all views lie below
/// those of visible ones, unless styles have another order; then views follow one another.
void add_view(VectorDrawing view, const std::string& name, VectorDrawing& sheet);

}  // namespace burin
