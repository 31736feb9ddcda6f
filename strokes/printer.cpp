#include "strokes/printer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>

#include "base/parallel.h"
#include "strokes/pixel_filter.h"
#include "strokes/visible_strokes.h"

namespace burin {
namespace {

constexpr int kTilePx = HiddenStrokes::kTilePx;

}  // namespace

/// Bins sort pieces to the tiles that their strokes reach, in the order of the lists.
class StrokePrinter::Bins {
  public:
    Bins(const Lists& segments, PixelRect region, double reach_px)
        : region_(region),
          columns_((region.width() + kTilePx - 1) / kTilePx),
          rows_((region.height() + kTilePx - 1) / kTilePx) {
        end_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
        std::vector<Place> places;
        for (const auto& list : segments) {
            for (const LinePiece& s : list) {
                constexpr std::ptrdiff_t kAhead = 16;
                if (list.data() + list.size() - &s > kAhead) __builtin_prefetch(&s + kAhead);
                const std::optional<Place> place = place_of(s, reach_px);
                if (!place) continue;
                places.push_back(*place);
                for_tiles(*place, [&](std::size_t tile) { ++end_[tile + 1]; });
            }
        }
        for (std::size_t i = 1; i < end_.size(); ++i) end_[i] += end_[i - 1];
        sorted_.resize(end_.back());
        std::vector<std::size_t> next = end_;
        for (const Place& place : places) {
            for_tiles(place, [&](std::size_t tile) { sorted_[next[tile]++] = place.segment; });
        }
    }
    std::size_t tile_count() const { return end_.size() - 1; }
    PixelRect tile(std::size_t i) const {
        const int x0 = region_.x0 + static_cast<int>(i) % columns_ * kTilePx;
        const int y0 = region_.y0 + static_cast<int>(i) / columns_ * kTilePx;
        return {x0, y0, std::min(x0 + kTilePx, region_.x1), std::min(y0 + kTilePx, region_.y1)};
    }
    std::span<const LinePiece* const> segments(std::size_t i) const {
        return {sorted_.data() + end_[i], end_[i + 1] - end_[i]};
    }

  private:
    /// A piece and the columns and rows of tiles that its stroke may reach, the last ones included.
    struct Place {
        const LinePiece* segment;
        int x0, y0, x1, y1;
    };
    std::optional<Place> place_of(const LinePiece& s, double reach) const {
        struct Range {
            double low, high;
        };
        const auto range = [reach](double from, double to, int origin) {
            return Range{(std::min(from, to) - reach - origin) / double(kTilePx),
                         (std::max(from, to) + reach - origin) / double(kTilePx)};
        };
        // Most pieces that reach no tile lie above or below all of them.
        const Range y = range(s.from.y, s.to.y, region_.y0);
        if (!(y.high >= 0 && y.low < rows_)) return std::nullopt;
        const Range x = range(s.from.x, s.to.x, region_.x0);
        if (!(x.high >= 0 && x.low < columns_)) return std::nullopt;
        return Place{&s, static_cast<int>(std::max(x.low, 0.0)), static_cast<int>(std::max(y.low, 0.0)),
                     static_cast<int>(std::min(x.high, columns_ - 1.0)),
                     static_cast<int>(std::min(y.high, rows_ - 1.0))};
    }
    template <typename Visit>
    void for_tiles(const Place& place, const Visit& visit) const {
        for (int y = place.y0; y <= place.y1; ++y) {
            for (int x = place.x0; x <= place.x1; ++x) visit(static_cast<std::size_t>(y * columns_ + x));
        }
    }

