#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "abuffer/tile_kernels.h"

namespace burin {

/// A triangle on the screen: corners in 1/256 pixel, clockwise as seen, and the nearness of the nearest one.
struct FlatTriangle {
    std::array<float, 3> x, y;
    float highest;
};

/// Triangles, an array per number as the kernels want them.
class ScreenTriangles {
  public:
    /// Those before stay; the others mean nothing until they are set.
    void resize(std::size_t count) {
        for (auto& list : numbers_) list.resize(std::max(list.size(), count + kPadding));
    }
    void set(std::size_t i, const FlatTriangle& t) {
        for (std::size_t k = 0; k < 3; ++k) {
            numbers_[k][i] = t.x[k];
            numbers_[3 + k][i] = t.y[k];
        }
        numbers_[6][i] = t.highest;
    }
    TriangleView view() const {
        const auto at = [this](std::size_t k) { return numbers_[k].data(); };
        return {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, at(6)};
    }

  private:
    static constexpr std::size_t kPadding = 7;  // what kernels may read too far
    std::array<std::vector<float>, 7> numbers_;
};

}  // namespace burin
