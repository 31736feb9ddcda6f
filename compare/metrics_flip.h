#pragma once

#include <array>

#include "compare/plane.h"

// Two pictures are compared as eyes see them, by FLIP.

namespace burin {

/// An sRGB-encoded picture, 0..1 per channel.
using ColorPlanes = std::array<Plane, 3>;

/// A difference that an eye may see when it flips between two pictures: Andersson, Nilsson,
/// Akenine-Möller, Oskarsson, Åström, Fairchild, FLIP: A Difference Evaluator for Alternating
/// Images, 2020, for low dynamic range, at 67.02 pixels per degree (a 3840-pixel display, .7 m
/// wide, seen from .7 m). 0 = no difference, 1 = the largest.
struct FlipError {
    double mean = 0;
    double p95 = 0;  ///< 95th percentile over the pixels
    Plane map;
};
FlipError flip_error(const ColorPlanes& result, const ColorPlanes& truth, int threads);

/// The colour part alone, before it is amplified where features differ; for tests.
Plane flip_color_difference(const ColorPlanes& result, const ColorPlanes& truth, int threads);

}  // namespace burin
