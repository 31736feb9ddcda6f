#pragma once

#include <cstdint>

#include "abuffer/halo_shape.h"

namespace burin {

/// Which side of the boundary a stroke is drawn on.
enum class StrokeSide : std::uint8_t {
    both,
    inside,   ///< on the nearer surface only
    outside,  ///< on the farther one only
};

/// How strokes are made from masks.
struct MaskStroke {
    HaloShape shape = HaloShape::four;
    StrokeSide side = StrokeSide::both;
};

}  // namespace burin
