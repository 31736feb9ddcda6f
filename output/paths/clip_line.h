#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace burin {

/// What of a line lies in a rectangle.
struct ClippedPart {
    std::vector<glm::dvec2> points;
    double begin_px = 0;  ///< how far along the line it begins
};

/// The parts of a line that lie between two corners of a rectangle, borders included, in their order.
std::vector<ClippedPart> clipped_line(std::span<const glm::dvec2> line, glm::dvec2 low, glm::dvec2 high);

}  // namespace burin
