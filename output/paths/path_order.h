#pragma once

#include "output/paths/vector_drawing.h"

// What plotters and cutters ask of a finished drawing.

namespace burin {

/// Joins paths of one look and group whose ends are at one place, to one path.
void merge_paths(VectorDrawing& drawing);

/// How far a pen travels between paths, in pixels, before and after paths were put in another order.
struct PenTravel {
    double before_px = 0, after_px = 0;
};
/// Puts the paths of each group in an order in which a pen travels less between them: always the path that begins or
/// ends nearest to where the pen is, drawn from there. Patterns of dashes keep their direction.
PenTravel sort_for_pen(VectorDrawing& drawing);

/// What make_opaque() has done, in paths.
struct OpaquePaths {
    std::size_t solid = 0, left_out = 0;
};
/// For each group: half of the strongest opacity of its set, of visible or of hidden lines. What is paler fades away
/// where nothing is grey.
std::vector<float> least_opacities(const VectorDrawing& drawing);
/// Leaves out paths that fade away, and makes all others opaque: for readers and pens that take no grey.
OpaquePaths make_opaque(VectorDrawing& drawing);

/// Gives all strokes one width, without dashes and opacity. Outlines become strokes, too.
void make_hairlines(double width_px, VectorDrawing& drawing);

}  // namespace burin
