#pragma once

#include <span>
#include <vector>

#include "abuffer/fine/fine_edges.h"
#include "abuffer/samples/sample_tile.h"
#include "abuffer/screen/edge_on_screen.h"
#include "lines/merge_pieces.h"

// What of a tile's edges its samples do not settle is listed, block by block.

namespace burin {

/// A part of an edge within one block that may be a line though the samples do not tell.
struct FinePart {
    FineEdge edge;
    std::int32_t block_x, block_y;
    double begin, end;  ///< shares of edge_on_screen(), which begins where ends_in_order() says
};

/// Finds where along edges the samples of a tile do not tell whether there is a line: no line of the edge
/// was found there, and the samples beside it see neither the edge's own triangles with what settles it, nor
/// something that is clearly in front. Buffers are used again from tile to tile.
class FineParts {
  public:
    /// `takes_rests`: also what is left of edges beside pieces of lines that were found, and lines beside
    /// others with a gap between them narrower than a sample (completes_lines()).
    FineParts(const ScreenSurfaces& screen, const TileKernels& kernels, bool takes_rests);

    /// `drawn`: the lines found in the tile, as a PieceMerger leaves them. Of loose edges, which
    /// samples never tell of, all that is not clearly behind.
    void find(const SampleTile& samples, std::span<const TileEdge> edges, std::span<const TileEdge> loose,
              std::span<const LinePiece> drawn, std::vector<FinePart>& parts);

  private:
    struct Owners {
        FineEdge edge;
        std::uint32_t numbers[2];
        bool needs_both;  // the line runs between two polygons that are seen
    };
    struct Interval {
        double begin, end;
    };
    /// The blocks that an edge may touch.
    struct BlockRange {
        int x0, y0, x1, y1;
        bool is_one() const { return x0 == x1 && y0 == y1; }
    };
    static BlockRange blocks_around(const SampleTile& samples, const EdgeOnScreen& edge);
    template <typename Visit>
    void for_blocks(const SampleTile& samples, const EdgeOnScreen& edge, const BlockRange& range,
                    const Visit& visit) const;
    void find_loose(const SampleTile& samples, std::span<const TileEdge> loose, std::vector<FinePart>& parts) const;
    void find_farthest(const SampleTile& samples);
    Owners owners_of(FineEdge edge) const;
    int side_at(FineEdge edge, HalfEdge h) const;
    int inner_side(FineEdge edge) const;
    /// Squares of samples, and the least nearness in each of them.
    struct Squares {
        int shift;  // log2 of a square's width in samples
        std::size_t pitch;
        std::vector<float> farthest;
    };
    bool is_surely_behind(const TileEdge& edge, const SampleTile& samples) const;
    bool is_behind(const Squares& squares, const SampleTile& samples, const EdgeOnScreen& edge, double begin,
                   double end) const;
    void find_open(const SampleTile& samples, const EdgeOnScreen& edge, const Owners& owners, glm::ivec2 block,
                   Interval part);
    bool is_open(const SampleTile& samples, glm::ivec2 square, const EdgeOnScreen& edge, double t,
                 const Owners& owners) const;
    bool is_in_front(std::uint32_t number, glm::dvec2 subpixel, double nearness) const;
    static bool is_tip(const SampleTile& samples, const EdgeOnScreen& edge, Interval part);
    bool is_drawn_by_another(const EdgeOnScreen& edge, std::uint32_t block) const;
    void find_undrawn(const EdgeOnScreen& edge, double begin, double end, std::span<const LinePiece> pieces);
    double level(double nearness) const;

    const ScreenSurfaces& screen_;
    const TileKernels& kernels_;
    bool takes_rests_;
    double level_part_;  // see level()
    static constexpr int kAreaShift = TileEdge::kAreaShift;
    static constexpr std::size_t kAreaPitch = BlockTable::kPitch >> (kAreaShift - kBlockShift);
    Squares blocks_{kBlockShift, BlockTable::kPitch, {}};
    Squares areas_{kAreaShift, kAreaPitch, {}};  // most edges lie behind whole ones
    PieceIndex drawn_;
    std::vector<FineEdge> asked_;
    std::vector<Interval> undrawn_, open_;
};

}  // namespace burin
