#include "strokes/stroke_mask.h"

#include <algorithm>
#include <cmath>

namespace burin {

void StrokeCanvas::reset(int x0, int y0, int width, int height) {
    x0_ = x0;
    y0_ = y0;
    known_full_.clear();
    if (width_ != width || height_ != height) {
        width_ = width;
        height_ = height;
        stride_ = (width + 7) / 8 * 8;
        masks_.assign(static_cast<std::size_t>(stride_ * height) + kRoomBehindMasks, StrokeMask{});
        touched_.assign(masks_.size(), 0);
        return;
    }
    for (std::size_t first = 0; first < touched_.size(); first += 8) {
        std::uint64_t eight = eight_bytes(&touched_[first]);
        if (eight == 0) continue;
        std::fill_n(&touched_[first], 8, std::uint8_t{0});
        for (; eight != 0; eight &= eight - 1)
            masks_[first + static_cast<std::size_t>(std::countr_zero(eight) / 8)] = StrokeMask{};
    }
}

StrokeCanvas::Box StrokeCanvas::box_around(const glm::dvec2& from, const glm::dvec2& to, double radius_px) const {
    const glm::dvec2 origin(x0_, y0_), low = glm::min(from, to) - radius_px - origin,
                                       high = glm::max(from, to) + radius_px - origin;
    const auto pixel = [](double v, int end) { return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(end))); };
    return {pixel(std::floor(low.x), width_), pixel(std::floor(low.y), height_), pixel(std::ceil(high.x), width_),
            pixel(std::ceil(high.y), height_)};
}

bool StrokeCanvas::is_open(int column, int row) {
    std::uint8_t& is_known = known_full_[index(column, row)];
    if (is_known == 0 && is_full(column, row)) is_known = 1;
    return is_known == 0;
}

StrokeCanvas::Box StrokeCanvas::open_part(Box box) {
    if (box.is_empty()) return box;
    if (known_full_.empty()) known_full_.assign(touched_.size(), 0);
    // Pixels that are known to be full, eight at a time.
    const auto first_open = [&](int row, int from, int to) {
        for (int x = from; x < to; ++x) {
            while (x % 8 == 0 && x + 8 <= to && eight_bytes(&known_full_[index(x, row)]) == 0x0101010101010101u) x += 8;
            if (x >= to || is_open(x, row)) return x;
        }
        return to;
    };
    const auto end_of_open = [&](int row, int from, int to) {
        for (int x = to; x > from; --x) {
            while (x % 8 == 0 && x - 8 >= from && eight_bytes(&known_full_[index(x - 8, row)]) == 0x0101010101010101u)
                x -= 8;
            if (x <= from || is_open(x - 1, row)) return x;
        }
        return from;
    };
    Box open{box.x1, box.y1, box.x0, box.y0};
    for (int y = box.y0; y < box.y1; ++y) {
        const int first = first_open(y, box.x0, box.x1);
        if (first == box.x1) continue;
        open.x0 = std::min(open.x0, first);
        open.x1 = end_of_open(y, std::max(open.x1, first), box.x1);
        open.y0 = std::min(open.y0, y);
        open.y1 = y + 1;
    }
    return open;
}

}  // namespace burin
