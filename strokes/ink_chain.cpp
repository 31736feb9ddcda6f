#include <array>
#include <span>
#include <utility>

#include "base/interrupt.h"
#include "strokes/ink_tile.h"

// The strokes of one chain, drawn into a record per pixel: a chain covers each sample once.

namespace burin {
namespace {

/// Whether the last disc of one cone is the first one of the next, sample by sample.
bool ends_where_begins(const PenCone& a, const PenCone& b) {
    const auto is_level_cone = [](const PenCone& c) { return is_level(c.to[0] - c.from[0], c.to[1] - c.from[1]); };
    return a.to[0] == b.from[0] && a.to[1] == b.from[1] && a.radius_to == b.radius_from && a.cut_count == 0 &&
           b.cut_count == 0 && is_level_cone(a) == is_level_cone(b);
}

}  // namespace

void InkTile::draw_chain(std::span<const InkSegmentRef> segments) {
    throw_if_interrupted();
    placed_.clear();
    std::array<bool, 2> has_parts{}, has_changes{};  // that are not thin, and that are
    for (const InkSegmentRef& ref : segments) {
        Placed& placed = placed_.emplace_back(*this, ref);
        placed.is_cut = is_clipped(placed);
        for (const InkSegment::Part& part : placed.segment.parts()) {
            const std::size_t k = part.is_thin ? 1 : 0;
            has_parts[k] = true;
            has_changes[k] = has_changes[k] || has_body_first(placed, part);
        }
    }
    if (has_changes[0] || has_changes[1]) join_parts();
    chain_begin_ = records_.size();
    // Bodies come before discs, so that ink changes evenly along the stroke and not in steps as wide as the pen; what
    // is thin comes last: its ink is light, and would keep darker ink of the same chain away.
    for (const bool is_thin : {false, true}) {
        const std::size_t k = is_thin ? 1 : 0;
        if (!has_parts[k]) continue;
        cut_pixels_.clear();
        cut_ends_.clear();
        if (has_changes[k]) draw_parts(is_thin, true);
        draw_parts(is_thin, false);
    }
    for (std::size_t i = chain_begin_; i < records_.size(); ++i) record_at_[records_[i].pixel] = 0;
    const auto own = records_.begin() + static_cast<std::ptrdiff_t>(chain_begin_);
    records_.erase(std::remove_if(own, records_.end(), [](const InkRecord& r) { return !(r.alpha > 0); }),
                   records_.end());
}

/// Lets the bodies of a chain's parts meet where no disc is needed. Segments that are not in the tile have none of
/// their joints there. Where boundaries cut a part, the disc of the next one may lie beyond what cuts it.
void InkTile::join_parts() {
    const Placed* last = nullptr;
    InkSegment::Part* before = nullptr;  // that may be joined
    for (Placed& placed : placed_) {
        const bool goes_on =
            last != nullptr && last->ref.stroke == placed.ref.stroke && last->ref.point + 1 == placed.ref.point;
        if (!goes_on || placed.is_cut) before = nullptr;
        last = &placed;
        if (placed.is_cut) continue;
        for (InkSegment::Part& part : placed.segment.parts()) {
            if (before != nullptr) InkSegment::join(*before, part);
            before = &part;
        }
        if (placed.segment.parts().empty()) before = nullptr;
    }
}

/// Whether it matters which of a part and its neighbours the samples of a pixel come from: for its ink, or for the
/// depth that halos of others ask for.
bool InkTile::has_body_first(const Placed& placed, const InkSegment::Part& part) const {
    return placed.segment.changes_ink(part) ||
           (plan_.most_halo_px > 0 && !has_one_ink(placed.segment.from(), placed.segment.to()));
}

void InkTile::draw_parts(bool is_thin, bool body_only) {
    std::size_t next_cut = 0;
    const PenCone* before = nullptr;  // of which the last disc is drawn
    for (const Placed& placed : placed_) {
        throw_if_interrupted();
        if (placed.is_cut) before = nullptr;
        const auto use = [&](int column, int row, const StrokeMask& mask) { take(placed, column, row, mask); };
        for (const InkSegment::Part& part : placed.segment.parts()) {
            if (part.is_thin != is_thin) continue;
            const bool changes = has_body_first(placed, part);
            if (placed.is_cut) {
                if (changes || !body_only) draw_cut(placed, part, body_only, next_cut);
            } else if (body_only) {
                if (changes) one_.draw(kernels_, part.body(), rect_, use);
            } else if (!changes) {
                one_.draw(kernels_, part.cone, rect_, use);
                before = &part.cone;
            } else {  // its body is there already
                const bool is_begun = before != nullptr && ends_where_begins(*before, part.cone);
                const bool has_first = !part.longer_px[0] && !is_begun, has_last = !part.longer_px[1];
                one_.draw_ends(kernels_, part.cone, has_first, has_last, rect_, use);
                before = has_last ? &part.cone : nullptr;
            }
        }
    }
}

/// Draws a part that boundaries may cut, or its body. What is left of the part is found when its body is drawn, and
/// kept.
void InkTile::draw_cut(const Placed& placed, const InkSegment::Part& part, bool body_only, std::size_t& next_cut) {
    if (body_only) {
        const std::size_t first = cut_pixels_.size();
        list_clipped(placed, part.cone, cut_pixels_);
        cut_ends_.push_back(cut_pixels_.size());
        PenCone body = part.cone;
        body.body_only = true;
        auto left = cut_pixels_.begin() + static_cast<std::ptrdiff_t>(first);  // row by row, as the body
        one_.draw(kernels_, body, rect_, [&](int column, int row, StrokeMask mask) {
            while (left != cut_pixels_.end() && std::pair(left->row, left->column) < std::pair(row, column)) ++left;
            if (left == cut_pixels_.end() || left->row != row || left->column != column) return;
            for (std::size_t r = 0; r < mask.rows.size(); ++r) mask.rows[r] &= left->mask.rows[r];
            take(placed, column, row, mask);
        });
        return;
    }
    std::span<const StrokeClipper::CutPixel> pixels;
    if (has_body_first(placed, part)) {
        const std::size_t first = next_cut == 0 ? 0 : cut_ends_[next_cut - 1];
        pixels = std::span(cut_pixels_).subspan(first, cut_ends_[next_cut] - first);
        ++next_cut;
    } else {
        cut_once_.clear();
        list_clipped(placed, part.cone, cut_once_);
        pixels = cut_once_;
    }
    for (const StrokeClipper::CutPixel& pixel : pixels) take(placed, pixel.column, pixel.row, pixel.mask);
}

void InkTile::take(const Placed& placed, int column, int row, const StrokeMask& mask) {
    const std::size_t pixel = index(column, row);
    if (record_at_[pixel] == 0) {
        records_.emplace_back(static_cast<std::uint32_t>(pixel), placed.ref.stroke, placed.ref.rank,
                              lines_.strokes[placed.ref.stroke]);
        record_at_[pixel] = static_cast<std::uint32_t>(records_.size());
        touched_[pixel] = 1;
    }
    InkRecord& record = records_[record_at_[pixel] - 1];
    if (record.samples == InkRegions::kSamples) return;
    const int samples = kernels_.stroke.add_bits(mask.rows.data(), record.mask.rows.data());
    if (samples == 0) return;
    const float share = placed.segment.share_nearest({rect_.x0 + column + 0.5, rect_.y0 + row + 0.5});
    const auto count = static_cast<float>(samples);
    const float ink = count * placed.segment.alpha_at(share);
    const InkPlan::Look& look = plan_.looks[placed.ref.stroke];
    record.is_plain = record.is_plain && look.is_plain && look == plan_.looks[record.stroke];
    record.samples += samples;
    record.alpha += ink;
    record.nearness += count * placed.segment.nearness_at(share);
    record.width += count * glm::mix(placed.segment.from().width_px, placed.segment.to().width_px, share);
    record.color += ink * placed.segment.color_at(share);
}

}  // namespace burin
