#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "image/image.h"

// A strip hands some rows of a film to the writer without copying them, and says which blocks are background.

namespace burin {

/// Rows of a picture as blocks side by side. Blocks may be missing: all of their pixels are background.
struct ImageStrip {
    using PixelBytes = std::array<std::byte, 4>;  ///< in the order of memory; half numbers have the first two

    PixelRect data;                      ///< of all blocks
    int block_width = 0;                 ///< the last one may be narrower
    std::vector<const Image*> blocks;    ///< from the left, nullptr where one is missing; each has all rows
    std::vector<PixelBytes> background;  ///< of each channel; may be empty if no block is missing
};

/// A whole image is a strip.
inline ImageStrip strip_of(const Image& image) { return {image.data(), image.width(), {&image}, {}}; }

}  // namespace burin
