#include "methods/abuffer/stroke_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/parallel.h"
#include "lines/stroke_mask.h"
#include "methods/abuffer/faded_strokes.h"

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

/// The strokes of one tile, class by class.
class StrokeTile {
  public:
    explicit StrokeTile(const TileKernels& kernels) : kernels_(kernels), faded_(kernels) {
        for (StrokeCanvas& canvas : canvases_) canvas = StrokeCanvas(kernels);
    }

    void draw(std::span<const LineSegment* const> segments, PixelRect rect, double radius_px) {
        rect_ = rect;
        present_ = LineClassSet();
        faded_.draw(segments, rect, radius_px);
        for (const LineSegment* s : segments) {
            if (s->opacity < 255) continue;
            StrokeCanvas& canvas = canvas_of(s->drawn_as);
            if (!present_.has(s->drawn_as)) canvas.reset(rect.x0, rect.y0, rect.width(), rect.height());
            present_ |= s->drawn_as;
            canvas.draw(s->from, s->to, radius_px);
        }
    }

    void put(const LineStyle& style, float strength, Film& film) {
        std::vector<LineClass>& classes = classes_;
        classes.clear();
        for (int c = 0; c < kLineClassCount; ++c) {
            if (present_.has(static_cast<LineClass>(c))) classes.push_back(static_cast<LineClass>(c));
        }
        for (int row = 0; row < rect_.height(); ++row) {
            for (int column = 0; column < rect_.width(); ++column) {
                bool touched = faded_.is_touched(column, row);
                for (const LineClass c : classes) touched = touched || canvas_of(c).is_touched(column, row);
                if (touched) film.draw_over(rect_.x0 + column, rect_.y0 + row, pixel(column, row, style, strength));
            }
        }
    }

  private:
    StrokeCanvas& canvas_of(LineClass c) { return canvases_[static_cast<std::size_t>(c)]; }

    /// Where classes overlap, the first one counts.
    LinePixel pixel(int column, int row, const LineStyle& style, float strength) {
        LinePixel result;
        StrokeMask drawn;
        for (const LineClass c : classes_) {
            if (!canvas_of(c).is_touched(column, row)) continue;
            const StrokeMask& mask = canvas_of(c).at(column, row);
            const int fresh = kernels_.count_bits(mask.rows.data(), drawn.rows.data());
            for (std::size_t r = 0; r < mask.rows.size(); ++r) drawn.rows[r] |= mask.rows[r];
            const float coverage = strength * static_cast<float>(fresh) / (StrokeMask::kRows * StrokeMask::kColumns);
            result.coverage[static_cast<std::size_t>(c)] = coverage;
            result.color += glm::vec4(style.color_of(c), 1.0f) * coverage;
        }
        if (faded_.is_touched(column, row)) {  // all are creases
            const float coverage = strength * faded_.coverage(column, row, drawn);
            result.coverage[static_cast<std::size_t>(LineClass::crease)] += coverage;
            result.color += glm::vec4(style.color_of(LineClass::crease), 1.0f) * coverage;
        }
        return result;
    }

    const TileKernels& kernels_;
    std::array<StrokeCanvas, kLineClassCount> canvases_;
    FadedStrokes faded_;
    PixelRect rect_;
    LineClassSet present_;
    std::vector<LineClass> classes_;
};

}  // namespace

void draw_strokes(const Frame& frame, const std::vector<std::vector<LineSegment>>& segments,
                  const TileKernels& kernels, int threads, Film& film) {
    const LineStyle& style = frame.scene->lines.style;
    const double width = std::max(style.width_px, kFinestWidthPx);
    const float strength = static_cast<float>(style.width_px / width);
    const SegmentBins bins(segments, frame.crop, 0.5 * width + 1.0);
    std::vector<StrokeTile> tiles(static_cast<std::size_t>(threads), StrokeTile(kernels));
    parallel_for(bins.tile_count(), threads, [&](std::size_t index, int worker) {
        const auto list = bins.segments(index);
        if (list.empty()) return;
        StrokeTile& tile = tiles[static_cast<std::size_t>(worker)];
        tile.draw(list, bins.tile(index), 0.5 * width);
        tile.put(style, strength, film);
    });
}

}  // namespace burin
