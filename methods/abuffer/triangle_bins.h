#pragma once

#include <memory>
#include <span>
#include <vector>

#include "abuffer/tile_kernels.h"
#include "image/image.h"
#include "methods/abuffer/screen_surfaces.h"

namespace burin {

/// A triangle that draw_small() cannot draw: large, or cut by the near plane or the guard band.
struct LargePolygon {
    ScreenPolygon polygon;
    SpanPlane plane;
    SurfaceId surface;
};

/// Some small triangles of one instance in one tile, wound one way.
struct TriangleRun {
    std::uint32_t instance, count;
    bool is_clockwise;
    const TileTriangle* triangles;
};

/// What of the instances that are shown touches each tile of a picture.
class TriangleBins {
  public:
    /// Finds the facing of all triangles on the way, and which of their edges may be lines. Tiles cover `region`; a tile
    /// also gets what lies on the samples next to its right and lower border. `tile_samples`: a tile's width, a
    /// power of two.
    TriangleBins(ScreenSurfaces& surfaces, PixelRect region, int samples_per_pixel, const TileKernels& kernels,
                 int threads, int tile_samples = TileGrid::kTileSamples);

    std::size_t tile_count() const { return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_); }
    PixelRect tile(std::size_t index) const;
    bool is_empty(std::size_t tile) const { return runs_in(tile).empty() && large_in(tile).empty(); }
    /// The empty tiles side by side from this one on, as one rectangle; nothing if the tile to its left
    /// is one of them.
    PixelRect empty_tiles_from(std::size_t tile) const;
    std::span<const TriangleRun> runs_in(std::size_t tile) const {
        return {runs_.data() + run_end_[tile], run_end_[tile + 1] - run_end_[tile]};
    }
    /// Numbers into large().
    std::span<const std::uint32_t> large_in(std::size_t tile) const {
        return {large_sorted_.data() + large_end_[tile], large_end_[tile + 1] - large_end_[tile]};
    }
    const LargePolygon& large(std::uint32_t i) const { return large_[i]; }

  private:
    PixelRect region_;
    int tile_px_, columns_, rows_;
    std::vector<std::unique_ptr<TileTriangle[]>> triangles_;  // what runs point into
    std::vector<std::size_t> run_end_, large_end_;
    std::vector<TriangleRun> runs_;
    std::vector<std::uint32_t> large_sorted_;
    std::vector<LargePolygon> large_;
};

}  // namespace burin
