#pragma once

#include <glm/glm.hpp>

#include "abuffer/screen_triangle.h"
#include "mesh/mesh.h"

namespace burin {

/// Whether the surface on one side of an edge goes on for at least a distance on the screen, along `way` or
/// against it, or comes back to the edge at another nearness: else it is a negligible fold or spike.
/// `half_edge`: of the triangle on that side; `at`: a place on the edge and `least` in 1/256 pixel,
/// `nearness` there. Nearness that differs by at most `level` is one.
bool is_surface_wide(const ScreenMesh& mesh, HalfEdge half_edge, glm::dvec2 at, double nearness,
                     glm::dvec2 way, double least, double level);

}  // namespace burin
