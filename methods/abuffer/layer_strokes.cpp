#include "methods/abuffer/layer_strokes.h"

#include <algorithm>
#include <bit>

#include "base/parallel.h"
#include "lines/stroke_mask.h"
#include "methods/abuffer/tile_lists.h"

namespace burin {
namespace {

constexpr int kTilePx = 32;
/// Narrower strokes are drawn this wide and as much lighter: masks have no finer samples.
constexpr double kFinestWidthPx = 0.25;

struct Pen {
    double radius_px;
    float strength;
    explicit Pen(double width_px)
        : radius_px(0.5 * std::max(width_px, kFinestWidthPx)),
          strength(static_cast<float>(width_px / std::max(width_px, kFinestWidthPx))) {}
};

template <typename Segment>
TileLists<const Segment*> sort_by_tile(const std::vector<std::vector<Segment>>& segments, const PixelTiles& grid,
                                       double reach_px) {
    std::vector<std::vector<typename TileLists<const Segment*>::Record>> records(segments.size());
    for (std::size_t i = 0; i < segments.size(); ++i) {
        for (const Segment& s : segments[i]) {
            grid.visit(glm::min(s.from, s.to) - reach_px, glm::max(s.from, s.to) + reach_px,
                       [&](std::uint32_t tile) { records[i].push_back({tile, &s}); });
        }
    }
    return TileLists<const Segment*>(records, grid.count());
}

float share(const StrokeMask& mask) {
    int count = 0;
    for (const std::uint32_t row : mask.rows) count += std::popcount(row);
    return static_cast<float>(count) / (StrokeMask::kRows * StrokeMask::kColumns);
}
void remove(StrokeMask& mask, const StrokeMask& taken) {
    for (std::size_t r = 0; r < mask.rows.size(); ++r) mask.rows[r] &= ~taken.rows[r];
}
void unite(StrokeMask& mask, const StrokeMask& other) {
    for (std::size_t r = 0; r < mask.rows.size(); ++r) mask.rows[r] |= other.rows[r];
}

/// The strokes of one tile. Buffers are used again.
class TileStrokes {
  public:
    struct Pixel {
        StrokeMask visible, through, hidden;  // samples drawn by each kind of line
        float ink = 0;                        // coverage of visible lines and those seen through
        LinePixel seen_through;
        float hidden_share = 0;               // coverage of hidden lines
        float hidden_seen = 0;                // of that, what no other line covers
        bool is_touched = false;
    };

    void reset(PixelRect rect) {
        rect_ = rect;
        pixels_.assign(static_cast<std::size_t>(rect.width() * rect.height()), Pixel{});
    }
    std::vector<Pixel>& pixels() { return pixels_; }

    /// Draws the segments chosen and calls use(pixel, mask) where there is any.
    template <typename Segment, typename Choose, typename Use>
    void draw(std::span<const Segment* const> segments, double radius_px, const Choose& choose, const Use& use) {
        canvas_.reset(rect_.x0, rect_.y0, rect_.width(), rect_.height());
        for (const Segment* s : segments) {
            if (choose(*s)) canvas_.draw(s->from, s->to, radius_px);
        }
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            const int column = static_cast<int>(i) % rect_.width(), row = static_cast<int>(i) / rect_.width();
            if (canvas_.is_touched(column, row)) use(pixels_[i], canvas_.at(column, row));
        }
    }

