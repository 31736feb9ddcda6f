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
        masks_.assign(static_cast<std::size_t>(width * height), StrokeMask{});
        touched_.assign(masks_.size(), 0);
        return;
    }
    for (std::size_t i = 0; i < masks_.size(); ++i) {
        if (touched_[i] == 0) continue;
        masks_[i] = StrokeMask{};
        touched_[i] = 0;
    }
}

void StrokeCanvas::draw_row(int sub_row, double x0, double x1) {
    const double last = static_cast<double>(width_) * StrokeMask::kColumns;
    const int begin = static_cast<int>(std::ceil(std::clamp(x0 * StrokeMask::kColumns - 0.5, -1.0, last)));
    const int end = static_cast<int>(std::ceil(std::clamp(x1 * StrokeMask::kColumns - 0.5, -1.0, last)));
    const int row = sub_row % StrokeMask::kRows;
    const int first_pixel = sub_row / StrokeMask::kRows * width_;
    for (int column = std::max(begin, 0); column < end;) {
        const int pixel = column / StrokeMask::kColumns;
        const int low = column % StrokeMask::kColumns;
        const int high = std::min(end - pixel * StrokeMask::kColumns, StrokeMask::kColumns);
        const std::uint32_t bits = (0xFFFFFFFFu << low) & (0xFFFFFFFFu >> (StrokeMask::kColumns - high));
        const auto i = static_cast<std::size_t>(first_pixel + pixel);
        masks_[i].rows[static_cast<std::size_t>(row)] |= bits;
        touched_[i] = 1;
        column = (pixel + 1) * StrokeMask::kColumns;
    }
}

void StrokeCanvas::draw(glm::dvec2 from, glm::dvec2 to, double radius_px) {
    const glm::dvec2 a = from - glm::dvec2(x0_, y0_), b = to - glm::dvec2(x0_, y0_);
    const double r = radius_px;
    const double rows = StrokeMask::kRows;
    const double last = height_ * rows;
    const int begin = static_cast<int>(std::ceil(std::clamp((std::min(a.y, b.y) - r) * rows - 0.5, 0.0, last)));
    const int end = static_cast<int>(std::ceil(std::clamp((std::max(a.y, b.y) + r) * rows - 0.5, 0.0, last)));
    const double length = glm::distance(a, b);
    const glm::dvec2 u = length > 0 ? (b - a) / length : glm::dvec2(1, 0);
    for (int i = begin; i < end; ++i) {
        const double y = (i + 0.5) / rows;
        double low = 1e300, high = -1e300;
        for (const glm::dvec2& p : {a, b}) {
            const double h = r * r - (y - p.y) * (y - p.y);
            if (h < 0) continue;
            const double reach = std::sqrt(h);
            low = std::min(low, p.x - reach);
            high = std::max(high, p.x + reach);
        }
        // The rectangle: |(p - a) x u| <= r and 0 <= (p - a).u <= length.
        double s0 = -1e300, s1 = 1e300;
        const auto limit = [&](double slope, double at, double lowest, double highest) {
            if (std::abs(slope) < 1e-12) {
                if (at < lowest || at > highest) s1 = -1e300;
                return;
            }
            const double p = (lowest - at) / slope, q = (highest - at) / slope;
            s0 = std::max(s0, std::min(p, q));
            s1 = std::min(s1, std::max(p, q));
        };
        limit(u.y, -(y - a.y) * u.x, -r, r);
        limit(u.x, (y - a.y) * u.y, 0, length);
        if (s0 <= s1) {
            low = std::min(low, a.x + s0);
            high = std::max(high, a.x + s1);
        }
        if (low < high) draw_row(i, low, high);
    }
}

}  // namespace burin
