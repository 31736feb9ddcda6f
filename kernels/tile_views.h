#pragma once

#include <cstddef>
#include <cstdint>

// A tile's samples and triangles as the kernels of TileKernels see them.

namespace burin {

/// A triangle that lost a sample to another one at about the same depth.
struct Contest {
    std::uint32_t sample;  ///< index in the tile
    std::uint32_t loser;   ///< id
    float nearness;        ///< the loser's
};

/// SampleView is a SampleTile as the kernels see it: the nearest surface at each sample of a tile, which they read and
/// draw into.
struct SampleView {
    float* nearness;
    std::uint32_t* ids;
    std::int32_t first_column, first_row, columns, rows, stride, samples_per_pixel;
    /// Surfaces whose nearness differs by at most `level + level_per_nearness * nearness` are level.
    float level, level_per_nearness;
    /// The list of contests for samples between level surfaces; nullptr: they are not noted. `contest_count` goes on
    /// counting beyond the capacity.
    Contest* contests;
    std::uint32_t* contest_count;
    std::uint32_t contest_capacity;
    /// Per sample the nearness and the id of the last loser that is of interest: one that is
    /// farther, or as near with a larger id, is not noted. nullptr: all are.
    const float* last_nearness = nullptr;
    const std::uint32_t* last_ids = nullptr;
};

/// Nearness of a polygon of any size: `nearness` at the position (x, y) in 1/256 pixel, changes per
/// 1/256 pixel, and its range.
struct SpanPlane {
    std::int32_t x, y;
    float nearness, per_x, per_y, low, high;
    std::uint32_t id;
};

/// Columns and rows [first, end) of a tile's samples.
struct SampleRect {
    std::int32_t first_column, first_row, end_column, end_row;
};

/// Two neighbouring samples with different ids between which a line may lie. Bits 0 to 14: the first one's column in
/// the tile; 15 to 29: its row; 30: the second one lies below it, else to its right.
struct SamplePair {
    static constexpr std::uint32_t kRowShift = 15, kDownShift = 30, kPlaceMask = (1u << kRowShift) - 1u;
    std::uint32_t bits;

    static constexpr SamplePair at(std::int32_t column, std::int32_t row, bool down) {
        return {static_cast<std::uint32_t>(column) | static_cast<std::uint32_t>(row) << kRowShift |
                std::uint32_t{down} << kDownShift};
    }
    constexpr std::int32_t column() const { return static_cast<std::int32_t>(bits & kPlaceMask); }
    constexpr std::int32_t row() const { return static_cast<std::int32_t>(bits >> kRowShift & kPlaceMask); }
    constexpr bool down() const { return bits >> kDownShift != 0; }
};

constexpr std::size_t kRoomBehindPairs = 15;  ///< where kernels may write

/// SmoothLimits says what a smooth surface is: Walk::find_smooth().
struct SmoothLimits {
    float level, level_per_nearness;  ///< see SampleView: what is less deep is no wall
    double snapping;                  ///< how far snapping of a corner may move a deep triangle's edges, in 1/256 pixel
};

/// The tiles of a picture, all of one size but the last ones. A tile also gets the samples next to its right and lower
/// sides.
struct TileGrid {
    static constexpr std::int32_t kTileSamples = 128;  ///< along either side: the most, and the best
    std::int32_t first_column, first_row;              ///< of the upper left sample on the image's grid
    std::int32_t width, height;                        ///< in samples
    std::int32_t columns;                              ///< of tiles
    std::int32_t pitch_shift;                          ///< log2 of the distance of samples, in 1/256 pixel
    std::int32_t tile_shift;                           ///< log2 of a tile's width in samples
    bool keeps_thin;  ///< whether triangles between samples, which touch none, are wanted
};

constexpr std::int32_t kBlockShift = 3;
constexpr std::int32_t kBlockSamples = 1 << kBlockShift;

/// BlockTable says where the numbers of a tile's blocks of kBlockSamples x kBlockSamples samples stand: first one per
/// block, row by row, kPitch to a row; then, kPage further each, one for a block and the next one to the right
/// together, for a block and the one below, for two by two.
struct BlockTable {
    static constexpr std::int32_t kPitch = 32, kPage = kPitch * kPitch;
    static constexpr std::size_t kSize = 4 * static_cast<std::size_t>(kPage);
};

/// A small triangle in a tile, with what tells whether it can be seen there.
struct TileTriangle {
    std::uint32_t triangle;  ///< number in its mesh
    float highest;           ///< nearness of its nearest corner
    /// The blocks of samples of the tile that it may touch; if it lies between samples, those of the samples on either
    /// side. The lowest 12 bits say where a BlockTable has their number, unless there are more than two by two
    /// (kMany). Then five bits each: the last column and row.
    std::uint32_t blocks;

    static constexpr std::uint32_t kPlace = BlockTable::kSize - 1, kMany = BlockTable::kSize;
    static constexpr std::uint32_t pack(std::uint32_t first_column, std::uint32_t last_column, std::uint32_t first_row,
                                        std::uint32_t last_row) {
        const std::uint32_t columns = last_column - first_column, rows = last_row - first_row;
        const std::uint32_t page = (columns | rows) > 1 ? kMany : (columns | rows << 1) << 10;
        return first_column | first_row << 5 | page | last_column << 16 | last_row << 21;
    }
    std::int32_t first_column() const { return static_cast<std::int32_t>(blocks & 31u); }
    std::int32_t first_row() const { return static_cast<std::int32_t>(blocks >> 5 & 31u); }
    std::int32_t last_column() const { return static_cast<std::int32_t>(blocks >> 16 & 31u); }
    std::int32_t last_row() const { return static_cast<std::int32_t>(blocks >> 21 & 31u); }
};

/// What Cull::triangles() lists, an array per number.
struct CulledTriangles {
    std::uint32_t* keys;       ///< of their tiles: tile_key()
    std::uint32_t* triangles;  ///< the rest of a TileTriangle
    float* highest;
    std::uint32_t* blocks;
    std::size_t count;
    std::uint32_t* others;  ///< numbers of those that are not in two by two tiles or fewer, or not small
    std::size_t other_count;
};

/// This many triangles are on their way from memory while others are drawn.
constexpr std::size_t kTrianglesAhead = 64;

/// Kernels may read and write this much behind lists of culled triangles, and behind runs of a tile.
constexpr std::size_t kRoomBehindCulled = 16, kRoomBehindRun = 7;

/// What a tile lists separately. `thin` ones have no column or no row of samples in their box.
enum TriangleKind : std::uint32_t { wound_counterclockwise, wound_clockwise, thin, kTriangleKinds };

}  // namespace burin
