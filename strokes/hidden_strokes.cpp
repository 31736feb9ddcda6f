#include "strokes/hidden_strokes.h"

#include <algorithm>
#include <array>
#include <optional>

#include "shading/dash_style.h"
#include "shading/pen.h"
#include "strokes/tile_mattes.h"

namespace burin {
namespace {

bool is_wanted(const LinePiece& piece, const LineStyle& style) {
    return piece.transmission > 0 && !(piece.is_hidden() && style.hidden.style == HiddenStyle::none);
}

/// Calls use(piece) for the pieces that are to be drawn: those that follow each other and look alike are one stroke,
/// which is kept in `joined`.
template <typename Use>
void for_strokes(std::span<const LinePiece> pieces, const LineStyle& style, std::deque<LinePiece>& joined,
                 const Use& use) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const LinePiece* piece = &pieces[i];
        for (; i + 1 < pieces.size() && goes_on_alike(*piece, pieces[i + 1]); ++i) {
            if (piece == &pieces[i]) piece = &joined.emplace_back(pieces[i]);
            extend(joined.back(), pieces[i + 1]);
        }
        if (is_wanted(*piece, style)) use(*piece);
    }
}

void remove(StrokeMask& mask, const StrokeMask& taken) {
    for (std::size_t r = 0; r < mask.rows.size(); ++r) mask.rows[r] &= ~taken.rows[r];
}

/// TileStrokes keeps what each pixel of one tile has of lines. Buffers are used again, and only what was used is
/// cleared.
class TileStrokes {
  public:
    struct Pixel {
        StrokeMask visible, through, hidden;  // samples drawn by each kind of line
        float ink = 0;                        // coverage of visible lines and those seen through
        LinePixel seen_through;
        float hidden_share = 0;  // coverage of hidden lines
        float hidden_seen = 0;   // of that, what no other line covers
        bool is_used = false;
        bool is_touched = false;
    };

    TileStrokes(const FilterTable* filter, const TileKernels& kernels)
        : filter_(filter), kernels_(kernels), canvas_(kernels) {}

    void reset(PixelRect rect) {
        rect_ = rect;
        for (const std::size_t i : used_) pixels_[i] = Pixel{};
        used_.clear();
        pixels_.resize(static_cast<std::size_t>(rect.width() * rect.height()));
    }
    Pixel& pixel(std::size_t i) {
        Pixel& p = pixels_[i];
        if (!p.is_used) used_.push_back(i);
        p.is_used = true;
        return p;
    }
    PixelRect rect() const { return rect_; }
    /// The pixels that pixel() was asked for.
    std::span<const std::size_t> used() const { return used_; }

    /// Draws the pieces chosen and calls use(pixel, mask) for the pixels that they touch.
    template <typename Segment, typename Choose, typename Use>
    void draw(std::span<const Segment* const> segments, double radius_px, const Choose& choose, const Use& use) {
        canvas_.reset(rect_.x0, rect_.y0, rect_.width(), rect_.height());
        for (const Segment* s : segments) {
            if (choose(*s)) canvas_.draw(s->from, s->to, radius_px);
        }
        canvas_.for_touched([&](int column, int row) { use(index(column, row), canvas_.at(column, row)); });
    }

    /// Calls add(pixel, share) for the pixels that see samples of pixel `i`.
    template <typename Add>
    void spread(std::size_t i, const StrokeMask& mask, const Add& add) {
        if (filter_ == nullptr) return add(pixel(i), share(mask));
        const FilterTable::Shares shares = filter_->shares_of(mask);
        const int column = static_cast<int>(i) % rect_.width(), row = static_cast<int>(i) / rect_.width();
        for (int dy = -FilterTable::kReach; dy <= FilterTable::kReach; ++dy) {
            for (int dx = -FilterTable::kReach; dx <= FilterTable::kReach; ++dx) {
                const int x = column + dx, y = row + dy;
                if (x < 0 || y < 0 || x >= rect_.width() || y >= rect_.height()) continue;
                add(pixel(index(x, y)), shares[static_cast<std::size_t>(dy + FilterTable::kReach)]
                                              [static_cast<std::size_t>(dx + FilterTable::kReach)]);
            }
        }
    }

