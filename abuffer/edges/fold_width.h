#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "kernels/screen_triangle.h"
#include "mesh/mesh.h"

// Folds too narrow to be seen are no contours, so their width is measured.

namespace burin {

/// Whether a contour at an edge turns back by more than a negligible fold, along rows or columns as samples would see
/// it, or comes back to the edge at another nearness. `half_edge`: one on the edge; `at`: a place there in 1/256 pixel,
/// and `nearness` at it. Nearness that differs by at most `level` is one.
bool is_fold_wide(const ScreenMesh& mesh, HalfEdge half_edge, glm::dvec2 at, double nearness, double level);

/// What is around a place on an edge, where the surface is cut along a row or a column of pixels.
enum class Ring : std::uint8_t {
    none,     ///< the cut is no closed curve, or wider than a wire
    behind,   ///< it is, and another edge that may be a line is nearer to the eye there
    in_front  ///< it is, and the edge is the nearest, or one of them
};

/// A surface that closes around within 1/8 pixel is a wire there: a line, however thin it is. `half_edge`, `at` and
/// `nearness` as above; what is nearer by at most `level` counts as equal. Which way its triangles face does not
/// matter, since rounding may have decided it.
Ring ring_around(const ScreenMesh& mesh, HalfEdge half_edge, glm::dvec2 at, double nearness, double level);

/// The border on the other side of a strip that is no wider than a wire at a place on its `border`; kNoHalfEdge if
/// there is none.
HalfEdge other_side_of_strip(const ScreenMesh& mesh, HalfEdge border, glm::dvec2 at);

/// A range of x or y, without its ends, in 1/256 pixel.
struct OpenRange {
    double low = 0, high = 0;
    bool contains(double v) const { return v > low && v < high; }
};

/// Where on an edge that runs along a row or a column no fold is wide, whatever its nearness: a range of x or y around
/// a place on it. Surfaces that are seen exactly edge-on may have a hundred triangles in one place, which are gone
/// through once for all of the range. Empty where it is not so, or not certain.
OpenRange narrow_range(const ScreenMesh& mesh, HalfEdge half_edge, glm::dvec2 at);

}  // namespace burin