    PixelRect region_;
    int columns_, rows_;
    std::vector<std::size_t> end_;
    std::vector<const LinePiece*> sorted_;
};

namespace {

/// Lines of one pixel before filters' negative lobes are cut off.
using Coverages = std::array<float, kLineClassCount>;

/// Brings coverages within 0..1, so that their sum stays, where that is possible.
void clamp(Coverages& coverages) {
    float sum = 0, positive = 0;
    for (float& c : coverages) {
        sum += c;
        c = std::max(c, 0.0f);
        positive += c;
    }
    const float scale = positive > 0 ? std::clamp(sum, 0.0f, 1.0f) / positive : 0.0f;
    for (float& c : coverages) c *= scale;
}

}  // namespace

/// Printer puts the strokes of one tile after the other over a film.
class StrokePrinter::Printer {
  public:
    Printer(const Frame& frame, const TileKernels& kernels)
        : style_(frame.scene->lines.style), kernels_(kernels), strokes_(frame, kernels) {}

    /// Draws a tile's strokes into masks, for print() and for whoever asks for strokes().
    void draw(std::span<const LinePiece* const> segments, PixelRect rect, int reach) {
        strokes_.draw(segments, {rect.x0 - reach, rect.y0 - reach, rect.x1 + reach, rect.y1 + reach});
    }
    const VisibleStrokes& strokes() const { return strokes_; }

    /// Draws the tile on the film where each pixel sees its own square.
    void print(PixelRect rect, Film& film) {
        touched_.clear();
        strokes_.for_touched([&](int column, int row) {
            if (touched_.empty() || touched_.back().row != row) film.prefetch(rect.x0 + column, rect.y0 + row);
            touched_.push_back({column, row});
        });
        const StrokeMask nothing;
        for (const auto [column, row] : touched_) {
            const int x = rect.x0 + column, y = rect.y0 + row;
            if (const std::optional<LineClass> c = strokes_.only_class(column, row)) {  // mostly
                const int samples =
                    kernels_.stroke.count_bits(strokes_.mask_of(*c, column, row).rows.data(), nothing.rows.data());
                film.draw_over(x, y, ink_of(*c)[samples]);
                continue;
            }
            LinePixel pixel;
            LineClassSet present;
            strokes_.for_classes(
                column, row, [&](LineClass c, const StrokeMask& mask, const StrokeMask& taken, float opacity) {
                    present |= c;
                    add(c, opacity, kernels_.stroke.count_bits(mask.rows.data(), taken.rows.data()), pixel);
                });
            color(pixel, present);
            film.draw_over(x, y, pixel);
        }
    }

    /// Draws the tile on the film where each pixel sees what the filter's weights make of its surroundings.
    void print(PixelRect rect, const FilterTable& filter, Film& film) {
        filtered_.assign(static_cast<std::size_t>(rect.width() * rect.height()), Coverages{});
        strokes_.for_touched([&](int column, int row) {
            strokes_.for_classes(
                column, row, [&](LineClass c, StrokeMask mask, const StrokeMask& taken, float opacity) {
                    for (std::size_t r = 0; r < mask.rows.size(); ++r) mask.rows[r] &= ~taken.rows[r];
                    spread(filter.shares_of(mask), opacity * strokes_.pen().strength, c, column, row, rect);
                });
        });
        for (std::size_t i = 0; i < filtered_.size(); ++i) {
            if (filtered_[i] == Coverages{}) continue;
            clamp(filtered_[i]);
            const int x = static_cast<int>(i) % rect.width(), y = static_cast<int>(i) / rect.width();
            LinePixel pixel;
            pixel.coverage = filtered_[i];
            color(pixel, LineClassSet::all());
            film.draw_over(rect.x0 + x, rect.y0 + y, pixel);
        }
    }

  private:
    /// Column and row count from the first pixels within the filter's reach of `rect`.
    void spread(const FilterTable::Shares& shares, float strength, LineClass c, int column, int row, PixelRect rect) {
        for (int dy = 0; dy < FilterTable::kSide; ++dy) {
            for (int dx = 0; dx < FilterTable::kSide; ++dx) {
                const int x = column + dx - 2 * FilterTable::kReach, y = row + dy - 2 * FilterTable::kReach;
                if (x < 0 || y < 0 || x >= rect.width() || y >= rect.height()) continue;
                filtered_[static_cast<std::size_t>(y * rect.width() + x)][static_cast<std::size_t>(c)] +=
                    strength * shares[static_cast<std::size_t>(dy)][static_cast<std::size_t>(dx)];
            }
        }
    }