    /// Says whose the samples of a pixel are, if it is asked.
    void add(TileMattes* mattes, std::size_t i, const StrokeMask& mask, const TileMattes::Kind& kind) const {
        if (mattes == nullptr) return;
        mattes->add(static_cast<int>(i) % rect_.width(), static_cast<int>(i) / rect_.width(), mask, kind);
    }

    static constexpr int kSamples = StrokeMask::kRows * StrokeMask::kColumns;
    /// How many samples of a pixel are in a mask and not taken.
    int count(const StrokeMask& mask, const StrokeMask& taken = {}) const {
        return kernels_.stroke.count_bits(mask.rows.data(), taken.rows.data());
    }
    float share(const StrokeMask& mask, const StrokeMask& taken = {}) const { return share(count(mask, taken)); }
    static float share(int samples) { return static_cast<float>(samples) / kSamples; }

  private:
    std::size_t index(int column, int row) const { return static_cast<std::size_t>(row * rect_.width() + column); }

    const FilterTable* filter_;
    const TileKernels& kernels_;
    PixelRect rect_;
    StrokeCanvas canvas_;
    std::vector<Pixel> pixels_;
    std::vector<std::size_t> used_;
};

/// What is drawn into one mask.
std::uint32_t group_of(bool is_hidden, int opacity, LineClass drawn_as) {
    return (is_hidden ? 2u : 1u) << 16 | static_cast<std::uint32_t>(opacity) |
           (is_hidden ? 0 : static_cast<std::uint32_t>(drawn_as) << 8);
}

void draw_seen_through(std::span<const LinePiece* const> layers, int opacity, const Pen& pen, const LineStyle& style,
                       TileStrokes& strokes, TileMattes* mattes) {
    for (std::size_t c = 0; c < kLineClassCount; ++c) {
        const auto line_class = static_cast<LineClass>(c);
        const auto is_it = [&](const LinePiece& s) {
            return !s.is_hidden() && s.seen_opacity() == opacity && s.drawn_as == line_class;
        };
        if (std::none_of(layers.begin(), layers.end(), [&](const LinePiece* s) { return is_it(*s); })) continue;
        const float strength = pen.strength * static_cast<float>(opacity) / 255.0f;
        strokes.draw(layers, pen.radius_px, is_it, [&](std::size_t i, StrokeMask mask) {
            TileStrokes::Pixel& own = strokes.pixel(i);
            remove(mask, own.visible);
            remove(mask, own.through);
            unite(own.through, mask);
            strokes.add(mattes, i, mask,
                        {group_of(false, opacity, line_class), strength, false, true, false, 0,
                         style.color_of(line_class), MatteUse::both, true});
            strokes.spread(i, mask, [&](TileStrokes::Pixel& pixel, float share) {
                const float coverage = strength * share;
                pixel.seen_through.color += glm::vec4(style.color_of(line_class), 1.0f) * coverage;
                pixel.seen_through.coverage[c] += coverage;
                pixel.is_touched = true;
            });
        });
    }
}

/// What mattes are to know of hidden strokes. Those of deep files are all that there are; others are what visible ones
/// leave of them.
TileMattes::Kind hidden_kind(int opacity, float strength, const LineStyle& style, MatteUse use) {
    return {group_of(true, opacity, {}), strength, true, true, false, 0, style.hidden.color, use};
}

