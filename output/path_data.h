#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "output/paths/vector_drawing.h"

namespace burin {

/// A number of hundredths as text, as short as it can be: "12", "-.5".
std::string text_of_hundredths(long long hundredths);
/// A number with up to four decimals.
std::string short_number(double value, int decimals = 4);

/// Dashes as viewers cut them: lengths of dashes and gaps in turn, and where in them a path begins.
struct DashPattern {
    std::vector<double> lengths;
    double phase = 0;
};
/// Round ends belong to a dash: it is shorter by the width of the pen, and a dash that is no longer is a dot.
DashPattern dash_pattern(const VectorStyle& style, float phase_px);

/// The value of SVG's attribute `d`: relative commands between points that are rounded to 1/100, so that errors do not
/// add up.
std::string path_data(const VectorPath& path, std::span<const PathStep> steps);

}  // namespace burin
