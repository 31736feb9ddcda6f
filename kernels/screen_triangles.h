#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "kernels/screen_triangle.h"
#include "kernels/tile_kernels.h"

// Triangles that may hide lines, and the boxes around them, are made from vertices on the screen.

namespace burin {

/// Makes a triangle that lines may cross from corners that all lie on the screen; places count from the picture's
/// corner. `facing`: the way they are wound, clockwise or counterclockwise.
inline CrossedTriangle crossed_triangle(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c,
                                        Facing facing, std::uint32_t number) {
    const ScreenVertex &p = facing == clockwise ? b : c, &q = facing == clockwise ? c : b;
    const auto real = [](std::int32_t subpixels) { return static_cast<float>(subpixels); };
    return {{real(a.x), real(p.x), real(q.x)},
            {real(a.y), real(p.y), real(q.y)},
            std::max(std::max(a.nearness, b.nearness), c.nearness),
            number};
}

/// The boxes of triangles, an array per number as the kernels want them.
class TriangleBoxes {
  public:
    /// Boxes that were there before stay; the others mean nothing until they are set.
    void resize(std::size_t count) {
        for (auto& list : numbers_) list.resize(std::max(list.size(), count + kPadding));
    }
    void set_all(const TileKernels& kernels, std::span<const CrossedTriangle> triangles) {
        resize(triangles.size());
        float* numbers[kNumbers];
        for (std::size_t k = 0; k < kNumbers; ++k) numbers[k] = numbers_[k].data();
        kernels.fine.box_triangles(triangles.data(), triangles.size(), numbers);
    }
    /// Sets the boxes of `others` with the numbers listed, one after the other.
    void set_listed(const TriangleBoxes& others, std::span<const std::uint32_t> listed) {
        resize(listed.size());
        for (std::size_t k = 0; k < kNumbers; ++k) {
            for (std::size_t i = 0; i < listed.size(); ++i) numbers_[k][i] = others.numbers_[k][listed[i]];
        }
    }
    FrontBoxes view() const {
        const auto at = [this](std::size_t k) { return numbers_[k].data(); };
        return {at(0), at(1), at(2), at(3), at(4)};
    }

    static constexpr std::size_t kPadding = 15;  ///< what kernels may read, or list, too far

  private:
    static constexpr std::size_t kNumbers = 5;
    std::array<std::vector<float>, kNumbers> numbers_;
};

}  // namespace burin
