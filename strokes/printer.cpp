#include "strokes/printer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>
#include <span>

#include "base/parallel.h"
#include "strokes/pixel_filter.h"
#include "strokes/tile_mattes.h"
#include "strokes/visible_strokes.h"

namespace burin {
namespace {

constexpr int kTilePx = HiddenStrokes::kTilePx;

}  // namespace

/// A part of the picture in tiles, and the pieces whose strokes reach each, in the order of the lists.
struct StrokePrinter::Bins {
    PixelTiles tiles;
    TileLists<const LinePiece*> pieces;

    Bins(const Lists& lists, PixelRect part, double reach_px) : tiles(part, kTilePx) {
        std::vector<std::vector<TileLists<const LinePiece*>::Record>> records(1);
        for (const std::span<const LinePiece> list : lists) {
            for (const LinePiece& piece : list) {
                constexpr std::ptrdiff_t kAhead = 16;
                if (list.data() + list.size() - &piece > kAhead) __builtin_prefetch(&piece + kAhead);
                tiles.visit(glm::min(piece.from, piece.to) - reach_px, glm::max(piece.from, piece.to) + reach_px,
                            [&](std::uint32_t tile) {
                                records[0].push_back({tile, &piece});
                            });
            }
        }
        pieces = TileLists<const LinePiece*>(records, tiles.count());
    }
};

namespace {

/// Lines of one pixel before filters' negative lobes are cut off.
using Coverages = std::array<float, kLineClassCount>;

/// Brings coverages within 0..1, so that their sum stays, where that is possible.
void clamp_coverages(Coverages& coverages) {
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
    void draw(std::span<const LinePiece* const> pieces, PixelRect rect, int reach) {
        strokes_.draw(pieces, {rect.x0 - reach, rect.y0 - reach, rect.x1 + reach, rect.y1 + reach});
    }
    const VisibleStrokes& strokes() const { return strokes_; }

    /// Begins to tell whose the strokes of a tile are.
    TileMattes* begin_mattes(std::span<const LinePiece* const> pieces, PixelRect rect, const Frame& frame,
                             Mattes& mattes, const FilterTable* filter) {
        if (!mattes_) mattes_ = std::make_shared<TileMattes>(frame, mattes, filter, kernels_);
        mattes_->begin(rect);
        mattes_->add_pieces(pieces, strokes_.pen().radius_px, style_.width_px, [](const LinePiece& piece) {
            return piece.is_drawn ? std::optional(group_of(piece.drawn_as, piece.opacity)) : std::nullopt;
        });
        strokes_.for_touched([&](int column, int row) {
            strokes_.for_classes(column, row,
                                 [&](LineClass c, StrokeMask mask, const StrokeMask& taken, float opacity) {
                                     for (std::size_t r = 0; r < mask.rows.size(); ++r) mask.rows[r] &= ~taken.rows[r];
                                     const auto of_255 = static_cast<std::uint8_t>(std::lround(opacity * 255.0f));
                                     TileMattes::Kind kind;
                                     kind.group = group_of(c, of_255);
                                     kind.strength = opacity * strokes_.pen().strength;
                                     kind.is_opaque = of_255 == 255;
                                     kind.color = style_.color_of(c);
                                     mattes_->add(column, row, mask, kind);
                                 });
        });
        return mattes_.get();
    }

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
            clamp_coverages(filtered_[i]);
            const int x = static_cast<int>(i) % rect.width(), y = static_cast<int>(i) / rect.width();
            LinePixel pixel;
            pixel.coverage = filtered_[i];
            color(pixel, LineClassSet::all());
            film.draw_over(rect.x0 + x, rect.y0 + y, pixel);
        }
    }

  private:
    /// What is drawn into one mask.
    static std::uint32_t group_of(LineClass c, std::uint8_t opacity) {
        return static_cast<std::uint32_t>(c) << 8 | opacity;
    }
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
    std::shared_ptr<TileMattes> mattes_;  // made when it is needed
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
    const auto lines = bins.pieces.of(index);
    const bool has_behind = behind != nullptr && behind->has_any(index);
    if (lines.empty() && !has_behind) return;
    Printer& printer = printers_[static_cast<std::size_t>(worker)];
    const PixelRect tile = bins.tiles.tile(index);
    printer.draw(lines, tile, filter_ ? FilterTable::kReach : 0);
    TileMattes* mattes = nullptr;
    if (film_.mattes() != nullptr) mattes = printer.begin_mattes(lines, tile, frame_, *film_.mattes(), filter_.get());
    if (has_behind) behind->draw_below(worker, index, printer.strokes(), film_, mattes);
    if (filter_) {
        printer.print(tile, *filter_, film_);
    } else {
        printer.print(tile, film_);
    }
    if (has_behind) behind->draw_above(worker, film_);
    if (mattes != nullptr) mattes->finish();
}

void StrokePrinter::draw(PixelRect part, const Lists& lines, HiddenStrokes* behind) {
    const Bins bins = sort(part, lines);
    parallel_for(bins.tiles.count(), static_cast<int>(printers_.size()),
                 [&](std::size_t i, int worker) { print(worker, bins, i, behind); });
}

void StrokePrinter::draw_as(int worker, PixelRect part, const Lists& lines) {
    const Bins bins = sort(part, lines);
    for (std::size_t i = 0; i < bins.tiles.count(); ++i) print(worker, bins, i, nullptr);
}

}  // namespace burin
