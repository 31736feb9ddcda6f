#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "abuffer/screen_triangle.h"

namespace burin {

/// A SampleTile as the kernels see it.
struct SampleView {
    float* nearness;
    std::uint32_t* ids;
    std::int32_t first_column, first_row, columns, rows, stride, samples_per_pixel;
};

/// Nearness of a polygon of any size: `nearness` at the position (x, y) in 1/256 pixel, changes per
/// 1/256 pixel, and its range.
struct SpanPlane {
    std::int32_t x, y;
    float nearness, per_x, per_y, low, high;
    std::uint32_t id;
};

/// Two neighbouring samples with different ids between which a line may lie.
struct SamplePair {
    std::uint16_t column, row;  ///< of the first sample, in the tile
    bool down;                  ///< the second one lies below the first, else to its right
};

/// The inner loops of the production A-buffer. There is one set per instruction set; all give equal
/// results to the bit, because they are the same source compiled twice and floating point is not
/// contracted.
struct TileKernels {
    std::string_view name;
    /// Draws triangles into a tile: nearest wins, then the smaller id. Triangles must be smaller than
    /// kLargestSmallTriangle in both directions.
    void (*draw_small)(const SampleView& tile, const ScreenTriangle* triangles, std::size_t count);
    /// Draws columns [begin, end) of a row of the tile.
    void (*draw_span)(const SampleView& tile, std::int32_t row, std::int32_t begin, std::int32_t end,
                      const SpanPlane& plane);
    /// Finds the pairs of neighbours with different ids, except where both are plain and the
    /// difference in nearness is at most `level + level_per_nearness * nearness`. Returns their number;
    /// `pairs` must have room for 2 * columns * rows.
    std::size_t (*find_pairs)(const SampleView& tile, float level, float level_per_nearness, SamplePair* pairs);
};

/// In 1/256 pixel. Products of such lengths fit 32 bits.
constexpr std::int32_t kLargestSmallTriangle = 1 << 14;

const TileKernels& baseline_kernels();
/// nullptr where this build or this machine has none.
const TileKernels* avx2_kernels();
/// The fastest ones.
const TileKernels& best_kernels();

}  // namespace burin
