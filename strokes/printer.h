#pragma once

#include <memory>
#include <span>
#include <vector>

#include "kernels/tile_kernels.h"
#include "lines/line_drawing.h"
#include "render/film.h"
#include "render/frame.h"
#include "strokes/hidden_strokes.h"
#include "strokes/pixel_filter.h"

namespace burin {

/// StrokePrinter draws pieces of visible lines as strokes over a film, and those of lines behind surfaces with them.
class StrokePrinter {
  public:
    using Lists = LineDrawing::Lists;

    StrokePrinter(const Frame& frame, const TileKernels& kernels, int threads, Film& film);
    ~StrokePrinter();

    /// Draws a part of the picture, on all threads. `lines`: all whose strokes reach it; `behind`: nullptr or those
    /// behind surfaces in the same part.
    void draw(PixelRect part, const Lists& lines, HiddenStrokes* behind = nullptr);
    /// Draws it on one thread, while others draw other parts. `worker`: which thread, [0, threads).
    void draw_as(int worker, PixelRect part, const Lists& lines);

  private:
    struct Bins;
    class Printer;
    Bins sort(PixelRect part, const Lists& lines) const;
    void print(int worker, const Bins& bins, std::size_t tile, HiddenStrokes* behind);

    const Frame& frame_;
    Film& film_;
    std::unique_ptr<const FilterTable> filter_;  // nullptr: each pixel sees its own square
    std::vector<Printer> printers_;              // of each thread
};

}  // namespace burin
