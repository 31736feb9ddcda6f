#pragma once

#include <vector>

#include "abuffer/tile_kernels.h"

namespace burin::test {

/// For each set of instructions that this processor has.
inline std::vector<const TileKernels*> all_kernels() {
    std::vector<const TileKernels*> result{&baseline_kernels()};
    if (avx2_kernels() != nullptr) result.push_back(avx2_kernels());
    return result;
}

}  // namespace burin::test
