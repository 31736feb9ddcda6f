#include "base/instruction_set.h"
#include "kernels/expression_kernels.h"
#include "kernels/place_kernels.h"

#include "kernels/expression_kernels.inc"

namespace burin {

const ExpressionKernels& baseline_expression_kernels() {
    static constexpr ExpressionKernels kernels = expression_kernels_named("baseline");
    return kernels;
}

const ExpressionKernels& best_expression_kernels() {
    const InstructionSet allowed = allowed_instruction_set();
    const ExpressionKernels* const avx512 = allowed >= InstructionSet::avx512 ? avx512_expression_kernels() : nullptr;
    if (avx512 != nullptr) return *avx512;
    const ExpressionKernels* const avx2 = allowed >= InstructionSet::avx2 ? avx2_expression_kernels() : nullptr;
    return avx2 != nullptr ? *avx2 : baseline_expression_kernels();
}

const PlaceKernels& baseline_place_kernels() {
    static constexpr PlaceKernels kernels = place_kernels_named("baseline");
    return kernels;
}

const PlaceKernels& best_place_kernels() {
    const InstructionSet allowed = allowed_instruction_set();
    const PlaceKernels* const avx512 = allowed >= InstructionSet::avx512 ? avx512_place_kernels() : nullptr;
    if (avx512 != nullptr) return *avx512;
    const PlaceKernels* const avx2 = allowed >= InstructionSet::avx2 ? avx2_place_kernels() : nullptr;
    return avx2 != nullptr ? *avx2 : baseline_place_kernels();
}

}  // namespace burin
