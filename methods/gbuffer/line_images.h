#pragma once

#include <array>

#include "lines/surface_walk.h"
#include "methods/gbuffer/gbuffer_images.h"

// The operators' images become an image of lines for each class.

namespace burin {

/// How strong the line of each class is at each sample, 0..1. Empty: no operator draws that class.
using LineImages = std::array<Raster<float>, kLineClassCount>;

/// What the operators of a scene need to know.
struct DetectionContext {
    const Frame& frame;
    int samples_per_pixel;
    DepthScale scale;
};

/// How many samples more than asked for detect_lines() needs on every side of the G-buffer.
int detection_margin(const Frame& frame, int samples_per_pixel);

/// Runs the operators that the scene asks for on the G-buffer, widens their lines, and sorts them
/// into classes: a jump of depth is a silhouette, a bend of depth or normal a crease, differing
/// numbers are object, material and polygon lines. Beside the background, bends and differing
/// numbers of objects are silhouettes. `samples` is what is asked for.
LineImages detect_lines(const GBuffer& g, const DetectionContext& context, PixelRect samples);

}  // namespace burin
