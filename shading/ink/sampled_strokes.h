#pragma once

#include <span>
#include <vector>

#include "shading/ink/stroke_path.h"
#include "shading/ink/stroke_values.h"

namespace burin {

/// A stretch of a line as a path with its ink, moved to where the style wants it, not cut yet.
struct SampledStroke {
    LineStretch stretch;
    ChainValues chain;
    StrokePath path;
    bool is_moved = false;  ///< it does not lie where the line is
};

/// Evaluates a style for stretches of lines: at the ends of pieces, at most 8 pixels apart, then in halves wherever
/// what is evaluated at shares 0.23, 0.5 and 0.81 of an interval leaves the straight line between its ends, down to 1/4
/// pixel. All that is evaluated at a time is one batch.
std::vector<SampledStroke> sample_strokes(const LineColumns& lines, std::span<const LineStretch> stretches,
                                          StrokeValues& values);

}  // namespace burin
