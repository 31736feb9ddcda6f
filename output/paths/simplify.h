#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace burin {

/// The distance of a point from a straight part of a line.
double distance_to_part(glm::dvec2 p, glm::dvec2 from, glm::dvec2 to);

/// Adds the points of a line but for those that it can do without: it stays within `bound_px` of them (Douglas and
/// Peucker 1973). Points at the place of the one before are left out, unless there are no others.
void simplify(std::span<const glm::dvec2> line, double bound_px, std::vector<glm::dvec2>& out);

}  // namespace burin
