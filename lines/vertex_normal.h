#pragma once

#include <glm/glm.hpp>

#include "mesh/mesh.h"

namespace burin {

/// The normal of a smooth surface at a vertex, as make_smooth() defines it, for a few vertices of a large mesh: the
/// mean of the normals of the polygons that can be reached from a triangle's corner around the vertex over edges that
/// are no creases, weighted by their angles there. On the side to which the corner's polygon is wound; a unit vector.
/// `corner` has the number of the half-edge that starts there.
glm::dvec3 smooth_normal_at(const Mesh& mesh, HalfEdge corner, double cos_crease_angle);

/// The angle of a triangle at a corner, in radians.
double angle_at(const Mesh& mesh, HalfEdge corner);

/// Whether a surface is smooth over an edge: it has two polygons, which turn by less than the crease angle, and is not
/// marked.
bool is_smooth_edge(const Mesh& mesh, HalfEdge h, double cos_crease_angle);

}  // namespace burin
