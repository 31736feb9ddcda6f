#pragma once

#include <optional>

#include "compare/plane.h"

// Two pictures are compared by their structure, at one scale or several.

namespace burin {

/// Structural similarity of two pictures with values 0..1: Wang, Bovik, Sheikh, Simoncelli, Image
/// Quality Assessment: From Error Visibility to Structural Similarity, 2004. Gaussian window 11x11,
/// sigma 1.5, K1 = .01, K2 = .03; the mean over all windows that lie within the picture. 1 = equal.
/// Nothing for pictures smaller than a window.
std::optional<double> ssim(const Plane& a, const Plane& b, int threads);

/// Wang, Simoncelli, Bovik, Multi-Scale Structural Similarity for Image Quality Assessment, 2003:
/// five scales with the paper's weights. Nothing for pictures with a side below 176 pixels.
std::optional<double> ms_ssim(const Plane& a, const Plane& b, int threads);

}  // namespace burin
