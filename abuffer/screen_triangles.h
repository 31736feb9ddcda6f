#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "abuffer/screen_triangle.h"
#include "abuffer/tile_kernels.h"

namespace burin {

/// A triangle whose corners all lie on the screen, from the picture's corner. `facing`: the way they are wound, clockwise or
/// counterclockwise.
inline CrossedTriangle crossed_triangle(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, Facing facing,
                                        std::uint32_t number) {
    const ScreenVertex &p = facing == clockwise ? b : c, &q = facing == clockwise ? c : b;
    const auto real = [](std::int32_t subpixels) { return static_cast<float>(subpixels); };
    return {{real(a.x), real(p.x), real(q.x)},
            {real(a.y), real(p.y), real(q.y)},
            std::max(std::max(a.nearness, b.nearness), c.nearness),
            number};
}

/// Triangles, an array per number as the kernels want them.
class ScreenTriangles {
  public:
    /// Those before stay; the others mean nothing until they are set.
    void resize(std::size_t count) {
        for (auto& list : numbers_) list.resize(std::max(list.size(), count + kPadding));
    }
    void set(std::size_t i, const CrossedTriangle& t) {
        for (std::size_t k = 0; k < 3; ++k) {
            numbers_[k][i] = t.x[k];
            numbers_[3 + k][i] = t.y[k];
        }
        numbers_[6][i] = t.highest;
    }
    /// All at once.
    void set_all(const TileKernels& kernels, std::span<const CrossedTriangle> triangles) {
        float* numbers[7];
        for (std::size_t k = 0; k < 7; ++k) numbers[k] = numbers_[k].data();
        kernels.transpose_triangles(triangles.data(), triangles.size(), numbers);
    }
    TriangleView view() const {
        const auto at = [this](std::size_t k) { return numbers_[k].data(); };
        return {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, at(6)};
    }

  private:
    static constexpr std::size_t kPadding = 15;  // what kernels may read too far
    std::array<std::vector<float>, 7> numbers_;
};

}  // namespace burin