    void add(LineClass c, float opacity, int samples, LinePixel& pixel) const {
        pixel.coverage[static_cast<std::size_t>(c)] += opacity * strokes_.pen().strength * static_cast<float>(samples) /
                                                       (StrokeMask::kRows * StrokeMask::kColumns);
    }
    /// The inks of a pixel that has one class alone, by how many of its samples it covers.
    const LineInk* ink_of(LineClass c) {
        std::vector<LineInk>& inks = inks_[static_cast<std::size_t>(c)];
        for (int samples = static_cast<int>(inks.size()); samples <= StrokeMask::kRows * StrokeMask::kColumns;
             ++samples) {
            LinePixel pixel;
            add(c, 1.0f, samples, pixel);
            color(pixel, c);
            inks.emplace_back(pixel);
        }
        return inks.data();
    }
    /// Sets the colour from the coverages. `present`: no other classes have any coverage.
    void color(LinePixel& pixel, LineClassSet present) const {
        for (unsigned bits = present.bits; bits != 0; bits &= bits - 1) {
            const auto c = static_cast<std::size_t>(std::countr_zero(bits));
            if (pixel.coverage[c] == 0) continue;
            pixel.color += glm::vec4(style_.color_of(static_cast<LineClass>(c)), 1.0f) * pixel.coverage[c];
        }
    }

    const LineStyle& style_;
    const TileKernels& kernels_;
    VisibleStrokes strokes_;
    struct Pixel {
        int column, row;
    };
    std::vector<Pixel> touched_;
    std::vector<Coverages> filtered_;
    std::array<std::vector<LineInk>, kLineClassCount> inks_;
};

StrokePrinter::StrokePrinter(const Frame& frame, const TileKernels& kernels, int threads, Film& film)
    : frame_(frame),
      film_(film),
      filter_(FilterTable::make(frame.scene->lines.style.filter)),
      printers_(static_cast<std::size_t>(threads), Printer(frame, kernels)) {}
StrokePrinter::~StrokePrinter() = default;

StrokePrinter::Bins StrokePrinter::sort(PixelRect part, const Lists& lines) const {
    const LineStyle& style = frame_.scene->lines.style;
    return {lines, part, Pen(style.width_px, style.side).radius_px + reach_px(style.filter) + 1.0};
}

void StrokePrinter::print(int worker, const Bins& bins, std::size_t index, HiddenStrokes* behind) {
    const auto lines = bins.segments(index);
    const bool has_behind = behind != nullptr && behind->has_any(index);
    if (lines.empty() && !has_behind) return;
    Printer& printer = printers_[static_cast<std::size_t>(worker)];
    const PixelRect tile = bins.tile(index);
    printer.draw(lines, tile, filter_ ? FilterTable::kReach : 0);
    if (has_behind) behind->draw_below(worker, index, printer.strokes(), film_);
    if (filter_) {
        printer.print(tile, *filter_, film_);
    } else {
        printer.print(tile, film_);
    }
    if (has_behind) behind->draw_above(worker, film_);
}

void StrokePrinter::draw(PixelRect part, const Lists& lines, HiddenStrokes* behind) {
    const Bins bins = sort(part, lines);
    parallel_for(bins.tile_count(), static_cast<int>(printers_.size()),
                 [&](std::size_t i, int worker) { print(worker, bins, i, behind); });
}

void StrokePrinter::draw_as(int worker, PixelRect part, const Lists& lines) {
    const Bins bins = sort(part, lines);
    for (std::size_t i = 0; i < bins.tile_count(); ++i) print(worker, bins, i, nullptr);
}

}  // namespace burin
