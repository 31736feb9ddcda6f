#include "strokes/ink_mattes.h"

#include <algorithm>
#include <tuple>

namespace burin {

void InkMattes::add(const InkTile& tile) {
    tile.for_touched([&](int column, int row) {
        find_spots(tile, column, row);
        if (tile_mattes_.wants_shares() || tile_mattes_.wants_spots()) lay(column, row);
        if (tile_mattes_.wants_deep()) lay_deep(column, row, false);
        if (tile_mattes_.wants_deep_hidden()) lay_deep(column, row, true);
    });
    tile_mattes_.finish();
}

void InkMattes::find_spots(const InkTile& tile, int column, int row) {
    spots_.clear();
    masks_.clear();
    const auto add = [&](std::uint32_t rank, std::uint64_t chain, const OwnerMasks::Line& line, const InkSpot& spot) {
        Placed& placed = spots_.emplace_back(Placed{rank, line.nearness, chain, spot, line});
        placed.spot.is_hidden = plan_.orders[rank].is_hidden;
    };
    for (const InkTile::Layer& layer : tile.layers()) {
        if (!layer.canvas->is_touched(column, row)) continue;
        const std::uint32_t rank = layer.look->rank;
        tile_mattes_.owners().split(column, row, rank, layer.canvas->at(column, row),
                                    [&](const OwnerMasks::Line& line, const StrokeMask& samples) {
                                        masks_.push_back(samples);
                                        add(rank, 0, line, {nullptr, layer.look->color, layer.look->strength, true});
                                    });
    }
    for (std::size_t i = 0; i < spots_.size(); ++i) spots_[i].spot.mask = &masks_[i];
    if (tile.has_records(column, row)) {
        tile.for_records(column, row, [&](const InkRecord& record) {
            const auto samples = static_cast<float>(record.samples);
            const StrokeOrigin& origin = lines_.origins[record.stroke];
            OwnerMasks::Line line;
            line.drawn_as = plan_.orders[record.rank].drawn_as;
            line.invisibility = origin.invisibility;
            line.owner = {origin.object, origin.material};
            line.width_px = record.width / samples;
            line.nearness = record.nearness / samples;
            InkSpot spot{&record.mask, record.color / record.alpha, std::min(record.alpha / samples, 1.0f), false,
                         record.multiplies};
            if (record.is_plain) spot = {&record.mask, {}, plan_.looks[record.stroke].strength, true};
            add(record.rank, record.chain, line, spot);
            spots_.back().is_behind = lines_.strokes[record.stroke].is_behind;
        });
    }
    std::sort(spots_.begin(), spots_.end(), [](const Placed& a, const Placed& b) {
        return std::tuple(a.rank, -a.nearness, a.chain, a.spot.multiplies, a.line.owner.object, a.line.owner.material,
                          a.line.invisibility) < std::tuple(b.rank, -b.nearness, b.chain, b.spot.multiplies,
                                                            b.line.owner.object, b.line.owner.material,
                                                            b.line.invisibility);
    });
}

/// Lays the strokes of a pixel upon each other, front to back: what each takes is what is left less than before.
void InkMattes::lay(int column, int row) {
    regions_.reset();
    float left = 1;
    for (const Placed& placed : spots_) {
        const InkOrder& order = plan_.orders[placed.rank];
        TileMattes::Kind kind;
        kind.is_hidden = order.is_hidden;
        kind.set = static_cast<std::uint16_t>(order.set);
        const auto add_regions = [&](float sign) {
            regions_.for_regions([&](const StrokeMask& mask, int, const InkStack& stack) {
                kind.strength = sign * stack.left;
                if (stack.left != 0) tile_mattes_.add_share(column, row, mask, placed.line, kind);
            });
        };
        const bool is_filtered = tile_mattes_.filter() != nullptr;
        if (is_filtered) add_regions(1);
        regions_.lay_below(placed.spot);
        const float left_now = std::max(regions_.mean().left, 0.0f), taken = std::max(left - left_now, 0.0f);
        left = left_now;
        if (is_filtered) {
            add_regions(-1);
        } else {
            StrokeMask all;
            all.rows.fill(~0u);
            kind.strength = taken;
            if (taken > 0) tile_mattes_.add_share(column, row, all, placed.line, kind);
        }
        if (tile_mattes_.wants_spots()) tile_mattes_.add_spot(column, row, placed.line, taken);
    }
}

/// Lays the hidden strokes of a pixel, or the others, upon each other for a deep file: each adds what all together make
/// of a surface's colour, less than before. What lies behind glass is below: its place is behind that.
void InkMattes::lay_deep(int column, int row, bool are_hidden) {
    regions_.reset();
    const auto ink_of = [](const InkStack& stack, float sign) {
        return DeepInk{1.0f - stack.left, stack.color, stack.through - stack.left, stack.tint}.scaled(sign);
    };
    StrokeMask all;
    all.rows.fill(~0u);
    for (const Placed& placed : spots_) {
        if (placed.spot.is_hidden != are_hidden) continue;
        TileMattes::Kind kind;
        kind.is_hidden = are_hidden;
        kind.is_behind = placed.is_behind && !are_hidden;
        const auto add_now = [&](float sign) {
            if (tile_mattes_.filter() == nullptr)
                return tile_mattes_.add_deep(column, row, all, placed.line, kind, ink_of(regions_.mean(), sign));
            regions_.for_regions([&](const StrokeMask& mask, int, const InkStack& stack) {
                tile_mattes_.add_deep(column, row, mask, placed.line, kind, ink_of(stack, sign));
            });
        };
        add_now(-1);
        regions_.lay_below(placed.spot);
        add_now(1);
    }
}

}  // namespace burin
