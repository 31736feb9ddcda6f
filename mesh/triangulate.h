#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

// Polygons of any shape are cut into triangles, without lines along the cuts.

namespace burin {

/// Area vector of a polygon: normal times twice the area (Newell's method). For polygons that are
/// not flat it is the direction from which they look largest.
glm::dvec3 area_vector(std::span<const glm::dvec3> corners);

/// Cuts a polygon of n >= 3 corners, convex or not, into n - 2 triangles of corner numbers, and
/// appends them to `triangles`. They cover the polygon seen along its area vector, once, and keep
/// its winding. The first one begins with a side of the polygon.
///
/// Ear clipping (Meisters 1975), with the reflex corners in a grid so that large polygons stay
/// fast, then flips to Delaunay (delaunay_flips.h). Corners may repeat coordinates (holes joined by a cut). A polygon
/// that crosses itself still gives n - 2 triangles.
void triangulate_polygon(std::span<const glm::dvec3> corners, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace burin
