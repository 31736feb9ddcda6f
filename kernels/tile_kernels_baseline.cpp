#include "base/instruction_set.h"
#include "kernels/level_reach.h"
#include "kernels/mesh_walks.h"
#include "kernels/tile_kernels.h"

#include "kernels/tile_kernels.inc"

namespace burin {

const TileKernels& baseline_kernels() {
    static constexpr TileKernels kernels = kernels_named("baseline");
    return kernels;
}

const TileKernels& best_kernels() {
    const InstructionSet allowed = allowed_instruction_set();
    const TileKernels* const avx512 = allowed >= InstructionSet::avx512 ? avx512_kernels() : nullptr;
    if (avx512 != nullptr) return *avx512;
    const TileKernels* const avx2 = allowed >= InstructionSet::avx2 ? avx2_kernels() : nullptr;
    return avx2 != nullptr ? *avx2 : baseline_kernels();
}

}  // namespace burin
