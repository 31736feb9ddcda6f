#include "base/instruction_set.h"
#include "kernels/level_reach.h"
#include "kernels/mesh_walks.h"
#include "kernels/tile_kernels.h"

// The same source as in tile_kernels_avx2.cpp, for AVX-512. Most vectors stay eight wide; what helps are comparisons
// into mask registers.
#ifdef __AVX512VL__

#include "kernels/tile_kernels.inc"

namespace burin {

const TileKernels* avx512_kernels() {
    static constexpr TileKernels kernels = kernels_named("avx512");
    return has_instruction_set(InstructionSet::avx512) ? &kernels : nullptr;
}

}  // namespace burin

#else

namespace burin {

const TileKernels* avx512_kernels() { return nullptr; }

}  // namespace burin

#endif
