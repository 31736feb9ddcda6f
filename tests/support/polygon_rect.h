#pragma once

#include <vector>

#include "view/screen_polygon.h"

namespace burin::test {

/// Whether a convex polygon and a rectangle, borders included, have a place in common, by clipping one at the other's
/// sides. 1/256 pixel.
inline bool touches(const ScreenPolygon& polygon, glm::dvec2 low, glm::dvec2 high) {
    std::vector<glm::dvec2> left;
    for (int i = 0; i < polygon.count; ++i) {
        const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
        left.emplace_back(p.x, p.y);
    }
    const auto clip = [&](const auto& inside) {
        std::vector<glm::dvec2> kept;
        for (std::size_t i = 0; i < left.size(); ++i) {
            const glm::dvec2 a = left[i], b = left[(i + 1) % left.size()];
            const double da = inside(a), db = inside(b);
            if (da >= 0) kept.push_back(a);
            if ((da >= 0) != (db >= 0)) kept.push_back(a + (b - a) * (da / (da - db)));
        }
        left = kept;
    };
    clip([&](glm::dvec2 p) { return p.x - low.x; });
    clip([&](glm::dvec2 p) { return high.x - p.x; });
    clip([&](glm::dvec2 p) { return p.y - low.y; });
    clip([&](glm::dvec2 p) { return high.y - p.y; });
    return !left.empty();
}

}  // namespace burin::test
