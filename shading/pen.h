#pragma once

#include <algorithm>
#include <cmath>

#include "kernels/stroke_samples.h"
#include "shading/line_style.h"

// A width becomes the radius and the strength that a stroke is drawn with.

namespace burin {

/// What a stroke of a given width is drawn with.
struct Pen {
    /// Narrower strokes are drawn this wide and as much lighter: masks have no finer samples.
    static constexpr double kFinestWidthPx = 0.25;
    /// Below a pixel, widths are whole steps of the samples along the rows, and lighter by what that adds: else such a
    /// stroke would have the energy of one step more or less.
    static constexpr double kStepsPerPx = kStrokeRows * kStrokeColumnSets;

    double radius_px;
    float strength;

    /// Makes the pen for a width; for a stroke on one side, the half of the width that is drawn counts.
    explicit Pen(double width_px, StrokeSide side = StrokeSide::both, double opacity = 1) {
        const double share = side == StrokeSide::both ? 1.0 : 0.5;
        const double wanted = share * width_px;
        const double drawn =
            wanted < 1 ? std::max(std::ceil(wanted * kStepsPerPx) / kStepsPerPx, kFinestWidthPx) : wanted;
        radius_px = 0.5 * drawn / share;
        strength = static_cast<float>(opacity * (wanted / drawn));
    }
};

}  // namespace burin
