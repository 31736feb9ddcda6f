#pragma once

#include <cstdint>
#include <vector>

#include "mesh/polygon_mesh.h"

namespace burin {

/// MovingVertices is what build_meshes() is told, and tells, about a soup of one object whose vertices will move while
/// the mesh that is made of it keeps its polygons.
struct MovingVertices {
    /// Told: per vertex of the soup, equal where vertices in one place move alike. Others are not welded, and a polygon
    /// without area is left out only if its corners move alike.
    std::vector<std::uint32_t> kinds;

    /// Per vertex of the mesh the vertex of the soup that it is. If it is subdivided: per vertex of `control`, then per
    /// vertex that only lines have.
    std::vector<std::uint32_t> sources;
    PolygonMesh control;  ///< what was subdivided; no polygons: nothing
};

}  // namespace burin
