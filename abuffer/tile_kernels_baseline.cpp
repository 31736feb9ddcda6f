#include "abuffer/level_reach.h"
#include "abuffer/mesh_walks.h"
#include "abuffer/tile_kernels.h"

#include "abuffer/tile_kernels.inc"

namespace burin {

const TileKernels& baseline_kernels() {
    static constexpr TileKernels kernels = kernels_named("baseline");
    return kernels;
}

const TileKernels& best_kernels() {
    for (const TileKernels* const fast : {avx512_kernels(), avx2_kernels()}) {
        if (fast != nullptr) return *fast;
    }
    return baseline_kernels();
}

}  // namespace burin
