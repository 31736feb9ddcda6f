#pragma once

#include <vector>

#include "abuffer/tile_kernels.h"
#include "lines/crease_fade.h"
#include "lines/line_segment.h"
#include "lines/merge_segments.h"
#include "methods/abuffer/samples/fast_decision.h"
#include "methods/abuffer/samples/flush_cover.h"
#include "methods/abuffer/samples/surface_tile.h"
#include "render/frame.h"

namespace burin {

/// The lines between the samples of one tile after the other; buffers are used again.
class LineTile {
  public:
    LineTile(const Frame& frame, const ScreenSurfaces& screen, const TriangleBins& bins, SurfaceTile& visible,
             const TileKernels& kernels);

    /// Adds the pieces of lines of a tile, which was drawn last.
    void find_lines(std::size_t tile, std::vector<LineSegment>& segments);

  private:
    glm::dvec2 position(int column, int row) const;
    void find_crossings();
    void find_pairs();
    NeighbourSamples neighbours_of(const SamplePair& pair) const;
    bool decide(const SamplePair& pair, const NeighbourSamples& neighbours, LineCrossing& crossing);
    void trace_cells(std::vector<LineSegment>& segments);

    const Frame& frame_;
    const ScreenSurfaces& screen_;
    SurfaceTile& visible_;
    const SampleTile& samples_;
    const TileKernels& kernels_;
    bool keeps_undrawn_;  // boundaries of surfaces that no class asked for: they hide strokes all the same
    FastDecision fast_;
    FlushCover flush_;
    CreaseFade fade_;
    std::vector<SamplePair> pairs_;  // with room for all that there can be
    std::size_t pair_count_ = 0;
    std::vector<std::uint8_t> is_smooth_;  // per pair
    std::vector<LineCrossing> crossings_;
    std::vector<SamplePair> crossing_places_;
    // Per sample, 1 + the number of the crossing to its right and below it; 0: none.
    std::vector<std::uint32_t> right_, down_;
    std::vector<LineSegment> pieces_;
    SegmentMerger merger_;
};

}  // namespace burin
