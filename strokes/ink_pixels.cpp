#include "strokes/ink_pixels.h"

#include <algorithm>
#include <tuple>

namespace burin {
namespace {

constexpr float kSamples = InkRegions::kSamples;

StrokeMask without(StrokeMask mask, const StrokeMask& taken) {
    for (std::size_t r = 0; r < mask.rows.size(); ++r) mask.rows[r] &= ~taken.rows[r];
    return mask;
}

constexpr auto is_visible = [](const InkSpot& spot) { return !spot.is_hidden; };
constexpr auto is_hidden = [](const InkSpot& spot) { return spot.is_hidden; };
constexpr auto is_any = [](const InkSpot&) { return true; };

/// Hidden ink of a pixel where visible strokes will cover `ink` of it: `alone` of its own, `seen` between these.
HiddenInk hidden_ink(const glm::vec4& alone, glm::vec4 seen, float ink) {
    const float left = 1.0f - ink;
    seen *= left > 0 ? std::min(1.0f / left, 1.0f / std::max(seen.a, 1e-6f)) : 0.0f;
    return {alone, seen};
}

/// Brings coverages within 0..1, so that their sum stays, where that is possible. Returns the sum before and after.
std::pair<float, float> clamp(std::array<float, kLineClassCount>& coverages) {
    float sum = 0, positive = 0, after = 0;
    for (float& c : coverages) {
        sum += c;
        c = std::max(c, 0.0f);
        positive += c;
    }
    const float scale = positive > 0 ? std::clamp(sum, 0.0f, 1.0f) / positive : 0.0f;
    for (float& c : coverages) after += c *= scale;
    return {sum, after};
}

}  // namespace

InkPixels::InkPixels(const InkedLines& lines, const InkPlan& plan, const FilterTable* filter,
                     const TileKernels& kernels, Film& film)
    : lines_(lines),
      plan_(plan),
      filter_(filter),
      kernels_(kernels),
      film_(film),
      inks_(plan.orders.size()),
      regions_(kernels, filter != nullptr) {
    const std::vector<std::string>& layers = film.layers().line_sets;
    for (std::size_t set = 0; set < lines.layers.size(); ++set) {
        const auto it = std::find(layers.begin(), layers.end(), lines.layers[set]);
        if (lines.layers[set].empty() || it == layers.end()) continue;
        set_layers_.push_back({static_cast<std::uint32_t>(set), static_cast<std::size_t>(it - layers.begin())});
    }
    seen_sets_.resize(set_layers_.size());
}

void InkPixels::put(const InkTile& tile, PixelRect rect) {
    if (filter_ != nullptr) {
        put_filtered(tile, rect);
    } else {
        put_own_squares(tile, rect);
    }
}

InkPixels::Inks& InkPixels::inks_of(const InkPlan::Look& look) {
    Inks& inks = inks_[look.rank];
    if (inks.look == look) return inks;
    inks = {look, {}, {}};
    const InkOrder& order = plan_.orders[look.rank];
    for (int samples = 0; samples <= InkRegions::kSamples; ++samples) {
        const float own = look.strength * static_cast<float>(samples) / kSamples;
        const glm::vec4 color = glm::vec4(look.color, 1.0f) * own;
        if (order.is_hidden) {
            inks.hidden.push_back(hidden_ink(color, color, 0));
            continue;
        }
        LinePixel pixel;
        pixel.coverage[static_cast<std::size_t>(order.drawn_as)] = own;
        pixel.color = color;
        inks.visible.emplace_back(pixel);
    }
    return inks;
}

/// Puts a pixel that has strokes of one plain look and nothing else.
void InkPixels::put_look(const InkTile::Layer& layer, int column, int row, int x, int y) {
    const int samples = count(layer.canvas->at(column, row));
    const InkOrder& order = plan_.orders[layer.look->rank];
    const Inks& inks = inks_of(*layer.look);
    if (order.is_hidden) {
        film_.draw_hidden(x, y, inks.hidden[static_cast<std::size_t>(samples)]);
    } else {
        film_.draw_over(x, y, inks.visible[static_cast<std::size_t>(samples)]);
    }
    for (const SetLayer& set : set_layers_) {
        if (set.set != order.set) continue;
        const float own = layer.look->strength * static_cast<float>(samples) / kSamples;
        film_.put_line_set(x, y, set.layer, glm::vec4(layer.look->color, 1.0f) * own);
    }
}

void InkPixels::put_own_squares(const InkTile& tile, PixelRect rect) {
    touched_.clear();
    tile.for_touched([&](int column, int row) {
        if (touched_.empty() || touched_.back().row != row) film_.prefetch(rect.x0 + column, rect.y0 + row);
        touched_.push_back({column, row});
    });
    for (const auto [column, row] : touched_) {
        const int x = rect.x0 + column, y = rect.y0 + row;
        const InkTile::Layer* only = nullptr;
        int found = 0;
        for (const InkTile::Layer& layer : tile.layers()) {
            if (!layer.canvas->is_touched(column, row)) continue;
            ++found;
            only = &layer;
        }
        const bool has_records = tile.has_records(column, row);
        if (!has_records && found == 1) {  // mostly
            put_look(*only, column, row, x, y);
            continue;
        }
        if (const InkRecord* record = has_records && found == 0 ? tile.only_record(column, row) : nullptr;
            record != nullptr && put_record(*record, x, y))
            continue;
        find_spots(tile, column, row);
        if (spots_.empty()) continue;
        if (are_plain()) {
            put_plain(x, y);
        } else {
            put_any(x, y);
        }
        for (const SetLayer& set : set_layers_) {
            const auto is_own = [&](const InkSpot& spot) { return spot.set == set.set; };
            if (has_any(is_own)) film_.put_line_set(x, y, set.layer, lay(is_own).mean().alone());
        }
    }
}

void InkPixels::find_spots(const InkTile& tile, int column, int row) {
    spots_.clear();
    const auto add = [&](std::uint32_t rank, float nearness, std::uint64_t chain, const InkSpot& spot) {
        const InkOrder& order = plan_.orders[rank];
        Placed& placed = spots_.emplace_back(Placed{rank, nearness, chain, spot});
        placed.spot.is_hidden = order.is_hidden;
        placed.spot.drawn_as = order.drawn_as;
        placed.spot.set = order.set;
    };
    for (const InkTile::Layer& layer : tile.layers()) {
        if (!layer.canvas->is_touched(column, row)) continue;
        add(layer.look->rank, 0, 0, {&layer.canvas->at(column, row), layer.look->color, layer.look->strength, true});
    }
    if (tile.has_records(column, row)) {
        tile.for_records(column, row, [&](const InkRecord& record) {
            const float nearness = record.nearness / static_cast<float>(record.samples);
            if (record.is_plain) {
                const InkPlan::Look& look = plan_.looks[record.stroke];
                add(record.rank, nearness, record.chain, {&record.mask, look.color, look.strength, true});
                return;
            }
            const float alpha = std::min(record.alpha / static_cast<float>(record.samples), 1.0f);
            add(record.rank, nearness, record.chain,
                {&record.mask, record.color / record.alpha, alpha, false, record.multiplies});
        });
    }
    if (spots_.size() < 2) return;
    std::sort(spots_.begin(), spots_.end(), [](const Placed& a, const Placed& b) {
        return std::tuple(a.rank, -a.nearness, a.chain, a.spot.multiplies) <
               std::tuple(b.rank, -b.nearness, b.chain, b.spot.multiplies);
    });
    join_spots();
}

void InkPixels::join_spots() {
    joined_.clear();
    std::size_t last = 0;
    for (std::size_t i = 1; i < spots_.size(); ++i) {
        InkSpot& before = spots_[last].spot;
        const InkSpot& spot = spots_[i].spot;
        const bool is_same = spots_[last].rank == spots_[i].rank && before.is_share && spot.is_share &&
                             before.color == spot.color && before.alpha == spot.alpha;
        if (!is_same) {
            spots_[++last] = spots_[i];
            continue;
        }
        if (joined_.empty() || before.mask != &joined_.back()) before.mask = &joined_.emplace_back(*before.mask);
        unite(joined_.back(), *spot.mask);
    }
    spots_.resize(last + 1);
}

/// Whether spots hide what is below them whole, all as thin as each other, and hidden ones lie below visible ones.
bool InkPixels::are_plain() const {
    bool is_below = false;
    for (const Placed& p : spots_) {
        if (!p.spot.is_share || p.spot.alpha != spots_.front().spot.alpha || (is_below && !p.spot.is_hidden))
            return false;
        is_below = p.spot.is_hidden;
    }
    return true;
}

void InkPixels::put_plain(int x, int y) {
    const float strength = spots_.front().spot.alpha;
    LinePixel pixel;
    StrokeMask taken, hidden_taken;
    glm::vec4 alone(0.0f), seen(0.0f);
    bool has_visible = false, has_hidden = false;
    for (std::size_t i = 0; i < spots_.size(); ++i) {
        const InkSpot& spot = spots_[i].spot;
        if (!spot.is_hidden) {
            const float own = strength * static_cast<float>(count(*spot.mask, taken)) / kSamples;
            pixel.coverage[static_cast<std::size_t>(spot.drawn_as)] += own;
            pixel.color += glm::vec4(spot.color, 1.0f) * own;
            unite(taken, *spot.mask);
            has_visible = true;
            continue;
        }
        // Of one colour, whatever their classes: counted together.
        int own = 0, own_seen = 0;
        const glm::vec4 color(spot.color, 1.0f);
        for (; i < spots_.size() && spots_[i].spot.color == spot.color; ++i) {
            const StrokeMask left = without(*spots_[i].spot.mask, hidden_taken);
            own += count(left);
            own_seen += count(left, taken);
            unite(hidden_taken, left);
        }
        --i;
        alone += color * (strength * (static_cast<float>(own) / kSamples));
        seen += color * (strength * (static_cast<float>(own_seen) / kSamples));
        has_hidden = true;
    }
    if (has_hidden)
        film_.draw_hidden(x, y, hidden_ink(alone, seen, strength * (static_cast<float>(count(taken)) / kSamples)));
    if (has_visible) film_.draw_over(x, y, pixel);
}

template <typename Choose>
bool InkPixels::has_any(const Choose& choose) const {
    return std::any_of(spots_.begin(), spots_.end(), [&](const Placed& p) { return choose(p.spot); });
}

template <typename Choose>
const InkRegions& InkPixels::lay(const Choose& choose) {
    regions_.reset();
    for (const Placed& p : spots_) {
        if (choose(p.spot)) regions_.lay_below(p.spot);
    }
    return regions_;
}

/// Puts a pixel that has one record and nothing else. False if that is not simply ink over what is there.
bool InkPixels::put_record(const InkRecord& record, int x, int y) {
    const InkOrder& order = plan_.orders[record.rank];
    if (record.is_plain || record.multiplies || order.is_hidden || !set_layers_.empty()) return false;
    // What halos have erased is not counted.
    const int samples = plan_.most_halo_px > 0 ? count(record.mask) : record.samples;
    const float share = static_cast<float>(samples) / kSamples,
                alpha = std::min(record.alpha / static_cast<float>(record.samples), 1.0f);
    const float covered = share * alpha, left = 1.0f - share + share * (1.0f - alpha);  // as of an InkStack
    const glm::vec3 color = share * (alpha * (record.color / record.alpha));
    film_.draw_over(x, y, LineInk(glm::vec4(color, 1.0f - left), order.drawn_as, covered));
    return true;
}

void InkPixels::put_any(int x, int y) {
    const bool has_visible = has_any(is_visible), has_hidden = has_any(is_hidden);
    const bool multiplies = has_any([](const InkSpot& spot) { return spot.multiplies; });
    InkStack visible;
    if (spots_.size() == 1) {  // mostly
        const InkSpot& spot = spots_.front().spot;
        InkStack own;
        own.lay_below(spot);
        const float share = static_cast<float>(count(*spot.mask)) / kSamples;
        visible.scale(1.0f - share);
        visible.add(own, share);
    } else {
        visible = has_visible ? lay(is_visible).mean() : lay(is_hidden).mean();
    }
    LinePixel pixel;
    if (has_visible) {
        pixel.color = visible.alone();
        pixel.coverage = visible.coverage;
        if (!has_hidden && !multiplies) return film_.draw_over(x, y, pixel);
        film_.put_lines(x, y, LineInk(pixel));
    }
    InkStack all = visible;
    if (has_hidden) {
        film_.put_hidden(x, y, has_visible ? lay(is_hidden).mean().alone() : visible.alone());
        if (has_visible) all = lay(is_any).mean();
    }
    film_.draw_over_beauty(x, y, {all.color, all.through, all.tint, all.left});
}

void InkPixels::put_filtered(const InkTile& tile, PixelRect rect) {
    const auto width = rect.width(), height = rect.height();
    const auto pixels = static_cast<std::size_t>(width * height);
    seen_.assign(pixels, Seen{});
    for (auto& set : seen_sets_) set.assign(pixels, glm::vec4(0.0f));
    // Calls add(pixel, weight) for the pixels that see samples of a mask.
    const auto spread = [&](int column, int row, const StrokeMask& mask, const auto& add) {
        const FilterTable::Shares shares = filter_->shares_of(mask);
        for (int dy = 0; dy < FilterTable::kSide; ++dy) {
            for (int dx = 0; dx < FilterTable::kSide; ++dx) {
                // The tile begins within the filter's reach of `rect`.
                const int x = column + dx - 2 * FilterTable::kReach, y = row + dy - 2 * FilterTable::kReach;
                if (x < 0 || y < 0 || x >= width || y >= height) continue;
                add(static_cast<std::size_t>(y * width + x),
                    shares[static_cast<std::size_t>(dy)][static_cast<std::size_t>(dx)]);
            }
        }
    };
    tile.for_touched([&](int column, int row) {
        find_spots(tile, column, row);
        if (spots_.empty()) return;
        const bool has_visible = has_any(is_visible), has_hidden = has_any(is_hidden);
        if (are_plain() && !has_hidden) {
            StrokeMask taken;
            for (const Placed& p : spots_) {
                spread(column, row, without(*p.spot.mask, taken), [&](std::size_t i, float share) {
                    const float own = p.spot.alpha * share;
                    Seen& s = seen_[i];
                    s.coverage[static_cast<std::size_t>(p.spot.drawn_as)] += own;
                    s.visible += p.spot.color * own;
                    s.color += p.spot.color * own;
                    s.lost += own;
                    s.lost_left += own;
                    s.has_visible = true;
                });
                unite(taken, *p.spot.mask);
            }
        } else {
            const bool multiplies = has_any([](const InkSpot& spot) { return spot.multiplies; });
            if (has_visible) {
                lay(is_visible).for_regions([&](const StrokeMask& mask, int, const InkStack& stack) {
                    if (stack.left == 1) return;
                    spread(column, row, mask, [&](std::size_t i, float share) {
                        for (std::size_t c = 0; c < kLineClassCount; ++c)
                            seen_[i].coverage[c] += share * stack.coverage[c];
                        seen_[i].visible += share * (stack.color + stack.tint);
                        seen_[i].has_visible = true;
                    });
                });
            }
            if (has_hidden) {
                lay(is_hidden).for_regions([&](const StrokeMask& mask, int, const InkStack& stack) {
                    if (stack.left == 1) return;
                    spread(column, row, mask, [&](std::size_t i, float share) {
                        seen_[i].hidden += share * stack.alone();
                        seen_[i].has_hidden = true;
                    });
                });
            }
            lay(is_any).for_regions([&](const StrokeMask& mask, int, const InkStack& stack) {
                if (stack.left == 1) return;
                spread(column, row, mask, [&](std::size_t i, float share) {
                    Seen& s = seen_[i];
                    s.color += share * stack.color;
                    s.lost += share * (1.0f - stack.through);
                    s.tint += share * stack.tint;
                    s.lost_left += share * (1.0f - stack.left);
                    s.multiplies = s.multiplies || multiplies;
                });
            });
        }
        for (std::size_t k = 0; k < set_layers_.size(); ++k) {
            const auto is_own = [&](const InkSpot& spot) { return spot.set == set_layers_[k].set; };
            if (!has_any(is_own)) continue;
            lay(is_own).for_regions([&](const StrokeMask& mask, int, const InkStack& stack) {
                if (stack.left == 1) return;
                spread(column, row, mask,
                       [&](std::size_t i, float share) { seen_sets_[k][i] += share * stack.alone(); });
            });
        }
    });
    // Cuts off what a filter's negative lobes take away beside a line, and add in its middle.
    for (std::size_t i = 0; i < pixels; ++i) {
        Seen& s = seen_[i];
        const int x = rect.x0 + static_cast<int>(i) % width, y = rect.y0 + static_cast<int>(i) / width;
        for (std::size_t k = 0; k < set_layers_.size(); ++k) {
            if (seen_sets_[k][i] != glm::vec4(0.0f))
                film_.put_line_set(x, y, set_layers_[k].layer, glm::clamp(seen_sets_[k][i], 0.0f, 1.0f));
        }
        if (!s.has_visible && !s.has_hidden) continue;
        const auto [before, after] = clamp(s.coverage);
        LinePixel pixel;
        pixel.coverage = s.coverage;
        pixel.color = before > 0 ? glm::vec4(glm::max(s.visible * (after / before), 0.0f), after) : glm::vec4(0.0f);
        if (!s.has_hidden && !s.multiplies) {
            if (pixel.color.a > 0) film_.draw_over(x, y, pixel);
            continue;
        }
        if (s.has_visible) film_.put_lines(x, y, LineInk(pixel));
        if (s.has_hidden) film_.put_hidden(x, y, glm::clamp(s.hidden, 0.0f, 1.0f));
        film_.draw_over_beauty(x, y,
                               {glm::max(s.color, 0.0f), glm::clamp(1.0f - s.lost, 0.0f, 1.0f), glm::max(s.tint, 0.0f),
                                std::clamp(1.0f - s.lost_left, 0.0f, 1.0f)});
    }
}

}  // namespace burin
