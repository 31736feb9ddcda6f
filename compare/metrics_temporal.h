#pragma once

#include <optional>
#include <vector>

#include "compare/plane.h"

// Frames of a moving camera are compared with the truth's frames.

namespace burin {

/// What changes from frame to frame that should not, while the camera moves by parts of a pixel.
struct Flicker {
    /// Per pixel the standard deviation over the frames of (result - truth), averaged over the
    /// pixels that are within a pixel of a line of the truth in any frame.
    double flicker_sd = 0;
    /// Standard deviation over the frames of the result's total coverage, divided by its mean.
    /// Nothing if the result is empty.
    std::optional<double> energy_sd;
    /// The largest jump of a pixel from one frame to the next beyond the truth's jump there.
    double pop = 0;
};

/// Measures the flicker of a result against the truth, which both have a picture per frame, all of one size. Nothing
/// for fewer than two frames or a truth without lines.
std::optional<Flicker> flicker(const std::vector<Plane>& result, const std::vector<Plane>& truth);

/// Sum of all values.
double total_coverage(const Plane& plane);

}  // namespace burin
