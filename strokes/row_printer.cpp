#include "strokes/row_printer.h"

#include <algorithm>
#include <cmath>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "base/stopwatch.h"

namespace burin {

RowPrinter::RowPrinter(const Frame& frame, const TileKernels& kernels, int threads, const RunOptions& options,
                       Film& film)
    : options_(options),
      threads_(threads),
      crop_(frame.crop),
      reach_px_(frame.scene->lines.style.reach_px() + 2),
      strokes_(frame, kernels, threads, film),
      taken_y_(frame.crop.y0) {}

PixelRect RowPrinter::take(int known_y, int most_bands) {
    const int bands = std::max(known_y - static_cast<int>(std::ceil(reach_px_)) - crop_.y0, 0) / Film::kBandRows;
    const std::lock_guard lock(taking_);
    PixelRect part = crop_;
    part.y0 = taken_y_;
    const int taken = (taken_y_ - crop_.y0) / Film::kBandRows;
    part.y1 = std::clamp(crop_.y0 + std::min(bands, taken + most_bands) * Film::kBandRows, taken_y_, crop_.y1);
    taken_y_ = part.y1;
    return part;
}

PixelRect RowPrinter::take_rest() {
    const std::lock_guard lock(taking_);
    PixelRect part = crop_;
    part.y0 = taken_y_;
    taken_y_ = part.y1;
    return part;
}

std::size_t RowPrinter::first_band(PixelRect rows) const {
    return static_cast<std::size_t>((rows.y0 - crop_.y0) / Film::kBandRows);
}

std::size_t RowPrinter::band_count(PixelRect rows) const {
    return static_cast<std::size_t>((rows.height() + Film::kBandRows - 1) / Film::kBandRows);
}

double RowPrinter::finish_as(int worker, PixelRect rows, StrokePrinter::Lists lines) {
    strokes_.draw_as(worker, rows, lines);
    if (!options_.finished_band) return 0;
    const Stopwatch watch;
    for (std::size_t i = 0; i < band_count(rows); ++i) {
        throw_if_interrupted();
        options_.finished_band(first_band(rows) + i);
    }
    return watch.seconds();
}

void RowPrinter::hand_on(PixelRect rows) const {
    if (!options_.finished_band) return;
    parallel_for(band_count(rows), threads_, [&](std::size_t i, int) { options_.finished_band(first_band(rows) + i); });
}

}  // namespace burin
