#include "abuffer/tile_kernels.h"

// Compiled with AVX2 where the compiler can (see CMakeLists.txt), and used where the machine can.
#ifdef __AVX2__

#include "abuffer/tile_kernels.inc"

namespace burin {

const TileKernels* avx2_kernels() {
    static const TileKernels kernels{"avx2", project, cull, find_line_edges, draw_small, find_farthest, combine_blocks, find_nearer, draw_span,
                                     find_pairs, count_covered, look, stroke_spans, count_bits,
                                     find_touching, find_hiding, find_overlaps, find_unconnected};
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt") ? &kernels : nullptr;
}

}  // namespace burin

#else

namespace burin {

const TileKernels* avx2_kernels() { return nullptr; }

}  // namespace burin

#endif
