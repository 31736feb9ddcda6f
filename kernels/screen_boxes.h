#pragma once

#include <cstddef>
#include <vector>

#include "kernels/tile_kernels.h"

// Boxes lie in an array per number, so that as many are compared at once as vectors hold.

namespace burin {

/// ScreenBoxes keeps boxes on the screen, or in space with nearness as the third axis, in an array per number, as the
/// kernels want them.
class ScreenBoxes {
  public:
    /// Boxes that were there before stay; the others mean nothing until they are set.
    void resize(std::size_t count) {
        count_ = count;
        if (count + kPadding > x0_.size()) {
            for (auto* v : {&x0_, &y0_, &x1_, &y1_, &low_, &high_}) v->resize(count + kPadding);
        }
    }
    std::size_t size() const { return count_; }
    void set(std::size_t i, const ScreenBox& box) {
        x0_[i] = box.x0;
        y0_[i] = box.y0;
        x1_[i] = box.x1;
        y1_[i] = box.y1;
        low_[i] = box.low;
        high_[i] = box.high;
    }
    ScreenBox operator[](std::size_t i) const { return {x0_[i], y0_[i], x1_[i], y1_[i], low_[i], high_[i]}; }
    BoxView view() const { return {x0_.data(), y0_.data(), x1_.data(), y1_.data(), low_.data(), high_.data()}; }

  private:
    static constexpr std::size_t kPadding = 7;  // what kernels may read too far
    std::size_t count_ = 0;
    std::vector<float> x0_, y0_, x1_, y1_, low_, high_;
};

}  // namespace burin
