#pragma once

#include <vector>

#include "kernels/tile_kernels.h"

namespace burin::test {

/// For each set of instructions that this processor has.
inline std::vector<const TileKernels*> all_kernels() {
    std::vector<const TileKernels*> result{&baseline_kernels()};
    for (const TileKernels* kernels : {avx2_kernels(), avx512_kernels()}) {
        if (kernels != nullptr) result.push_back(kernels);
    }
    return result;
}

}  // namespace burin::test
