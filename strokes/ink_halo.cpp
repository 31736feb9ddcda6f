#include <algorithm>
#include <cmath>
#include <limits>

#include "base/interrupt.h"
#include "strokes/ink_tile.h"

// Strokes with a halo erase what lies behind them, a little beyond their own width.

namespace burin {
namespace {

/// How much farther than a place another one is, in pixels' widths at the first one.
float farther_px(const Projection& projection, float nearness, float of_other) {
    const auto focal_px = static_cast<float>(projection.focal_px);
    if (projection.orthographic) return focal_px * (nearness - of_other);
    return of_other > 0 ? focal_px * (nearness / of_other - 1) : std::numeric_limits<float>::infinity();
}

/// The share of a stroke's halo by which it erases what is that much farther.
float halo_share(const InkStroke& stroke, float farther_px) {
    const float from = stroke.halo_depth_px[0], to = stroke.halo_depth_px[1];
    if (!(to > from)) return farther_px >= from ? 1.0f : 0.0f;
    return std::clamp((farther_px - from) / (to - from), 0.0f, 1.0f);
}

bool is_empty(const StrokeMask& mask) {
    return std::all_of(mask.rows.begin(), mask.rows.end(), [](std::uint32_t row) { return row == 0; });
}

}  // namespace

void InkTile::erase_behind_halos() {
    // The farthest ones of a pixel come first: what is not far enough behind ends the search.
    behind_.clear();
    behind_end_.clear();
    for (std::size_t i = 0; i + 1 < first_sorted_.size(); ++i) {
        for (std::uint32_t k = first_sorted_[i]; k < first_sorted_[i + 1]; ++k) {
            const InkRecord& record = records_[sorted_[k]];
            behind_.push_back({record.nearness / static_cast<float>(record.samples), sorted_[k]});
        }
        std::sort(behind_.begin() + first_sorted_[i], behind_.end(),
                  [](const Behind& a, const Behind& b) { return a.nearness < b.nearness; });
        behind_end_.push_back(first_sorted_[i + 1]);
    }
    for (const InkSegmentRef& ref : segments_) {
        throw_if_interrupted();
        if (lines_.strokes[ref.stroke].halo_px > 0) erase_behind(ref, segment_of(ref));
    }
}

/// Erases samples of records that are near a segment and far enough behind it. How far its halo reaches depends on how
/// much farther a record is, as seen from the nearest place of the segment, so it is drawn for each of them.
void InkTile::erase_behind(const InkSegmentRef& ref, const InkSegment& segment) {
    const InkStroke& stroke = lines_.strokes[ref.stroke];
    const auto halo_px = static_cast<double>(stroke.halo_px);
    const double reach = segment.radius_px() + halo_px + 1;
    const glm::dvec2 low = glm::min(segment.from().place, segment.to().place) - reach,
                     high = glm::max(segment.from().place, segment.to().place) + reach;
    const auto column_of = [&](double x) {
        return static_cast<int>(std::clamp(std::floor(x) - rect_.x0, 0.0, static_cast<double>(rect_.width())));
    };
    const auto row_of = [&](double y) {
        return static_cast<int>(std::clamp(std::floor(y) - rect_.y0, 0.0, static_cast<double>(rect_.height())));
    };
    const int x1 = column_of(high.x + 1), y1 = row_of(high.y + 1);
    for (int row = row_of(low.y); row < y1; ++row) {
        for (int column = column_of(low.x); column < x1; ++column) {
            const std::size_t i = index(column, row);
            if (first_sorted_[i] == behind_end_[i]) continue;
            const int x = rect_.x0 + column, y = rect_.y0 + row;
            const float nearness = segment.nearness_at(segment.share_nearest({x + 0.5, y + 0.5}));
            StrokeMask erased;  // for the last share: mostly it is 1 for all records of the pixel
            float erased_share = 0;
            std::uint32_t k = first_sorted_[i], kept = k;
            for (; k < behind_end_[i]; ++k) {
                const Behind behind = behind_[k];
                const float share = halo_share(stroke, farther_px(projection_, nearness, behind.nearness));
                if (share <= 0) break;
                InkRecord& record = records_[behind.record];
                bool is_left = true;
                if (InkStroke::run_of(record.chain) != InkStroke::run_of(stroke.chain)) {
                    if (share != erased_share) {
                        erased = halo_mask(segment, halo_px * static_cast<double>(share), x, y);
                        erased_share = share;
                    }
                    for (std::size_t r = 0; r < erased.rows.size(); ++r) record.mask.rows[r] &= ~erased.rows[r];
                    is_left = !is_empty(record.mask);
                }
                if (is_left) behind_[kept++] = behind;
            }
            if (kept == k) continue;
            behind_end_[i] = static_cast<std::uint32_t>(
                std::copy(behind_.begin() + k, behind_.begin() + behind_end_[i], behind_.begin() + kept) -
                behind_.begin());
        }
    }
}

/// The samples of a pixel that lie within a segment or at most `halo_px` beside it.
StrokeMask InkTile::halo_mask(const InkSegment& segment, double halo_px, int x, int y) {
    StrokeMask all;
    for (InkSegment::Part part : segment.parts()) {
        part.cone.radius_from += halo_px;
        part.cone.radius_to += halo_px;
        one_.draw(kernels_, part.cone, {x, y, x + 1, y + 1}, [&](int, int, const StrokeMask& mask) {
            for (std::size_t r = 0; r < mask.rows.size(); ++r) all.rows[r] |= mask.rows[r];
        });
    }
    return all;
}

}  // namespace burin