void draw_hidden(std::span<const LinePiece* const> layers, int opacity, const Pen& pen, const LineStyle& style,
                 TileStrokes& strokes, TileMattes* mattes) {
    const auto is_it = [&](const LinePiece& s) { return s.is_hidden() && s.seen_opacity() == opacity; };
    const float strength = pen.strength * static_cast<float>(opacity) / 255.0f;
    strokes.draw(layers, pen.radius_px, is_it, [&](std::size_t i, StrokeMask mask) {
        TileStrokes::Pixel& own = strokes.pixel(i);
        remove(mask, own.hidden);
        unite(own.hidden, mask);
        if (mattes != nullptr && mattes->wants_deep_hidden())
            strokes.add(mattes, i, mask, hidden_kind(opacity, strength, style, MatteUse::deep));
        strokes.spread(i, mask, [&](TileStrokes::Pixel& pixel, float share) {
            pixel.hidden_share += strength * share;
            pixel.is_touched = true;
        });
        remove(mask, own.visible);
        remove(mask, own.through);
        strokes.add(mattes, i, mask, hidden_kind(opacity, strength, style, MatteUse::flat));
        strokes.spread(i, mask, [&](TileStrokes::Pixel& pixel, float share) { pixel.hidden_seen += strength * share; });
    });
}

/// Cuts off what a filter's negative lobes take away beside a line, and add in its middle.
void cut_off_lobes(TileStrokes::Pixel& pixel) {
    for (float* share : {&pixel.ink, &pixel.hidden_share, &pixel.hidden_seen}) *share = std::clamp(*share, 0.0f, 1.0f);
    pixel.seen_through.color = glm::clamp(pixel.seen_through.color, 0.0f, 1.0f);
    for (float& c : pixel.seen_through.coverage) c = std::clamp(c, 0.0f, 1.0f);
}

/// The samples of a pixel that opaque visible strokes take; hidden lines shine through strokes that fade.
StrokeMask taken_by(const VisibleStrokes& visible, int column, int row) {
    StrokeMask taken;
    visible.for_classes(column, row, [&](LineClass, const StrokeMask& mask, const StrokeMask&, float opacity) {
        if (opacity == 1.0f) unite(taken, mask);
    });
    return taken;
}

/// The ink of a pixel's lines behind surfaces. All kinds of lines are disjoint; visible ones come later and cover their
/// share, `ink`.
HiddenInk hidden_ink(const LineStyle& style, float ink, const glm::vec4& seen_through, float hidden_share,
                     float hidden_seen) {
    const float left = 1.0f - ink;
    const glm::vec4 hidden_color(style.hidden.color, 1.0f);
    glm::vec4 seen = seen_through + hidden_color * hidden_seen;
    seen *= left > 0 ? std::min(1.0f / left, 1.0f / std::max(seen.a, 1e-6f)) : 0.0f;
    return {hidden_color * hidden_share, seen};
}

}  // namespace

class HiddenStrokes::Worker {
  public:
    Worker(const LineStyle& style, const FilterTable* filter, const TileKernels& kernels)
        : style_(style),
          filter_(filter),
          reach_(reach_px(style.filter)),
          pen_(style.width_px, StrokeSide::both, visible_dashes(style).opacity),
          hidden_pen_(style.hidden_width_px(), StrokeSide::both, hidden_dashes(style).opacity),
          strokes_(filter, kernels) {}

    void draw_below(std::span<const LinePiece* const> list, std::span<const LinePiece* const> single, PixelRect inner,
                    const VisibleStrokes& visible, Film& film, TileMattes* mattes) {
        mattes_ = mattes;
        if (mattes != nullptr) {
            const auto add = [&](bool is_hidden, const Pen& pen, double width_px) {
                mattes->add_pieces(single, pen.radius_px, width_px, [&](const LinePiece& s) {
                    return s.is_hidden() == is_hidden ? std::optional(group_of(is_hidden, s.seen_opacity(), s.drawn_as))
                                                      : std::nullopt;
                });
            };
            add(false, pen_, style_.width_px);
            add(true, hidden_pen_, style_.hidden_width_px());
        }
        seen_through_.clear();
        const LinePiece& first = *list.front();
        const bool is_plain = filter_ == nullptr && std::all_of(list.begin(), list.end(), [&](const LinePiece* s) {
                                  return s->is_hidden() && s->seen_opacity() == first.seen_opacity();
                              });
        strokes_.reset({inner.x0 - reach_, inner.y0 - reach_, inner.x1 + reach_, inner.y1 + reach_});
        if (is_plain) {
            draw_plain(list, inner, visible, film);
        } else {
            draw_all(list, inner, visible, film);
        }
    }

