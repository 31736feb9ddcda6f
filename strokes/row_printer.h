#pragma once

#include <mutex>

#include "lines/line_drawing.h"
#include "render/method.h"
#include "render/row_sink.h"
#include "strokes/printer.h"

namespace burin {

/// RowPrinter draws the lines of a drawing over a film, rows from the top: as soon as all lines that reach some rows
/// are found these get their strokes, and finished bands of the film are handed on.
class RowPrinter : public RowSink {
  public:
    /// Stands in place of a row where all lines are found.
    static constexpr int kAllRows = 1 << 30;

    /// All that is given must outlive it. `film`: has the surfaces of the rows that are drawn.
    RowPrinter(const Frame& frame, const RunOptions& options, const LineDrawing& drawing, Film& film);

    double draw_rows_as(int worker, int known_y) override;
    double draw_rows(int known_y) override;
    double first_needed_y() const override { return taken_y_ - reach_px_; }
    bool hands_on() const override { return options_.finished_band != nullptr; }

  private:
    /// Takes the rows of the crop that strokes of lines from row `known_y` on do not reach, whole bands of them, less
    /// those that are taken: at most this many bands. May be empty. Any thread may call it.
    PixelRect take(int known_y, int most_bands);
    StrokePrinter::Lists lines_reaching(PixelRect rows, int known_y) const;
    /// The first band of those rows, and how many there are.
    std::size_t first_band(PixelRect rows) const;
    std::size_t band_count(PixelRect rows) const;

    const Frame& frame_;
    const RunOptions& options_;
    const LineDrawing& drawing_;
    int threads_;
    PixelRect crop_;
    double reach_px_;  // how far from a line its stroke may reach, and a bit
    bool has_mattes_;
    StrokePrinter strokes_;
    std::mutex taking_;
    int taken_y_;
};

}  // namespace burin
