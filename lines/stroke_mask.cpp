#include "lines/stroke_mask.h"

#include <algorithm>

namespace burin {

void StrokeCanvas::reset(int x0, int y0, int width, int height) {
    x0_ = x0;
    y0_ = y0;
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
        for (; eight != 0; eight &= eight - 1) masks_[first + static_cast<std::size_t>(std::countr_zero(eight) / 8)] = StrokeMask{};
    }
}

}  // namespace burin
