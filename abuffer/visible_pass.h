#pragma once

#include <optional>

#include "abuffer/depth_complexity.h"
#include "abuffer/edges/edge_lines.h"
#include "abuffer/screen/screen_surfaces.h"
#include "base/progress.h"
#include "kernels/tile_kernels.h"
#include "lines/line_drawing.h"
#include "render/film.h"
#include "render/frame.h"
#include "render/row_sink.h"
#include "render/stats.h"

namespace burin {

class ShadedSurfaces;

/// VisiblePass finds what is visible: it fills pixels and finds visible lines, tile by tile, in one or more slices of a
/// picture.
class VisiblePass {
  public:
    /// `shaded`: of a shading that varies over surfaces, else nullptr.
    VisiblePass(const Frame& frame, ScreenSurfaces& screen, const ShadedSurfaces* shaded, const TileKernels& kernels,
                int threads, Progress* progress, const DepthLimit& depth_limit = {});

    /// Fills the pixels of the tiles of `region` in the film, puts their lines into the drawing, and adds the time it
    /// took. Throws InputError where surfaces lie deeper than the limit. `sink`: is told of rows of tiles that are
    /// complete, except for the last one; nullptr: nobody.
    void draw(PixelRect region, int tile_samples, RowSink* sink, LineDrawing& drawing, Film& film, RenderStats& stats);
    /// The possible lines of all instances, if they are shown always and it looked for lines that samples miss.
    const PossibleLines* possible_lines() const { return possible_lines_ ? &*possible_lines_ : nullptr; }

  private:
    class Worker;

    const Frame& frame_;
    ScreenSurfaces& screen_;
    const ShadedSurfaces* shaded_;
    const TileKernels& kernels_;
    int threads_;
    Progress* progress_;
    DepthComplexity depth_complexity_;
    std::optional<PossibleLines> possible_lines_;
};

}  // namespace burin
