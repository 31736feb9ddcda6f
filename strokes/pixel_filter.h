#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "shading/line_style.h"
#include "strokes/stroke_mask.h"

namespace burin {

/// FilterTable spreads the samples of stroke masks over the pixels around them. Every sample gives away its whole
/// weight, wherever it lies: no filter changes the sum over the picture.
class FilterTable {
  public:
    static constexpr int kReach = 2;
    static constexpr int kSide = 2 * kReach + 1;
    /// What a mask gives to the pixels around it: [2 + dy][2 + dx].
    using Shares = std::array<std::array<float, kSide>, kSide>;

    /// Makes the table of a filter; nullptr for the box, which needs none.
    static std::unique_ptr<const FilterTable> make(PixelFilter filter);

    Shares shares_of(const StrokeMask& mask) const;

  private:
    explicit FilterTable(PixelFilter filter);

    static constexpr int kBytes = StrokeMask::kColumns / 8;
    /// Per byte of a row and its value: the sum of the weights of its samples in x.
    std::array<std::array<std::array<float, kSide>, 256>, kBytes> columns_;
    std::array<std::array<float, kSide>, StrokeMask::kRows> rows_;
};

}  // namespace burin
