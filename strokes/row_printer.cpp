#include "strokes/row_printer.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "base/stopwatch.h"

namespace burin {
namespace {

/// The most bands that one thread draws before it goes on with tiles, and that all threads draw together.
constexpr int kMostBandsOfOne = 8, kMostBandsOfAll = 1 << 20;

}  // namespace

RowPrinter::RowPrinter(const Frame& frame, const RunOptions& options, const LineDrawing& drawing, Film& film)
    : frame_(frame),
      options_(options),
      drawing_(drawing),
      threads_(resolve_thread_count(options.threads)),
      crop_(frame.crop),
      reach_px_(frame.scene->lines.style.reach_px() + 2),
      has_mattes_(film.mattes() != nullptr),
      strokes_(frame, best_kernels(), threads_, film),
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

StrokePrinter::Lists RowPrinter::lines_reaching(PixelRect rows, int known_y) const {
    return drawing_.visible_in_rows(rows.y0 - reach_px_, known_y);
}

std::size_t RowPrinter::first_band(PixelRect rows) const {
    return static_cast<std::size_t>((rows.y0 - crop_.y0) / Film::kBandRows);
}

std::size_t RowPrinter::band_count(PixelRect rows) const {
    return static_cast<std::size_t>((rows.height() + Film::kBandRows - 1) / Film::kBandRows);
}

double RowPrinter::draw_rows_as(int worker, int known_y) {
    const PixelRect rows = take(known_y, kMostBandsOfOne);
    if (rows.height() == 0) return 0;
    strokes_.draw_as(worker, rows, lines_reaching(rows, known_y));
    if (!hands_on()) return 0;
    const Stopwatch watch;
    for (std::size_t i = 0; i < band_count(rows); ++i) {
        throw_if_interrupted();
        options_.finished_band(first_band(rows) + i);
    }
    return watch.seconds();
}

double RowPrinter::draw_rows(int known_y) {
    const PixelRect rows = take(known_y, kMostBandsOfAll);
    if (rows.height() == 0) return 0;
    std::optional<HiddenStrokes> behind;
    if (frame_.needs.behind()) behind.emplace(frame_, best_kernels(), threads_, rows, drawing_.behind(), has_mattes_);
    strokes_.draw(rows, lines_reaching(rows, known_y), behind ? &*behind : nullptr);
    if (!hands_on()) return 0;
    const Stopwatch watch;
    parallel_for(band_count(rows), threads_, [&](std::size_t i, int) { options_.finished_band(first_band(rows) + i); });
    return watch.seconds();
}

}  // namespace burin
