#include "kernels/level_reach.h"
#include "kernels/mesh_walks.h"
#include "kernels/tile_kernels.h"

// Compiled with AVX2 where the compiler can (see CMakeLists.txt), and used where the machine can.
#ifdef __AVX2__

#include "kernels/tile_kernels.inc"

namespace burin {

const TileKernels* avx2_kernels() {
    static constexpr TileKernels kernels = kernels_named("avx2");
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt") ? &kernels : nullptr;
}

}  // namespace burin

#else

namespace burin {

const TileKernels* avx2_kernels() { return nullptr; }

}  // namespace burin

#endif
