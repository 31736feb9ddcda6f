#include "lines/stroke_mask.h"

#include <algorithm>
#include <cmath>

namespace burin {

void StrokeCanvas::reset(int x0, int y0, int width, int height) {
    x0_ = x0;
    y0_ = y0;
    if (width_ != width || height_ != height) {
        width_ = width;
        height_ = height;
        stride_ = width / 8 * 8 + 8;
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

void StrokeCanvas::draw(glm::dvec2 from, glm::dvec2 to, double radius_px) {
    const glm::dvec2 a = from - glm::dvec2(x0_, y0_), b = to - glm::dvec2(x0_, y0_);
    const double r = radius_px;
    const double rows = StrokeMask::kRows;
    const double last = height_ * rows;
    const int begin = static_cast<int>(std::ceil(std::clamp((std::min(a.y, b.y) - r) * rows - 0.5, 0.0, last)));
    const int end = static_cast<int>(std::ceil(std::clamp((std::max(a.y, b.y) + r) * rows - 0.5, 0.0, last)));
    if (begin >= end) return;
    const double length = glm::distance(a, b);
    const glm::dvec2 u = length > 0 ? (b - a) / length : glm::dvec2(1, 0);
    const auto count = static_cast<std::size_t>(end - begin);
    if (begin_.size() < count + 3) {
        begin_.resize(count + 3);
        end_.resize(count + 3);
    }
    kernels_->stroke_spans({a.x, a.y, b.x, b.y, u.x, u.y, length, r}, begin, end - begin,
                           width_ * StrokeMask::kColumns, begin_.data(), end_.data());
    for (int sub_row = begin; sub_row < end; ++sub_row) {
        const auto row = static_cast<std::size_t>(sub_row % StrokeMask::kRows);
        const int first = begin_[static_cast<std::size_t>(sub_row - begin)], count = end_[static_cast<std::size_t>(sub_row - begin)] - first;
        const std::size_t start = index(0, sub_row / StrokeMask::kRows);
        const auto add = [&](std::size_t i, std::uint32_t bits) {
            masks_[i].rows[row] |= bits;
            touched_[i] = static_cast<std::uint8_t>(touched_[i] | (bits != 0 ? 1 : 0));
        };
        if (count <= StrokeMask::kColumns) {  // two pixels: as most are, and which of them is not to be guessed
            const std::uint64_t bits = ((std::uint64_t{1} << std::max(count, 0)) - 1) << first % StrokeMask::kColumns;
            const std::size_t i = start + static_cast<std::size_t>(first / StrokeMask::kColumns);
            add(i, static_cast<std::uint32_t>(bits));
            add(i + 1, static_cast<std::uint32_t>(bits >> StrokeMask::kColumns));
        } else {
            StrokeMask::for_pixels(first, first + count,
                                   [&](int pixel, std::uint32_t bits) { add(start + static_cast<std::size_t>(pixel), bits); });
        }
    }
}

}  // namespace burin
