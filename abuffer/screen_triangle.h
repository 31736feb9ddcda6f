#pragma once

#include <cstdint>
#include <limits>

#include "abuffer/subpixel.h"

namespace burin {

/// A vertex on the screen: snapped position in 1/256 pixel and nearness, less a constant of the
/// frame so that single precision resolves the scene. `x == kOffScreen`: it lies behind the near
/// plane or outside the guard band, and its triangles need clipping.
struct ScreenVertex {
    static constexpr std::int32_t kOffScreen = std::numeric_limits<std::int32_t>::min();
    std::int32_t x = 0;
    std::int32_t y = 0;
    float nearness = 0;
};

/// A triangle whose corners all lie on the screen.
struct ScreenTriangle {
    ScreenVertex corners[3];
    std::uint32_t id = 0;  ///< see SampleTile
};
static_assert(sizeof(ScreenTriangle) == 40);

/// Twice the area in (1/256 pixel)^2; positive if the corners run clockwise as seen on the screen.
inline std::int64_t doubled_area(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) {
    return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

}  // namespace burin
