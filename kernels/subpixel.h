#pragma once

#include <cmath>
#include <cstdint>

// Positions on the screen are whole numbers of 1/256 pixel.

namespace burin {

/// Screen positions are snapped once, to 1/256 pixel, and exact from then on (24.8 fixed point).
constexpr int kSubpixelsPerPixel = 256;

/// A position on the screen in 1/256 pixel: x to the right, y down, (0, 0) the upper left corner of
/// the upper left pixel.
struct SubpixelPoint {
    std::int32_t x = 0;
    std::int32_t y = 0;
    bool operator==(const SubpixelPoint&) const = default;
};

/// Turns a length or a place, a number or a vector, from 1/256 pixel into pixels. Exact, for 256 is a power of two.
/// kernels/loops do not use it: they call no inline function from elsewhere (tile_kernels.inc says why).
template <typename Length>
constexpr Length to_pixels(const Length& subpixels) {
    return subpixels / double{kSubpixelsPerPixel};
}
/// Turns a length or a place from pixels into 1/256 pixel; exact, too: nothing is snapped.
template <typename Length>
constexpr Length to_subpixels(const Length& pixels) {
    return pixels * double{kSubpixelsPerPixel};
}

/// Rounds a coordinate in pixels to the nearest 1/256 pixel. The result is in 1/256 pixel, still a
/// floating point number, so that any size of input is fine.
inline double snap_to_subpixels(double coordinate_px) { return std::floor(coordinate_px * kSubpixelsPerPixel + 0.5); }

}  // namespace burin
