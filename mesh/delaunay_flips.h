#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace burin {

/// Flips edges between the triangles of one polygon until each is locally Delaunay (Lawson 1977), as far as rounding
/// tells and within a bounded number of flips: of all ways to cut the polygon up, the one with the largest smallest
/// angle. What lies in one line but for rounding then makes no needles, unless the polygon is one.
///
/// `points` span about 1. `triangles` turn left, cover the polygon once and have corner numbers into `points`.
void flip_to_delaunay(std::span<const glm::dvec2> points, std::span<std::array<std::uint32_t, 3>> triangles);

}  // namespace burin
