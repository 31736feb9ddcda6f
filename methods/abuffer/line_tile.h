#pragma once

#include <vector>

#include "abuffer/sample_tile.h"
#include "abuffer/tile_kernels.h"
#include "lines/crease_fade.h"
#include "lines/line_segment.h"
#include "lines/merge_segments.h"
#include "methods/abuffer/fast_decision.h"
#include "methods/abuffer/flush_cover.h"
#include "methods/abuffer/triangle_bins.h"
#include "render/frame.h"

namespace burin {

/// Visibility and lines of one tile after the other; buffers are used again.
class LineTile {
  public:
    LineTile(const Frame& frame, const ScreenSurfaces& screen, const TriangleBins& bins, int samples_per_pixel,
             const TileKernels& kernels);

    /// Finds what is visible at the samples of a tile and one more column and row.
    void draw(std::size_t tile);
    /// After draw(): adds the tile's pieces of lines.
    void find_lines(std::vector<LineSegment>& segments);

    const SampleTile& samples() const { return samples_; }
    PixelRect rect() const { return rect_; }
    SurfaceId surface_at(std::size_t sample) const {
        const std::uint32_t id = samples_.ids[sample];
        return id == SampleTile::kBackground ? kBackground : screen_.surface_of(id >> 1);
    }
    std::uint64_t sample_tests() const { return drawn_; }

  private:
    SampleView view();
    void draw_all(std::size_t tile);
    void settle_contests();
    /// How a triangle that is level with what is seen lies to it.
    struct Relation {
        std::uint32_t loser = ~0u, winner = ~0u;
        bool is_in_front = false;  // but for rounding, wherever both are
        bool folds_over = false;   // in front, at their common edge
        bool comes_first = false;  // they coincide, and it is the first one
        bool any() const { return is_in_front || folds_over || comes_first; }
    };
    const Relation& relation(std::uint32_t loser, std::uint32_t winner);
    bool is_fold_over(std::uint32_t front, std::uint32_t back) const;
    bool may_be_in_front(std::uint32_t front, std::uint32_t back) const;
    SurfaceOrder order(std::uint32_t loser, std::uint32_t winner) const;
    void order_runs(std::size_t tile);
    void draw_large_ones(std::size_t tile);
    int draw_large(const LargePolygon& large, bool plain, bool has_look);
    float farthest_in_blocks() const;
    float highest_in(const SpanPlane& plane, int from, int to, int first_row, int end_row) const;
    glm::dvec2 position(int column, int row) const;
    void find_crossings();
    void find_pairs();
    NeighbourSamples neighbours_of(const SamplePair& pair) const;
    bool decide(const SamplePair& pair, const NeighbourSamples& neighbours, LineCrossing& crossing);
    void trace_cells(std::vector<LineSegment>& segments);

    const Frame& frame_;
    const ScreenSurfaces& screen_;
    const TriangleBins& bins_;
    int per_pixel_;
    const TileKernels& kernels_;
    bool keeps_undrawn_;  // boundaries of surfaces that no class asked for: they hide strokes all the same
    FastDecision fast_;
    FlushCover flush_;
    CreaseFade fade_;
    PixelRect rect_;
    SampleTile samples_;
    struct PlacedRun {
        const TriangleRun* run;
        float nearness;  // of one of its triangles
    };
    std::vector<PlacedRun> runs_;  // in the order of drawing
    struct PlacedPolygon {
        std::uint32_t number;  // in bins_
        float highest;         // its plane, in the tile
    };
    std::vector<PlacedPolygon> large_;  // in the order of drawing
    std::vector<float> farthest_;  // per block of samples
    std::vector<SamplePair> pairs_;  // with room for all that there can be
    std::size_t pair_count_ = 0;
    std::vector<std::uint8_t> is_smooth_;  // per pair
    std::vector<LineCrossing> crossings_;
    std::vector<SamplePair> crossing_places_;
    // Per sample, 1 + the number of the crossing to its right and below it; 0: none.
    std::vector<std::uint32_t> right_, down_;
    std::vector<LineSegment> pieces_;
    SegmentMerger merger_;
    std::uint64_t drawn_ = 0;
    std::vector<Contest> contests_;
    std::uint32_t contest_count_ = 0, contests_used_ = 0;
    std::vector<std::uint8_t> is_open_;  // per sample: whether a loser may win after all
    std::vector<Relation> relations_;    // some that are known, by a hash
    std::size_t forgotten_ = 0;          // how often one took another's place
};

}  // namespace burin
