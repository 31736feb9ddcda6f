#include "methods/abuffer/stroke_pass.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "lines/stroke_mask.h"

namespace burin {
namespace {

constexpr int kTilePx = 32;
/// Narrower strokes are drawn this wide and as much lighter: masks have no finer samples.
constexpr double kFinestWidthPx = 0.25;

/// Numbers of the segments whose strokes reach each tile, class by class.
class SegmentBins {
  public:
    SegmentBins(const std::vector<std::vector<LineSegment>>& segments, PixelRect region, double reach_px)
        : region_(region),
          columns_((region.width() + kTilePx - 1) / kTilePx),
          rows_((region.height() + kTilePx - 1) / kTilePx) {
        end_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
        const auto visit_all = [&](const auto& visit) {
            for (const auto& list : segments) {
                for (const LineSegment& s : list) for_tiles(s, reach_px, [&](std::size_t tile) { visit(tile, s); });
            }
        };
        visit_all([&](std::size_t tile, const LineSegment&) { ++end_[tile + 1]; });
        for (std::size_t i = 1; i < end_.size(); ++i) end_[i] += end_[i - 1];
        sorted_.resize(end_.back());
        std::vector<std::size_t> next = end_;
        visit_all([&](std::size_t tile, const LineSegment& s) { sorted_[next[tile]++] = &s; });
    }
    std::size_t tile_count() const { return end_.size() - 1; }
    PixelRect tile(std::size_t i) const {
        const int x0 = region_.x0 + static_cast<int>(i) % columns_ * kTilePx;
        const int y0 = region_.y0 + static_cast<int>(i) / columns_ * kTilePx;
        return {x0, y0, std::min(x0 + kTilePx, region_.x1), std::min(y0 + kTilePx, region_.y1)};
    }
    std::span<const LineSegment* const> segments(std::size_t i) const {
        return {sorted_.data() + end_[i], end_[i + 1] - end_[i]};
    }

  private:
    template <typename Visit>
    void for_tiles(const LineSegment& s, double reach, const Visit& visit) const {
        const glm::dvec2 origin(region_.x0, region_.y0);
        const glm::dvec2 low = (glm::min(s.from, s.to) - reach - origin) / double(kTilePx);
        const glm::dvec2 high = (glm::max(s.from, s.to) + reach - origin) / double(kTilePx);
        const int x0 = std::max(static_cast<int>(std::floor(low.x)), 0);
        const int y0 = std::max(static_cast<int>(std::floor(low.y)), 0);
        const int x1 = std::min(static_cast<int>(std::floor(high.x)), columns_ - 1);
        const int y1 = std::min(static_cast<int>(std::floor(high.y)), rows_ - 1);
        for (int y = y0; y <= y1; ++y) {
            for (int x = x0; x <= x1; ++x) visit(static_cast<std::size_t>(y * columns_ + x));
        }
    }

    PixelRect region_;
    int columns_, rows_;
    std::vector<std::size_t> end_;
    std::vector<const LineSegment*> sorted_;
};

}  // namespace

void draw_strokes(const Frame& frame, const std::vector<std::vector<LineSegment>>& segments, int threads,
                  Film& film) {
    const LineStyle& style = frame.scene->lines.style;
    const double width = std::max(style.width_px, kFinestWidthPx);
    const float strength = static_cast<float>(style.width_px / width);
    const SegmentBins bins(segments, frame.crop, 0.5 * width + 1.0);
    std::vector<StrokeCanvas> canvases(static_cast<std::size_t>(threads));
    std::vector<StrokeCanvas> taken(static_cast<std::size_t>(threads));
    parallel_for(bins.tile_count(), threads, [&](std::size_t index, int worker) {
        const auto list = bins.segments(index);
        if (list.empty()) return;
        const PixelRect rect = bins.tile(index);
        StrokeCanvas& canvas = canvases[static_cast<std::size_t>(worker)];
        LineClassSet present;
        for (const LineSegment* s : list) present |= s->drawn_as;
        const auto pixels = static_cast<std::size_t>(rect.width() * rect.height());
        std::vector<StrokeMask> drawn;
        std::vector<LinePixel> result(pixels);
        std::vector<std::uint8_t> touched(pixels, 0);
        drawn.resize(pixels);
        for (int c = 0; c < kLineClassCount; ++c) {
            const auto line_class = static_cast<LineClass>(c);
            if (!present.has(line_class)) continue;
            canvas.reset(rect.x0, rect.y0, rect.width(), rect.height());
            for (const LineSegment* s : list) {
                if (s->drawn_as == line_class) canvas.draw(s->from, s->to, 0.5 * width);
            }
            for (std::size_t i = 0; i < pixels; ++i) {
                const int column = static_cast<int>(i) % rect.width(), row = static_cast<int>(i) / rect.width();
                if (!canvas.is_touched(column, row)) continue;
                StrokeMask fresh = canvas.at(column, row);
                for (std::size_t r = 0; r < fresh.rows.size(); ++r) {
                    fresh.rows[r] &= ~drawn[i].rows[r];
                    drawn[i].rows[r] |= fresh.rows[r];
                }
                const float coverage =
                    strength * static_cast<float>(fresh.count()) / (StrokeMask::kRows * StrokeMask::kColumns);
                result[i].coverage[static_cast<std::size_t>(c)] = coverage;
                result[i].color += glm::vec4(style.color_of(line_class), 1.0f) * coverage;
                touched[i] = 1;
            }
        }
        for (std::size_t i = 0; i < pixels; ++i) {
            if (touched[i] == 0) continue;
            film.draw_over(rect.x0 + static_cast<int>(i) % rect.width(),
                           rect.y0 + static_cast<int>(i) / rect.width(), result[i]);
        }
    });
}

}  // namespace burin
