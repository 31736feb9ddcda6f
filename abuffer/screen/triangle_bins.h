#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "abuffer/screen/screen_surfaces.h"
#include "image/image.h"
#include "kernels/tile_kernels.h"
#include "view/pixel_tiles.h"

// Triangles are culled and sorted to tiles, as runs of small ones and single large ones.

namespace burin {

/// A triangle that Draw::small_triangles() cannot draw: large, or cut by the near plane or the guard band.
struct LargePolygon {
    ScreenPolygon polygon;
    SpanPlane plane;
    SurfaceId surface;
};

/// Some small triangles of one instance in one tile, of one kind.
struct TriangleRun {
    std::uint32_t instance, count;
    TriangleKind kind;
    float nearness;  // of one of them
    const TileTriangle* triangles;
    float highest;         // of all of them
    std::uint32_t blocks;  // around them all, see TileTriangle

    /// Whether all of them are less near, at most `high`, than the least numbers of all blocks that they may touch:
    /// those of a BlockTable.
    bool is_behind(const float* least, float high) const;
};

/// Sorts the triangles of the instances that are shown to the tiles of a picture that they touch.
class TriangleBins {
  public:
    /// Finds the facing of all triangles on the way, and which of their edges may be lines. Tiles cover `region`; a
    /// tile also gets what lies on the samples next to its right and lower sides. `tile_samples`: a tile's width, a
    /// power of two. `keeps_thin`: triangles between samples are kept, too.
    TriangleBins(ScreenSurfaces& surfaces, PixelRect region, int samples_per_pixel, const TileKernels& kernels,
                 int threads, int tile_samples = TileGrid::kTileSamples, bool keeps_thin = false);

    std::size_t tile_count() const { return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_); }
    PixelRect tile(std::size_t index) const;
    /// The tile that is `columns` farther right and `rows` farther down; nothing where there is none.
    std::optional<std::size_t> tile_beside(std::size_t index, int columns, int rows) const;
    bool is_empty(std::size_t tile) const { return runs_in(tile).empty() && large_in(tile).empty(); }
    /// The empty tiles side by side from this one on, as one rectangle; nothing if the tile to its left
    /// is one of them.
    PixelRect empty_tiles_from(std::size_t tile) const;
    std::span<const TriangleRun> runs_in(std::size_t tile) const { return runs_.of(tile); }
    /// Numbers into large().
    std::span<const std::uint32_t> large_in(std::size_t tile) const { return large_in_.of(tile); }
    const LargePolygon& large(std::uint32_t i) const { return large_[i]; }
    std::size_t large_count() const { return large_.size(); }
    /// The runs and large polygons that lie between samples.
    std::span<const TriangleRun> thin_runs_in(std::size_t tile) const { return thin_runs_.of(tile); }
    std::span<const std::uint32_t> thin_large_in(std::size_t tile) const { return thin_large_in_.of(tile); }
    /// The width of tiles, all of one size but for the last ones.
    int tile_px() const { return tile_px_; }

  private:
    PixelRect region_;
    int tile_px_, columns_, rows_;
    std::vector<std::unique_ptr<TileTriangle[]>> triangles_;  // what runs point into
    TileLists<TriangleRun> runs_, thin_runs_;
    TileLists<std::uint32_t> large_in_, thin_large_in_;
    std::vector<LargePolygon> large_;
};

}  // namespace burin
