#include "abuffer/fine/covering_triangles.h"

#include <algorithm>
#include <array>

#include "abuffer/fine/fine_edges.h"

namespace burin {
namespace {

bool covers(const CrossedTriangle& t, const glm::dvec2& low, const glm::dvec2& high) {
    const std::array<glm::dvec2, 3> corners{glm::dvec2(t.x[0], t.y[0]), {t.x[1], t.y[1]}, {t.x[2], t.y[2]}};
    double least = 0, most = 0;  // of what edges say of the block's corners
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 from = corners[k], along = corners[(k + 1) % 3] - from;
        // What an edge says of a place is linear: its least and its most are at two corners.
        const glm::dvec2 u = along.x * glm::dvec2(low.y - from.y, high.y - from.y),
                         v = along.y * glm::dvec2(low.x - from.x, high.x - from.x);
        least = std::min(least, std::min(u.x, u.y) - std::max(v.x, v.y));
        most = std::max(most, std::max(u.x, u.y) - std::min(v.x, v.y));
    }
    return (least == 0) != (most == 0);
}

}  // namespace

std::size_t count_covering(const ScreenSurfaces& screen, const std::vector<CrossedTriangle>& triangles,
                           glm::ivec2 corner) {
    const glm::dvec2 low(corner), high(corner + (1 << SampleBlocks::kShift));
    return static_cast<std::size_t>(std::count_if(triangles.begin(), triangles.end(), [&](const CrossedTriangle& t) {
        return covers(t, low, high) && screen.facing(t.number) != off_screen;
    }));
}

}  // namespace burin