  private:
    PixelRect rect_;
    StrokeCanvas canvas_;
    std::vector<Pixel> pixels_;
};

void draw_seen_through(std::span<const LayerSegment* const> layers, int transmission, const Pen& pen,
                       const LineStyle& style, TileStrokes& strokes) {
    for (std::size_t c = 0; c < kLineClassCount; ++c) {
        const auto line_class = static_cast<LineClass>(c);
        const auto is_it = [&](const LayerSegment& s) {
            return !s.is_hidden && s.transmission == transmission && s.drawn_as == line_class;
        };
        if (std::none_of(layers.begin(), layers.end(), [&](const LayerSegment* s) { return is_it(*s); })) continue;
        const float strength = pen.strength * static_cast<float>(transmission) / 255.0f;
        strokes.draw(layers, pen.radius_px, is_it, [&](TileStrokes::Pixel& pixel, StrokeMask mask) {
            remove(mask, pixel.visible);
            remove(mask, pixel.through);
            unite(pixel.through, mask);
            const float coverage = strength * share(mask);
            pixel.seen_through.color += glm::vec4(style.color_of(line_class), 1.0f) * coverage;
            pixel.seen_through.coverage[c] += coverage;
            pixel.is_touched = true;
        });
    }
}

void draw_hidden(std::span<const LayerSegment* const> layers, int transmission, const Pen& pen,
                 TileStrokes& strokes) {
    const auto is_it = [&](const LayerSegment& s) { return s.is_hidden && s.transmission == transmission; };
    const float strength = pen.strength * static_cast<float>(transmission) / 255.0f;
    strokes.draw(layers, pen.radius_px, is_it, [&](TileStrokes::Pixel& pixel, StrokeMask mask) {
        remove(mask, pixel.hidden);
        unite(pixel.hidden, mask);
        pixel.hidden_share += strength * share(mask);
        remove(mask, pixel.visible);
        remove(mask, pixel.through);
        pixel.hidden_seen += strength * share(mask);
        pixel.is_touched = true;
    });
}

}  // namespace

void LayerStrokes::draw_below(PixelRect part, const std::vector<std::vector<LineSegment>>& visible,
                              const std::vector<std::vector<LayerSegment>>& layers, Film& film) {
    const LineStyle& style = frame_.scene->lines.style;
    const Pen pen(style.width_px), hidden_pen(style.hidden_width_px());
    const PixelTiles grid(part, kTilePx);
    const auto visible_in = sort_by_tile(visible, grid, pen.radius_px + 1);
    const auto layers_in = sort_by_tile(layers, grid, std::max(pen.radius_px, hidden_pen.radius_px) + 1);
    seen_through_.assign(grid.count(), {});
    std::vector<TileStrokes> workers(static_cast<std::size_t>(threads_));
    parallel_for(grid.count(), threads_, [&](std::size_t tile, int worker) {
        const auto list = layers_in.of(tile);
        if (list.empty()) return;
        TileStrokes& strokes = workers[static_cast<std::size_t>(worker)];
        const PixelRect rect = grid.tile(tile);
        strokes.reset(rect);
        strokes.draw(visible_in.of(tile), pen.radius_px, [](const LineSegment&) { return true; },
                     [&](TileStrokes::Pixel& pixel, const StrokeMask& mask) {
                         pixel.visible = mask;
                         pixel.ink = pen.strength * share(mask);
                     });
        // The least weakened ones first: they cover the others.
        std::vector<int> transmissions;
        for (const LayerSegment* s : list) transmissions.push_back(s->transmission);
        std::sort(transmissions.rbegin(), transmissions.rend());
        transmissions.erase(std::unique(transmissions.begin(), transmissions.end()), transmissions.end());
        for (const int t : transmissions) draw_seen_through(list, t, pen, style, strokes);
        for (const int t : transmissions) draw_hidden(list, t, hidden_pen, strokes);
        for (std::size_t i = 0; i < strokes.pixels().size(); ++i) {
            const TileStrokes::Pixel& pixel = strokes.pixels()[i];
            if (!pixel.is_touched) continue;
            const int x = rect.x0 + static_cast<int>(i) % rect.width();
            const int y = rect.y0 + static_cast<int>(i) / rect.width();
            // All kinds of lines are disjoint; visible ones come later and cover their share.
            const float left = 1.0f - pixel.ink;
            const glm::vec4 hidden_color(style.hidden.color, 1.0f);
            glm::vec4 seen = pixel.seen_through.color + hidden_color * pixel.hidden_seen;
            seen *= left > 0 ? std::min(1.0f / left, 1.0f / std::max(seen.a, 1e-6f)) : 0.0f;
            film.draw_hidden(x, y, hidden_color * pixel.hidden_share, seen);
            if (pixel.seen_through.color.a > 0) seen_through_[tile].push_back({x, y, pixel.seen_through});
        }
    });
}

void LayerStrokes::draw_above(Film& film) const {
    for (const auto& list : seen_through_) {
        for (const SeenThrough& p : list) film.add_lines(p.x, p.y, p.lines);
    }
}

}  // namespace burin
