#pragma once

#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "kernels/tile_kernels.h"
#include "lines/line_drawing.h"
#include "render/film.h"
#include "render/frame.h"
#include "strokes/pixel_filter.h"
#include "strokes/visible_strokes.h"
#include "view/pixel_tiles.h"

namespace burin {

class TileMattes;

/// HiddenStrokes draws pieces of lines that some surface is in front of, in one part of the picture: below the visible
/// lines into the beauty, hidden ones into their own channels, and those seen through transparent surfaces into the
/// channels of the visible lines. It works tile by tile, together with the visible strokes, which cover them.
class HiddenStrokes {
  public:
    static constexpr int kTilePx = 32;

    /// The pieces must outlive it.
    HiddenStrokes(const Frame& frame, const TileKernels& kernels, int threads, PixelRect part,
                  const LineDrawing::Lists& behind, bool has_mattes);
    ~HiddenStrokes();

    bool has_any(std::size_t tile) const { return !lists_.of(tile).empty(); }
    /// Draws what lies below the visible lines of a tile, before those, which are given, are drawn: what they will
    /// cover stays free. `mattes`: gets whose they are; nullptr: nobody asks.
    void draw_below(int worker, std::size_t tile, const VisibleStrokes& visible, Film& film, TileMattes* mattes);
    /// Adds the lines seen through surfaces to the channels of the visible ones, after these are drawn, on the same
    /// thread.
    void draw_above(int worker, Film& film) const;

  private:
    class Worker;

    std::unique_ptr<const FilterTable> filter_;
    PixelTiles grid_;
    std::deque<LinePiece> joined_;  // of pieces that follow each other and look alike
    TileLists<const LinePiece*> lists_;
    TileLists<const LinePiece*> single_lists_;  // of pieces that are not joined, if it is asked whose they are
    std::vector<Worker> workers_;
};

}  // namespace burin
