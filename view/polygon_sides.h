#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "view/screen_polygon.h"

// Tiles that a long polygon does not touch, though its box does, are told by the sides of the polygon.

namespace burin {

/// The half planes beside the edges of a convex polygon, which tell rectangles that lie beside it though within its
/// box: long triangles touch few of the tiles there.
class PolygonSides {
  public:
    explicit PolygonSides(const ScreenPolygon& polygon) {
        for (int i = 0; i < polygon.count; ++i) {
            const SubpixelPoint a = polygon.corners[static_cast<std::size_t>(i)];
            const SubpixelPoint b = polygon.corners[static_cast<std::size_t>((i + 1) % polygon.count)];
            Side side{a.x, a.y, std::int64_t{b.x} - a.x, std::int64_t{b.y} - a.y};
            bool has_left = false, has_right = false;
            for (int k = 0; k < polygon.count; ++k) {
                const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(k)];
                const std::int64_t at = side.at(p.x, p.y);
                has_left = has_left || at < 0;
                has_right = has_right || at > 0;
            }
            if (has_left == has_right) continue;  // snapping bends edges of a few subpixels
            if (has_left) side = {side.x, side.y, -side.dx, -side.dy};
            sides_[count_++] = side;
        }
    }

    /// Whether a rectangle lies beside the polygon, with all of its boundary, for certain. 1/256 pixel, no farther than
    /// the guard band.
    bool leave_out(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1) const {
        return std::any_of(sides_.begin(), sides_.begin() + count_,
                           [&](const Side& s) { return s.at(s.dy > 0 ? x0 : x1, s.dx > 0 ? y1 : y0) < 0; });
    }

  private:
    struct Side {  // a point and a direction; the polygon lies where at() >= 0
        std::int64_t x, y, dx, dy;
        std::int64_t at(std::int64_t px, std::int64_t py) const { return dx * (py - y) - dy * (px - x); }
    };
    std::ptrdiff_t count_ = 0;
    std::array<Side, ScreenPolygon::kMaxCorners> sides_;
};

}  // namespace burin
