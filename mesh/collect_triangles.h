#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/polygon_soup.h"

// Objects of nothing but triangles, as nearly all large models are, take a faster way to a mesh than ObjectCollector,
// with the same result.

namespace burin {

/// One object that has nothing but triangles: no other polygons, no materials, no marks. Nearly all
/// large models are like that.
bool has_only_triangles(const PolygonSoup& soup);

/// What ObjectCollector collects from a soup that has_only_triangles, faster, and into a mesh: its positions,
/// triangles, polygon count and repairs. Arguments as there. `in_spatial_order`: as SpatialOrder has them, with where
/// they stood as the mesh's `input_order`.
void collect_triangles(const PolygonSoup& soup, const std::vector<glm::vec3>& positions,
                       const std::vector<std::uint32_t>& welded, bool in_spatial_order, Mesh& mesh);

}  // namespace burin
