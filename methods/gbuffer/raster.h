#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "image/image.h"

// A raster is an image of one value per sample.

namespace burin {

/// One value per sample of a rectangle; the image that the operators of method gbuffer work on.
/// Positions are those of the whole picture, so that pieces of it fit together.
template <typename T>
class Raster {
  public:
    Raster() = default;
    explicit Raster(PixelRect rect, const T& value = T{})
        : rect_(rect),
          values_(static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height()), value) {}

    const PixelRect& rect() const { return rect_; }
    bool empty() const { return values_.empty(); }
    T& at(int x, int y) { return values_[index(x, y)]; }
    const T& at(int x, int y) const { return values_[index(x, y)]; }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - rect_.y0) * static_cast<std::size_t>(rect_.width()) +
               static_cast<std::size_t>(x - rect_.x0);
    }
    PixelRect rect_;
    std::vector<T> values_;
};

constexpr PixelRect grown(PixelRect r, int by) { return {r.x0 - by, r.y0 - by, r.x1 + by, r.y1 + by}; }

constexpr PixelRect common(PixelRect a, PixelRect b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

/// The raster of function(x, y) over a rectangle.
template <typename Function>
auto raster_of(PixelRect rect, const Function& function) {
    Raster<decltype(function(0, 0))> result(rect);
    for (int y = rect.y0; y < rect.y1; ++y) {
        for (int x = rect.x0; x < rect.x1; ++x) result.at(x, y) = function(x, y);
    }
    return result;
}

/// A sample and its eight neighbours, named as Saito & Takahashi (1990) do:
///
///     A B C
///     D X E
///     F G H
template <typename T>
struct Block {
    T a, b, c, d, x, e, f, g, h;
};

template <typename T>
Block<T> block_at(const Raster<T>& r, int x, int y) {
    return {r.at(x - 1, y - 1), r.at(x, y - 1),     r.at(x + 1, y - 1), r.at(x - 1, y),    r.at(x, y),
            r.at(x + 1, y),     r.at(x - 1, y + 1), r.at(x, y + 1),     r.at(x + 1, y + 1)};
}

}  // namespace burin
