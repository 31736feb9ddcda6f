#pragma once

#include "base/byte_sink.h"
#include "image/display_image.h"

namespace burin {

/// Writes a PNG of 8 or 16 bits per channel, marked as sRGB. Throws std::runtime_error with what libpng says, and
/// what writing to the file throws.
void write_png(ByteSink& file, const DisplayImage& image, int bits);

}  // namespace burin
