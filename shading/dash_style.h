#pragma once

#include <array>
#include <optional>

#include "shading/line_style.h"

// Dashes too short to be seen become a solid line of less strength.

namespace burin {

/// DashStyle says how dashes are drawn. Dashes with a period below half a pixel cannot be seen, and there would be any
/// number of them: they are drawn as a solid line that lets through what the gaps do.
struct DashStyle {
    std::optional<std::array<double, 2>> dash_px;  ///< that are laid out along lines; none: lines are drawn solid
    double opacity = 1;                            ///< of such a solid line
};

DashStyle visible_dashes(const LineStyle& style);
/// The dashes of hidden lines; none where these are not dashed.
DashStyle hidden_dashes(const LineStyle& style);

/// The share of a solid line's ink that dashes have which are drawn one by one, with the round ends of a pen.
double ink_of_dashes(std::array<double, 2> dash_px, double width_px);

}  // namespace burin
