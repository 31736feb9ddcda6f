#pragma once

#include <string>

#include "output/paths/surface_grid.h"
#include "output/paths/vector_drawing.h"

namespace burin {

/// Adds what is seen of surfaces as filled regions, below all that is in a drawing: a group for each object, and in it
/// a path for each of its colours, with holes. The edge between two regions is found once, so that they have the same
/// one; it is no farther from places on its wrong side than the grid's places are from each other. Opaque
/// regions have a thin stroke of their colour, so that viewers leave no light between neighbours.
void add_surface_regions(const SurfaceGrid& grid, VectorDrawing& drawing);

/// What users should know of objects that have their mean colour; empty: none has.
std::string note_on_means(const SurfaceGrid& grid);

}  // namespace burin
