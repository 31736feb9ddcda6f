#pragma once

#include "abuffer/halo_shape.h"

namespace burin {

/// What only the method `patel` looks at.
struct PatelSettings {
    int mask_bits = 64;  ///< 16, 64 or 256
    HaloShape halo = HaloShape::four;
};

/// What only the method `reference` looks at.
struct ReferenceSettings {
    int samples = 16;  ///< rays per pixel and axis, 4 to 64
};

}  // namespace burin
