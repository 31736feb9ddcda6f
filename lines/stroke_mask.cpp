#include "lines/stroke_mask.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace burin {

void StrokeCanvas::reset(int x0, int y0, int width, int height) {
    x0_ = x0;
    y0_ = y0;
    if (width_ != width || height_ != height) {
        width_ = width;
        height_ = height;
        stride_ = (width + 7) / 8 * 8;
        masks_.assign(static_cast<std::size_t>(stride_ * height), StrokeMask{});
        touched_.assign(masks_.size(), 0);
        return;
    }
    for (std::size_t first = 0; first < touched_.size(); first += 8) {
        std::uint64_t eight = eight_bytes(&touched_[first]);
        if (eight == 0) continue;
        std::fill_n(&touched_[first], 8, std::uint8_t{0});
        for (; eight != 0; eight &= eight - 1) masks_[first + static_cast<std::size_t>(std::countr_zero(eight) / 8)] = StrokeMask{};
    }
}

void StrokeCanvas::draw(glm::dvec2 from, glm::dvec2 to, double radius_px, bool in_sets) {
    if (to.x < from.x) std::swap(from, to);  // samples exactly on a side belong to one, whichever way a stroke is drawn
    const glm::dvec2 a = from - glm::dvec2(x0_, y0_), b = to - glm::dvec2(x0_, y0_);
    const double r = radius_px;
    const double rows = StrokeMask::kRows;
    const double last = height_ * rows;
    const double reach = in_sets ? kStrokeColumnShifts.back() / rows : 0;
    const auto first_row_from = [&](double y) { return static_cast<int>(std::ceil(std::clamp(y * rows - 0.5, 0.0, last))); };
    const int first = first_row_from(std::min(a.y, b.y) - r - reach), beyond = first_row_from(std::max(a.y, b.y) + r + reach);
    if (first >= beyond) return;
    const int begin = first & -8, end = (beyond + 7) & -8;  // as add_spans() wants them; there are no spans beside the stroke
    const double length = glm::distance(a, b);
    const glm::dvec2 u = length > 0 ? (b - a) / length : glm::dvec2(1, 0);
    const auto count = static_cast<std::size_t>(end - begin);
    if (begin_.size() < count) {
        begin_.resize(count);
        end_.resize(count);
    }
    const StrokeView view{masks_.data()->rows.data(), touched_.data(), stride_};
    const auto add = [&](double shift, std::uint32_t columns) {
        const double up = shift / rows;
        kernels_->stroke_spans({a.x, a.y - up, b.x, b.y - up, u.x, u.y, length, r, y0_ * StrokeMask::kRows}, begin, end - begin,
                               width_ * StrokeMask::kColumns, begin_.data(), end_.data());
        kernels_->add_spans(view, begin, end - begin, begin_.data(), end_.data(), columns);
    };
    if (!in_sets) return add(0, ~0u);
    for (int set = 0; set < kStrokeColumnSets; ++set) add(kStrokeColumnShifts[static_cast<std::size_t>(set)], columns_of_set(set));
}

}  // namespace burin
