#pragma once

#include "abuffer/halo_shape.h"
#include "scene/wire_settings.h"

namespace burin {

/// What only the method `patel` looks at.
struct PatelSettings {
    int mask_bits = 64;  ///< 16, 64 or 256
    HaloShape halo = HaloShape::four;
};

}  // namespace burin
