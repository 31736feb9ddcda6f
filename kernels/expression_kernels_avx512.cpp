#include "kernels/expression_kernels.h"

// Compiled with AVX-512 where the compiler can (see CMakeLists.txt), and used where the machine can.
#ifdef __AVX512VL__

#include "kernels/expression_kernels.inc"

namespace burin {

const ExpressionKernels* avx512_expression_kernels() {
    static constexpr ExpressionKernels kernels = expression_kernels_named("avx512");
    const bool has_all = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
                         __builtin_cpu_supports("popcnt");
    return has_all ? &kernels : nullptr;
}

}  // namespace burin

#else

namespace burin {

const ExpressionKernels* avx512_expression_kernels() { return nullptr; }

}  // namespace burin

#endif
