#pragma once

#include <vector>

#include "mesh/gltf_plan.h"
#include "mesh/gltf_vertices.h"
#include "mesh/polygon_soup.h"

// The polygons, lines and marks of a glTF mesh are taken from its accessors.

namespace burin {

/// A glTF mesh as its accessors have it, before morph targets and skins move it.
struct GltfSurface {
    PolygonSoup soup;
    std::vector<GltfVertices> vertices;  ///< in order; together, all of the soup's
};

/// Expands the accessors of a mesh: triangles, and lines as marked edges. `attributes`: which further accessors.
GltfSurface expand_gltf_mesh(const GltfMeshPlan& plan, GltfBuffers& buffers, const AttributeWish& attributes);

}  // namespace burin