    void draw_above(Film& film) const {
        for (const SeenThrough& p : seen_through_) film.add_lines(p.x, p.y, p.lines);
    }

  private:
    struct SeenThrough {
        int x, y;
        LinePixel lines;
    };

    void draw_all(std::span<const LinePiece* const> list, PixelRect inner, const VisibleStrokes& visible, Film& film) {
        const PixelRect rect = strokes_.rect();
        visible.for_touched([&](int column, int row) {
            const auto i = static_cast<std::size_t>(row * rect.width() + column);
            TileStrokes::Pixel& own = strokes_.pixel(i);
            own.visible = taken_by(visible, column, row);
            strokes_.spread(i, own.visible, [&](TileStrokes::Pixel& pixel, float share) {
                pixel.ink += visible.pen().strength * share;
            });
        });
        // The least weakened ones first: they cover the others.
        std::vector<int> opacities;
        for (const LinePiece* s : list) opacities.push_back(s->seen_opacity());
        std::sort(opacities.rbegin(), opacities.rend());
        opacities.erase(std::unique(opacities.begin(), opacities.end()), opacities.end());
        for (const int o : opacities) draw_seen_through(list, o, pen_, style_, strokes_, mattes_);
        for (const int o : opacities) draw_hidden(list, o, hidden_pen_, style_, strokes_, mattes_);
        for (const std::size_t i : strokes_.used()) {
            TileStrokes::Pixel& pixel = strokes_.pixel(i);
            const int x = rect.x0 + static_cast<int>(i) % rect.width();
            const int y = rect.y0 + static_cast<int>(i) / rect.width();
            const bool is_inner = x >= inner.x0 && y >= inner.y0 && x < inner.x1 && y < inner.y1;
            if (!pixel.is_touched || !is_inner) continue;
            if (filter_ != nullptr) cut_off_lobes(pixel);
            film.draw_hidden(
                x, y, hidden_ink(style_, pixel.ink, pixel.seen_through.color, pixel.hidden_share, pixel.hidden_seen));
            if (pixel.seen_through.color.a > 0) seen_through_.push_back({x, y, pixel.seen_through});
        }
    }

    /// Draws a tile whose lines are all hidden and equally opaque, where each pixel sees its own square.
    void draw_plain(std::span<const LinePiece* const> list, PixelRect rect, const VisibleStrokes& visible, Film& film) {
        const float strength = hidden_pen_.strength * static_cast<float>(list.front()->seen_opacity()) / 255.0f;
        const auto all = [](const LinePiece&) { return true; };
        touched_.clear();
        strokes_.draw(list, hidden_pen_.radius_px, all, [&](std::size_t i, const StrokeMask& mask) {
            const int column = static_cast<int>(i) % rect.width(), row = static_cast<int>(i) / rect.width();
            if (touched_.empty() || touched_.back().row != row) film.prefetch(rect.x0 + column, rect.y0 + row);
            touched_.push_back({column, row, &mask});
        });
        const std::vector<HiddenInk>& inks = inks_of(list.front()->seen_opacity());
        for (const auto& [column, row, mask] : touched_) {
            const int x = rect.x0 + column, y = rect.y0 + row;
            if (mattes_ != nullptr) {
                StrokeMask seen = *mask;
                remove(seen, taken_by(visible, column, row));
                const int opacity = list.front()->seen_opacity();
                mattes_->add(column, row, seen, hidden_kind(opacity, strength, style_, MatteUse::flat));
                if (mattes_->wants_deep_hidden())
                    mattes_->add(column, row, *mask, hidden_kind(opacity, strength, style_, MatteUse::deep));
            }
            if (!visible.is_touched(column, row)) {  // mostly
                film.draw_hidden(x, y, inks[static_cast<std::size_t>(strokes_.count(*mask))]);
                continue;
            }
            const StrokeMask taken = taken_by(visible, column, row);
            const float ink = visible.pen().strength * strokes_.share(taken);
            film.draw_hidden(x, y,
                             hidden_ink(style_, ink, glm::vec4(0.0f), strength * strokes_.share(*mask),
                                        strength * strokes_.share(*mask, taken)));
        }
    }
    /// The inks of a pixel that has hidden lines alone, by how many of its samples they cover.
    const std::vector<HiddenInk>& inks_of(std::uint8_t opacity) {
        std::vector<HiddenInk>& inks = inks_[opacity];
        const float strength = hidden_pen_.strength * static_cast<float>(opacity) / 255.0f;
        for (int samples = static_cast<int>(inks.size()); samples <= TileStrokes::kSamples; ++samples) {
            const float own = strength * TileStrokes::share(samples);
            inks.push_back(hidden_ink(style_, 0, glm::vec4(0.0f), own, own));
        }
        return inks;
    }

