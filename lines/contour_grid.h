#pragma once

#include <glm/glm.hpp>

namespace burin {

/// Places of smooth contours are rounded to 1/4096 pixel: triangles at an edge come to the same place but for rounding,
/// and chains of lines need equal bits.
inline glm::dvec2 on_contour_grid(glm::dvec2 p) {
    constexpr double kGridPerPx = 4096;
    return glm::round(p * kGridPerPx) / kGridPerPx;
}

}  // namespace burin
