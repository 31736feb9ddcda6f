#include "abuffer/tile_kernels.h"

#include "abuffer/tile_kernels.inc"

namespace burin {

const TileKernels& baseline_kernels() {
    static const TileKernels kernels{"baseline", project, cull, find_line_edges, draw_small, find_farthest, combine_blocks, find_nearer, draw_span,
                                     find_pairs, count_covered, look, stroke_spans, count_bits,
                                     find_touching, find_hiding, find_overlaps, find_unconnected};
    return kernels;
}

const TileKernels& best_kernels() {
    const TileKernels* const fast = avx2_kernels();
    return fast != nullptr ? *fast : baseline_kernels();
}

}  // namespace burin
