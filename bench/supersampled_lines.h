#pragma once

#include "compare/render_lines.h"

namespace burin::bench {

/// What plain supersampling makes of lines between flat polygons: samples of the picture with
/// `samples` x `samples` times its pixels, one surface each; a boundary half way between neighbours
/// with different polygons; a pixel's coverage is the share of its samples within half a line's
/// width of a boundary. For scenes in which all that lies between polygons is a line.
Plane supersampled_lines(const Scene& scene, const ComparedView& view, int samples);

}  // namespace burin::bench
