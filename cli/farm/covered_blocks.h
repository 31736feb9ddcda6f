#pragma once

#include <cstdint>

#include "render/frame.h"

namespace burin {

/// How much of a picture has surfaces in front of its background, in the blocks of pixels that films and mattes are
/// made of: counted are whole blocks that a triangle reaches into.
struct CoveredBlocks {
    std::uint64_t pixels = 0;       ///< of all blocks
    std::uint64_t band_pixels = 0;  ///< of the fullest row of blocks
};

/// Looks at all triangles.
CoveredBlocks covered_blocks(const Frame& frame);

}  // namespace burin
