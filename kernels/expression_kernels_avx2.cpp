#include "base/instruction_set.h"
#include "kernels/expression_kernels.h"
#include "kernels/place_kernels.h"

// Compiled with AVX2 where the compiler can (see CMakeLists.txt), and used where the machine can.
#ifdef __AVX2__

#include "kernels/expression_kernels.inc"

namespace burin {

const ExpressionKernels* avx2_expression_kernels() {
    static constexpr ExpressionKernels kernels = expression_kernels_named("avx2");
    return has_instruction_set(InstructionSet::avx2) ? &kernels : nullptr;
}

const PlaceKernels* avx2_place_kernels() {
    static constexpr PlaceKernels kernels = place_kernels_named("avx2");
    return has_instruction_set(InstructionSet::avx2) ? &kernels : nullptr;
}

}  // namespace burin

#else

namespace burin {

const ExpressionKernels* avx2_expression_kernels() { return nullptr; }
const PlaceKernels* avx2_place_kernels() { return nullptr; }

}  // namespace burin

#endif
