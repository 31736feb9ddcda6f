#pragma once

#include <glm/glm.hpp>

#include "abuffer/screen_triangle.h"
#include "mesh/mesh.h"

namespace burin {

/// Whether a contour at an edge turns back by more than a negligible fold, along rows or columns as samples would see it, or
/// comes back to the edge at another nearness. `half_edge`: one on the edge; `at`: a place there in 1/256 pixel, and `nearness`
/// at it. Nearness that differs by at most `level` is one.
bool is_fold_wide(const ScreenMesh& mesh, HalfEdge half_edge, glm::dvec2 at, double nearness, double level);

/// A range of x or y, without its ends, in 1/256 pixel.
struct OpenRange {
    double low = 0, high = 0;
    bool contains(double v) const { return v > low && v < high; }
};

/// Where on an edge that runs along a row or a column no fold is wide, whatever its nearness: a range of x or y around a place on it.
/// Surfaces that are seen exactly edge-on may have a hundred triangles in one place, which are gone through once for all of the range.
/// Empty where it is not so, or not certain.
OpenRange narrow_range(const ScreenMesh& mesh, HalfEdge half_edge, glm::dvec2 at);

}  // namespace burin
