#pragma once

#include <mutex>

#include "render/method.h"
#include "strokes/printer.h"

namespace burin {

/// Rows of pixels, from the top: as soon as all lines that reach them are known they get their strokes, and finished
/// bands of the film are handed on.
class RowPrinter {
  public:
    static constexpr int kAllBands = 1 << 20;

    /// `options` and `film` must outlive it.
    RowPrinter(const Frame& frame, const TileKernels& kernels, int threads, const RunOptions& options, Film& film);

    /// How far from a line its stroke may reach, and a bit.
    double reach_px() const { return reach_px_; }
    /// Rows above are taken. Not while other threads take some.
    int taken_y() const { return taken_y_; }
    /// Whether somebody waits for finished bands.
    bool hands_on() const { return options_.finished_band != nullptr; }
    /// Takes the rows of the crop that strokes of lines from row `known_y` on do not reach, whole bands of them, less
    /// those that are taken: at most so many bands. May be empty. Any thread may call it.
    PixelRect take(int known_y, int most_bands = kAllBands);
    /// All that are left.
    PixelRect take_rest();

    /// Strokes over rows that were taken, and what the next one does: on one thread, while others do the same with
    /// other rows. Returns the seconds that the latter took.
    double finish_as(int worker, PixelRect rows, StrokePrinter::Lists lines);

    /// The same in two steps, each on all threads.
    void draw(PixelRect rows, StrokePrinter::Lists lines, HiddenStrokes* behind = nullptr) {
        strokes_.draw(rows, lines, behind);
    }
    void hand_on(PixelRect rows) const;

  private:
    /// The first band of those rows, and how many there are.
    std::size_t first_band(PixelRect rows) const;
    std::size_t band_count(PixelRect rows) const;

    const RunOptions& options_;
    int threads_;
    PixelRect crop_;
    double reach_px_;
    StrokePrinter strokes_;
    std::mutex taking_;
    int taken_y_;
};

}  // namespace burin
