#include "strokes/faded_strokes.h"

#include <algorithm>

namespace burin {

void FadedStrokes::draw(std::span<const LinePiece* const> pieces, PixelRect rect,
                        const std::function<void(std::size_t, StrokeCanvas&)>& draw_stroke) {
    masks_.clear();
    width_ = (rect.width() + 7) / 8 * 8;
    std::vector<Kind> kinds;
    for (const LinePiece* s : pieces) {
        if (s->is_drawn && s->opacity < 255) kinds.push_back(kind_of(*s));
    }
    if (kinds.empty()) return;
    std::sort(kinds.begin(), kinds.end());
    kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
    touched_.assign(static_cast<std::size_t>(width_ * rect.height()), 0);
    for (const Kind kind : kinds) {
        canvas_.reset(rect.x0, rect.y0, rect.width(), rect.height());
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            if (pieces[i]->is_drawn && kind_of(*pieces[i]) == kind) draw_stroke(i, canvas_);
        }
        canvas_.for_touched([&](int column, int row) {
            const auto pixel = static_cast<std::uint32_t>(row * width_ + column);
            masks_.push_back({pixel, kind, canvas_.at(column, row)});
            touched_[pixel] = 1;
        });
    }
    std::stable_sort(masks_.begin(), masks_.end(),
                     [](const PixelMask& a, const PixelMask& b) { return a.pixel < b.pixel; });
}

std::span<const FadedStrokes::PixelMask> FadedStrokes::masks_of(int column, int row) const {
    const auto pixel = static_cast<std::uint32_t>(row * width_ + column);
    const auto is_before = [](const PixelMask& m, std::uint32_t p) { return m.pixel < p; };
    const auto first = std::lower_bound(masks_.begin(), masks_.end(), pixel, is_before);
    return {first, std::lower_bound(first, masks_.end(), pixel + 1, is_before)};
}

}  // namespace burin
