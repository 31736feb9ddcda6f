#pragma once

#include <optional>
#include <vector>

#include "abuffer/edges/edge_lines.h"
#include "abuffer/screen/screen_surfaces.h"
#include "base/progress.h"
#include "kernels/tile_kernels.h"
#include "lines/line_piece.h"
#include "render/film.h"
#include "render/frame.h"
#include "render/stats.h"
#include "strokes/printer.h"
#include "strokes/row_printer.h"

namespace burin {

/// What is visible: fills pixels and finds visible lines, tile by tile, in one or more pieces of a
/// picture.
class VisiblePass {
  public:
    VisiblePass(const Frame& frame, ScreenSurfaces& screen, const TileKernels& kernels, int threads, Progress* progress)
        : frame_(frame), screen_(screen), kernels_(kernels), threads_(threads), progress_(progress) {}

    /// Draws the tiles of `region`, adds their lines and the time it took. Rows whose lines are known by then are
    /// finished, except for the last ones; nullptr: none. Returns the lists of `segments` that may reach rows that are
    /// not.
    StrokePrinter::Lists draw(PixelRect region, int tile_samples, RowPrinter* finisher,
                              std::vector<std::vector<LinePiece>>& segments, Film& film, RenderStats& stats);
    /// Of all instances, if they are shown always and it looked for lines that samples miss.
    const PossibleLines* possible_lines() const { return possible_lines_ ? &*possible_lines_ : nullptr; }

  private:
    const Frame& frame_;
    ScreenSurfaces& screen_;
    const TileKernels& kernels_;
    int threads_;
    Progress* progress_;
    std::optional<PossibleLines> possible_lines_;
};

}  // namespace burin