    const LineStyle& style_;
    const FilterTable* filter_;
    int reach_;
    TileMattes* mattes_ = nullptr;
    Pen pen_, hidden_pen_;
    TileStrokes strokes_;
    std::vector<SeenThrough> seen_through_;
    std::array<std::vector<HiddenInk>, 256> inks_;  // by opacity, of those that were asked for
    struct Touched {
        int column, row;
        const StrokeMask* mask;
    };
    std::vector<Touched> touched_;
};

HiddenStrokes::HiddenStrokes(const Frame& frame, const TileKernels& kernels, int threads, PixelRect part,
                             const LineDrawing::Lists& behind, bool has_mattes)
    : filter_(FilterTable::make(frame.scene->lines.style.filter)), grid_(part, kTilePx) {
    // What is not in front of all is drawn on both sides.
    const LineStyle& style = frame.scene->lines.style;
    const double radius_px = std::max(Pen(style.width_px).radius_px, Pen(style.hidden_width_px()).radius_px);
    const double reach = radius_px + reach_px(style.filter) + 1;
    std::vector<std::vector<TileLists<const LinePiece*>::Record>> records(behind.size());
    for (std::size_t i = 0; i < behind.size(); ++i) {
        for_strokes(behind[i], style, joined_, [&](const LinePiece& s) {
            grid_.visit(glm::min(s.from, s.to) - reach, glm::max(s.from, s.to) + reach, [&](std::uint32_t tile) {
                records[i].push_back({tile, &s});
            });
        });
    }
    lists_ = TileLists<const LinePiece*>(records, grid_.count());
    if (has_mattes) {
        for (auto& list : records) list.clear();
        for (std::size_t i = 0; i < behind.size(); ++i) {
            for (const LinePiece& s : behind[i]) {
                if (!is_wanted(s, style)) continue;
                grid_.visit(glm::min(s.from, s.to) - reach, glm::max(s.from, s.to) + reach, [&](std::uint32_t tile) {
                    records[i].push_back({tile, &s});
                });
            }
        }
        single_lists_ = TileLists<const LinePiece*>(records, grid_.count());
    }
    for (int i = 0; i < threads; ++i) workers_.emplace_back(style, filter_.get(), kernels);
}

HiddenStrokes::~HiddenStrokes() = default;

void HiddenStrokes::draw_below(int worker, std::size_t tile, const VisibleStrokes& visible, Film& film,
                               TileMattes* mattes) {
    const auto single = mattes != nullptr ? single_lists_.of(tile) : std::span<const LinePiece* const>{};
    workers_[static_cast<std::size_t>(worker)].draw_below(lists_.of(tile), single, grid_.tile(tile), visible, film,
                                                          mattes);
}

void HiddenStrokes::draw_above(int worker, Film& film) const {
    workers_[static_cast<std::size_t>(worker)].draw_above(film);
}

}  // namespace burin
