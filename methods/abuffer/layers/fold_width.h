#pragma once

#include <glm/glm.hpp>

#include "abuffer/screen_triangle.h"
#include "mesh/mesh.h"

namespace burin {

/// Whether a contour at an edge turns back by more than a negligible fold, along rows or columns as samples would see it, or
/// comes back to the edge at another nearness. `half_edge`: one on the edge; `at`: a place there in 1/256 pixel, and `nearness`
/// at it. Nearness that differs by at most `level` is one.
bool is_fold_wide(const ScreenMesh& mesh, HalfEdge half_edge, glm::dvec2 at, double nearness, double level);

}  // namespace burin
