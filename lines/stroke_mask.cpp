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
        stride_ = (width + 9) / 8 * 8;
        masks_.assign(static_cast<std::size_t>(stride_ * height), StrokeMask{});
        touched_.assign(masks_.size(), 0);
        return;
    }
    for (std::size_t i = 0; i < masks_.size(); ++i) {
        if (touched_[i] == 0) continue;
        masks_[i] = StrokeMask{};
        touched_[i] = 0;
    }
}

void StrokeCanvas::draw(glm::dvec2 from, glm::dvec2 to, double radius_px, bool in_sets) {
    if (to.x < from.x) std::swap(from, to);  // samples exactly on a side belong to one, whichever way a stroke is drawn
    const glm::dvec2 a = from - glm::dvec2(x0_, y0_), b = to - glm::dvec2(x0_, y0_);
    const double r = radius_px;
    const double rows = StrokeMask::kRows;
    const double last = height_ * rows;
    const double reach = in_sets ? kStrokeColumnShifts.back() : 0;
    const int begin = static_cast<int>(std::ceil(std::clamp((std::min(a.y, b.y) - r) * rows - 0.5 - reach, 0.0, last)));
    const int end = static_cast<int>(std::ceil(std::clamp((std::max(a.y, b.y) + r) * rows - 0.5 + reach, 0.0, last)));
    if (begin >= end) return;
    const double length = glm::distance(a, b);
    const glm::dvec2 u = length > 0 ? (b - a) / length : glm::dvec2(1, 0);
    const auto count = static_cast<std::size_t>(end - begin);
    if (begin_.size() < count + 3) {
        begin_.resize(count + 3);
        end_.resize(count + 3);
    }
    const auto add = [&](double shift, std::uint64_t columns) {
        const double up = shift / rows;
        kernels_->stroke_spans({a.x, a.y - up, b.x, b.y - up, u.x, u.y, length, r, y0_ * StrokeMask::kRows}, begin, end - begin,
                               width_ * StrokeMask::kColumns, begin_.data(), end_.data());
        add_spans(begin, end, columns);
    };
    if (!in_sets) return add(0, ~std::uint64_t{0});
    for (int set = 0; set < kStrokeColumnSets; ++set) add(kStrokeColumnShifts[static_cast<std::size_t>(set)], columns_of_set(set));
}

/// Adds those of `columns` that are in [begin_[i], end_[i]) of row `from` + i.
void StrokeCanvas::add_spans(int from, int end, std::uint64_t columns) {
    constexpr unsigned kRows = StrokeMask::kRows, kColumns = StrokeMask::kColumns;
    // As bytes may stand for anything, members would be read again after each that is written.
    StrokeMask* const masks = masks_.data();
    std::uint8_t* const touched = touched_.data();
    const auto stride = static_cast<unsigned>(stride_);
    const auto add = [=](std::size_t pixel, unsigned row, std::uint32_t bits) {
        masks[pixel].rows[row] |= bits;
        touched[pixel] = static_cast<std::uint8_t>(touched[pixel] | (bits != 0));
    };
    const std::int32_t *span_begin = begin_.data(), *span_end = end_.data();
    for (auto sub_row = static_cast<unsigned>(from); sub_row < static_cast<unsigned>(end); ++sub_row) {
        const auto first = static_cast<unsigned>(*span_begin++);
        const int count = *span_end++ - static_cast<int>(first);
        const unsigned row = sub_row % kRows;
        const std::size_t start = sub_row / kRows * stride + first / kColumns;
        if (count <= static_cast<int>(kColumns)) {  // in two pixels: most are, and which of them is not to be guessed
            const std::uint64_t bits = ((std::uint64_t{1} << std::max(count, 0)) - 1) << first % kColumns & columns;
            add(start, row, static_cast<std::uint32_t>(bits));
            add(start + 1, row, static_cast<std::uint32_t>(bits >> kColumns));
        } else {
            const auto beyond = first % kColumns + static_cast<unsigned>(count);  // counted from the first pixel's left
            const auto all = static_cast<std::uint32_t>(columns);
            add(start, row, all & ~0u << first % kColumns);
            for (unsigned pixel = 1; pixel < beyond / kColumns; ++pixel) add(start + pixel, row, all);
            add(start + beyond / kColumns, row, all & static_cast<std::uint32_t>((std::uint64_t{1} << beyond % kColumns) - 1));
        }
    }
}

}  // namespace burin
