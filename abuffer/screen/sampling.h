#pragma once

#include "render/frame.h"

// The number of samples per pixel follows from the scene's settings.

namespace burin {

/// At how many samples along each axis masks decide: what the scene asks for. If it does not, 2, which lines that
/// samples miss make enough (docs/decisions/0007-two-samples.md); 4 for strokes on one side, which are cut off by
/// the strokes around them, so that ends between samples stay open.
inline int samples_per_pixel_of(const Frame& frame) {
    return frame.scene->abuffer.samples.value_or(frame.needs.one_sided ? 4 : 2);
}

/// Whether lines that samples found in part are completed from the mesh's edges. Strokes on one side are cut off by
/// the pieces around them, which would then overlap.
inline bool completes_lines(const Frame& frame) {
    return frame.scene->abuffer.draws_fine_lines() && !frame.needs.one_sided;
}

/// The pixels whose visible lines must be known.
inline PixelRect rect_with_lines(const Frame& frame) { return frame.needs.whole_picture ? frame.reach() : frame.crop; }

}  // namespace burin
