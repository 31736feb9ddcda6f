#pragma once

#include <vector>

#include "abuffer/samples/contests.h"
#include "abuffer/samples/sample_tile.h"
#include "abuffer/screen/triangle_bins.h"
#include "kernels/tile_kernels.h"
#include "render/frame.h"

// Triangles of a tile become its samples: the nearest surface at each.

namespace burin {

/// What is visible at the samples of one tile after the other; buffers are used again.
class SurfaceTile {
  public:
    /// `most_contests`: that are noted at a time.
    SurfaceTile(const Frame& frame, const ScreenSurfaces& screen, const TriangleBins& bins, int samples_per_pixel,
                const TileKernels& kernels, std::size_t most_contests = Contests::kMostNoted);

    /// Finds what is visible at the samples of a tile and one more column and row.
    void draw(std::size_t tile);

    const SampleTile& samples() const { return samples_; }
    /// The samples as kernels see them. The view is good until the next draw().
    SampleView view();
    PixelRect rect() const { return rect_; }
    SurfaceId surface_at(std::size_t sample) const {
        const std::uint32_t id = samples_.ids[sample];
        return id == SampleTile::kBackground ? kBackground : screen_.surface_of(id >> 1);
    }
    /// How many contests it can note at a time.
    std::size_t room_for_contests() const { return contests_.room(); }
    /// How many triangles were drawn.
    std::uint64_t sample_tests() const { return drawn_; }

  private:
    void draw_all();
    void clear_samples();
    bool is_in_vain() const;
    void find_farthest();
    /// The highest nearness that is level with what is hidden, as Blocks::find_nearer() computes it.
    float highest_level_with_hidden(float nearness) const {
        return nearness + (nearness * hidden_level_per_nearness_ + hidden_level_);
    }
    void draw_runs(bool is_worth_a_look);
    void find_seen(const TriangleRun& run, bool has_look);
    void draw_seen();
    void order_runs(std::size_t tile);
    void order_large_ones(std::size_t tile);
    void draw_large_ones();
    int draw_large(const LargePolygon& large, bool plain, bool has_look);
    float farthest_in_blocks() const;
    float highest_in(const SpanPlane& plane, int from, int to, int first_row, int end_row) const;

    const ScreenSurfaces& screen_;
    const TriangleBins& bins_;
    const TileKernels& kernels_;
    int per_pixel_;
    float level_, level_per_nearness_;  // see SampleView
    float hidden_level_,
        hidden_level_per_nearness_;  // the same with level_reach(): what is farther behind is level with nothing
    PixelRect rect_;
    SampleTile samples_;
    Contests contests_;
    struct PlacedRun {
        const TriangleRun* run;
        float nearness;  // of one of its triangles
    };
    std::vector<PlacedRun> runs_;  // in the order of drawing
    // Small triangles of one instance that are about to be drawn.
    std::vector<std::uint32_t> seen_;
    std::size_t seen_count_ = 0;
    std::uint32_t seen_of_ = 0;
    struct PlacedPolygon {
        std::uint32_t number;  // in bins_
        float highest;         // its plane, in the tile
    };
    std::vector<PlacedPolygon> large_;  // in the order of drawing
    std::vector<float> farthest_;       // per block of samples: what is less near by more than what is
                                        // level can be left out
    std::vector<float, CacheLineAllocator<float>> left_out_;  // the same per sample, where much is level
    std::uint64_t drawn_ = 0;
};

}  // namespace burin
