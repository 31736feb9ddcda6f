#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "methods/wire/wire_pixel.h"

namespace burin {

/// The pixels of one tile, and the planes of the surfaces that they show.
class WirePixels {
  public:
    void clear(PixelRect rect) {
        rect_ = rect;
        pixels_.assign(static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height()), {});
        planes_.clear();
    }
    const PixelRect& rect() const { return rect_; }
    WirePixel& at(int x, int y) {
        return pixels_[static_cast<std::size_t>((y - rect_.y0) * rect_.width() + (x - rect_.x0))];
    }
    /// Where the next plane will be kept.
    std::uint32_t next_slot() const { return static_cast<std::uint32_t>(planes_.size()); }
    void keep(const DepthPlane& plane) { planes_.push_back(plane); }
    DepthPlane plane_of(const WirePixel& pixel) const {
        return pixel.surface.is_background() ? DepthPlane{} : planes_[pixel.slot];
    }
    /// If `is_open`, surfaces are not filled.
    void put_into(Film& film, const Frame& frame, bool is_open = false) {
        for (int y = rect_.y0; y < rect_.y1; ++y) {
            for (int x = rect_.x0; x < rect_.x1; ++x) {
                const WirePixel& pixel = at(x, y);
                film.put(x, y, finish_pixel(frame, pixel, plane_of(pixel), x, y, is_open));
            }
        }
    }

  private:
    PixelRect rect_;
    std::vector<WirePixel> pixels_;
    std::vector<DepthPlane> planes_;
};

}  // namespace burin
