#pragma once

#include <algorithm>
#include <cmath>

#include "methods/gbuffer/raster.h"

// Images of lines are widened and smoothed.

namespace burin {

/// Largest value (0 or more) within a disc of `radius` samples. The result is floor(radius) samples
/// smaller.
inline Raster<float> dilate(const Raster<float>& image, double radius) {
    const int reach = static_cast<int>(radius);
    if (reach < 1) return image;
    const PixelRect from = image.rect(), to = grown(from, -reach);
    Raster<float> result(to);
    // Lines are sparse: every sample of one is spread, instead of every sample looking around.
    for (int y = from.y0; y < from.y1; ++y) {
        for (int x = from.x0; x < from.x1; ++x) {
            const float value = image.at(x, y);
            if (value <= 0) continue;
            for (int v = std::max(y - reach, to.y0); v < std::min(y + reach + 1, to.y1); ++v) {
                const int half = static_cast<int>(std::sqrt(radius * radius - (v - y) * (v - y)));
                for (int u = std::max(x - half, to.x0); u < std::min(x + half + 1, to.x1); ++u) {
                    result.at(u, v) = std::max(result.at(u, v), value);
                }
            }
        }
    }
    return result;
}

/// The value between four samples; (0, 0) is the middle of sample (x, y).
inline float bilinear(const Raster<float>& image, int x, int y, double dx, double dy) {
    const double left = std::floor(dx), top = std::floor(dy);
    const int x0 = x + static_cast<int>(left), y0 = y + static_cast<int>(top);
    const auto u = static_cast<float>(dx - left), v = static_cast<float>(dy - top);
    const float upper = image.at(x0, y0) * (1 - u) + image.at(x0 + 1, y0) * u;
    const float lower = image.at(x0, y0 + 1) * (1 - u) + image.at(x0 + 1, y0 + 1) * u;
    return upper * (1 - v) + lower * v;
}

constexpr int kSmoothReach = 5;  ///< how many samples smaller smooth_along_lines() is on every side

/// Blurs along lines, as Timothy Lottes' "FXAA" (NVIDIA, 2009) does in its short form: the four
/// diagonal neighbours tell the direction of the line; two, then four values along it are averaged,
/// the four only if they stay within the range of the neighbours.
inline Raster<float> smooth_along_lines(const Raster<float>& image) {
    constexpr double kLongest = 8;
    return raster_of(grown(image.rect(), -kSmoothReach), [&](int x, int y) {
        const Block<float> n = block_at(image, x, y);
        double along_x = static_cast<double>(n.f + n.h - n.a - n.c);
        double along_y = static_cast<double>(n.a + n.f - n.c - n.h);
        const double steady = std::max(static_cast<double>(n.a + n.c + n.f + n.h) / 32, 1.0 / 128);
        const double scale = 1 / (std::min(std::abs(along_x), std::abs(along_y)) + steady);
        along_x = std::clamp(along_x * scale, -kLongest, kLongest);
        along_y = std::clamp(along_y * scale, -kLongest, kLongest);
        const auto value = [&](double t) { return bilinear(image, x, y, along_x * t, along_y * t); };
        const float two = 0.5f * (value(-1.0 / 6) + value(1.0 / 6));
        const float four = 0.5f * two + 0.25f * (value(-0.5) + value(0.5));
        const auto [low, high] = std::minmax({n.a, n.c, n.x, n.f, n.h});
        return four < low || four > high ? two : four;
    });
}

}  // namespace burin
