#pragma once

#include <algorithm>
#include <cmath>

#include "methods/gbuffer/raster.h"

// Lines of equal value are drawn over the visible surfaces, as by Saito and Takahashi.

namespace burin {

/// Contour lines and curved hatching of Saito & Takahashi 1990: lines of equal value of a scalar
/// field over the visible surfaces (height, distance, ...).

/// How much of a sample one wide is covered by a line `width` wide, `offset` away from its middle,
/// all in samples across the line.
inline double stroke_overlap(double offset, double width) {
    const double low = std::max(offset - 0.5, -0.5 * width), high = std::min(offset + 0.5, 0.5 * width);
    return std::clamp(high - low, 0.0, 1.0);
}

/// Coverage by the lines field = k * step at (x, y), `width` samples wide. The distance to the
/// nearest line is |field / step - round(field / step)| * step / |gradient|, with the gradient by
/// central differences; where that is 0 (a plane of equal value) there is no line.
inline double contour_coverage(const Raster<double>& field, int x, int y, double step, double width) {
    const double along_x = 0.5 * (field.at(x + 1, y) - field.at(x - 1, y));
    const double along_y = 0.5 * (field.at(x, y + 1) - field.at(x, y - 1));
    const double gradient = std::hypot(along_x, along_y);
    const double lines = field.at(x, y) / step;
    const double offset = std::abs(lines - std::round(lines)) * step;
    if (!(gradient > 1e-9 * std::abs(field.at(x, y)) + 1e-30)) return 0;
    return stroke_overlap(offset / gradient, width);
}

}  // namespace burin
