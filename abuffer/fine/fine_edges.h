#pragma once

#include "abuffer/edges/edge_lines.h"
#include "abuffer/screen/screen_surfaces.h"
#include "view/pixel_tiles.h"

// All edges that may be lines in a view are sorted to tiles, for the search of lines that samples miss.

namespace burin {

/// An edge of the mesh of an instance.
struct FineEdge {
    std::uint32_t instance;
    HalfEdge half_edge;
};

/// Such an edge in a tile, with what tells that it cannot be seen there.
struct TileEdge {
    static constexpr int kAreaShift = kBlockShift + 2;  ///< log2 of an area's width in samples

    FineEdge edge;
    float nearest;  ///< its nearness, at the nearer end
    std::uint8_t left, top, right,
        bottom;  ///< the areas of the tile's samples that it may touch, or farther right or down
};

/// The squares of 2 x 2 samples lie half a sample to the right of and below the pixels. Blocks are the
/// squares of kMergeBlockPx pixels that they are merged in: equal in all tiles and crops.
struct SampleBlocks {
    explicit SampleBlocks(int samples_per_pixel) : half_pitch(kSubpixelsPerPixel / samples_per_pixel / 2) {}

    static constexpr int kShift = 11;  // log2 of a block's width in 1/256 pixel
    int at(std::int32_t subpixel) const { return (subpixel - half_pitch) >> kShift; }
    double begin(int block) const { return static_cast<double>((std::int64_t{block} << kShift) + half_pitch); }

    std::int32_t half_pitch;
};

/// The edges on the screen that may be lines in this view, seen or not, tile by tile: what samples may
/// miss. Left to the samples are edges of more than two triangles: which of them is seen makes the line.
class FineEdges {
  public:
    /// `possible`: nullptr if there are to be loose edges only.
    FineEdges(const ScreenSurfaces& screen, const PossibleLines* possible, std::span<const LooseChunk> loose,
              const PixelTiles& tiles, int samples_per_pixel, int threads);

    /// The edges that touch squares of samples of a tile.
    std::span<const TileEdge> in(std::size_t tile) const { return lists_.of(tile); }
    /// The loose edges that do, which no sample sees.
    std::span<const TileEdge> loose_in(std::size_t tile) const { return loose_lists_.of(tile); }
    bool has_any(std::size_t tile) const { return !in(tile).empty() || !loose_in(tile).empty(); }

  private:
    TileLists<TileEdge> lists_, loose_lists_;
};

}  // namespace burin
