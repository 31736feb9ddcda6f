#pragma once

#include "mesh/mesh.h"

namespace burin {

/// Gives polygons that have no area, as where vertices of a mesh that deforms come together, the normal of a neighbour
/// across an edge, so that nothing turns at the edges between them: without a normal all of these would be creases. To
/// be called for a mesh that is linked; it stays as it is if all polygons have an area.
void lend_normals_to_flat_triangles(Mesh& mesh);

}  // namespace burin
