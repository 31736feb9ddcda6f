#include "base/instruction_set.h"
#include "kernels/level_reach.h"
#include "kernels/mesh_walks.h"
#include "kernels/tile_kernels.h"

// Compiled with AVX2 where the compiler can (see CMakeLists.txt), and used where the machine can.
#ifdef __AVX2__

#include "kernels/tile_kernels.inc"

namespace burin {

const TileKernels* avx2_kernels() {
    static constexpr TileKernels kernels = kernels_named("avx2");
    return has_instruction_set(InstructionSet::avx2) ? &kernels : nullptr;
}

}  // namespace burin

#else

namespace burin {

const TileKernels* avx2_kernels() { return nullptr; }

}  // namespace burin

#endif
