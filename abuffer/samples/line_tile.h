#pragma once

#include <memory>
#include <span>
#include <vector>

#include "abuffer/samples/fast_decision.h"
#include "abuffer/samples/flush_cover.h"
#include "abuffer/samples/surface_tile.h"
#include "abuffer/samples/walks_ahead.h"
#include "kernels/tile_kernels.h"
#include "lines/crease_fade.h"
#include "lines/line_crossing.h"
#include "lines/line_piece.h"
#include "lines/merge_pieces.h"
#include "render/frame.h"

// Samples of a tile become pieces of lines: pairs of neighbours are decided, crossings placed, and cells traced.

namespace burin {

/// The lines between the samples of one tile after the other; buffers are used again.
class LineTile {
  public:
    LineTile(const Frame& frame, const ScreenSurfaces& screen, const TriangleBins& bins, SurfaceTile& visible,
             const TileKernels& kernels);

    /// Adds the pieces of lines of a tile, which was drawn last.
    void find_lines(std::size_t tile, std::vector<LinePiece>& pieces);

  private:
    glm::dvec2 position(int column, int row) const;
    // The samples of a pair, in the tile, and 1 + the number of the crossing between them; 0: none.
    std::size_t first_of(const SamplePair& pair) const {
        return static_cast<std::size_t>(pair.row()) * static_cast<std::size_t>(samples_.stride) +
               static_cast<std::size_t>(pair.column());
    }
    std::size_t second_of(const SamplePair& pair) const {
        return first_of(pair) + (pair.down() ? static_cast<std::size_t>(samples_.stride) : 1);
    }
    std::uint32_t& crossing_between(const SamplePair& pair) {
        return between_[2 * first_of(pair) + (pair.down() ? 1 : 0)];
    }
    /// One sample shows the background.
    struct OutlinePair {
        SamplePair pair;
        std::uint32_t triangle, from;  // of the other sample, 0 or 1
        std::uint32_t instance;
    };
    void find_crossings();
    void find_pairs();
    void find_neighbours(std::span<const SamplePair> pairs);
    bool decide(const SamplePair& pair, const NeighbourSamples& neighbours, const KnownWalks& walks,
                LineCrossing& crossing);
    void set_edge(SurfaceEdge edge, LineCrossing& crossing) const;
    std::size_t find_outlines(std::size_t asked);
    void cross_outlines(std::span<const OutlinePair> pairs, std::size_t& asked);
    LineCrossing& next_crossing();
    void add_crossing(const SamplePair& pair);
    void decide_all(std::span<const SamplePair> pairs);
    void trace_cells(std::vector<LinePiece>& pieces);

    const Frame& frame_;
    const ScreenSurfaces& screen_;
    SurfaceTile& visible_;
    const SampleTile& samples_;
    double pitch_px_ = 1;  // from one sample to the next
    const TileKernels& kernels_;
    LineClassSet outline_classes_;  // of an outline that is nothing else
    bool keeps_undrawn_;            // boundaries of surfaces that no class asked for: they hide strokes all the same
    FastDecision fast_;
    std::unique_ptr<MeshWalks> mesh_walks_;
    std::unique_ptr<WalkOutlines> found_outlines_;
    WalksAhead walks_;
    FlushCover flush_;
    CreaseFade fade_;
    std::vector<SamplePair> pairs_;  // with room for all that there can be
    std::size_t pair_count_ = 0;
    std::vector<std::uint8_t> is_smooth_;  // per pair
    std::vector<OutlinePair> outlines_;
    std::vector<NeighbourSamples> neighbours_;
    std::vector<LineCrossing> crossings_;  // not made anew: making one zeroes it first
    std::size_t crossing_count_ = 0;
    std::vector<SamplePair> crossing_places_;  // of each
    // Per sample, crossing_between() it and the one to its right, and the one below it.
    std::vector<std::uint32_t> between_;
    std::vector<LinePiece> pieces_;
    PieceMerger merger_;
};

}  // namespace burin
