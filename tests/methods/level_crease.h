#pragma once

#include <string>
#include <vector>

#include "tests/support/shaded_scene.h"

// Small scenes with one line that is easy to measure.

namespace burin::test {

/// A strip folded along a line of the picture, whose crease is its one line of that class. Depth runs from z0 to z1.
inline PolygonSoup folded(glm::dvec3 from, glm::dvec3 to) {
    const glm::dvec3 flat = glm::normalize(glm::dvec3(to.x - from.x, to.y - from.y, 0));
    const glm::dvec3 across = 4.0 * glm::dvec3(-flat.y, flat.x, 0), down(0, 0, -4);
    return soup_of({from, to, to + across + down, from + across + down, to - across + down, from - across + down},
                   {{0, 1, 2, 3}, {1, 0, 5, 4}});
}
inline PolygonSoup rectangle(double x0, double y0, double x1, double y1, double z) {
    return soup_of({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, {{0, 1, 2, 3}});
}
/// A level crease from x0 to x1 at row y.
inline ShadedScene level(double x0, double x1, double y, const std::string& style, const std::string& set = "",
                         std::vector<PolygonSoup> more = {}) {
    std::vector<PolygonSoup> objects{folded({x0, 100 - y, 0}, {x1, 100 - y, 0})};
    objects.insert(objects.end(), more.begin(), more.end());
    return {objects, pixel_camera(240, 100), sheet_of(R"("crease")", style, set), 240, 100};
}

}  // namespace burin::test
