#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/polygon_mesh.h"
#include "mesh/polygon_soup.h"

namespace burin {

/// AttributeCarrier brings values at the corners of a soup's polygons to the triangles of the meshes that are made of
/// them.
class AttributeCarrier {
  public:
    /// The soup's layers must have lists of rows. `welded`: per vertex of the soup the number of the first one at its
    /// place. Both must outlive this.
    AttributeCarrier(const PolygonSoup& soup, const std::vector<std::uint32_t>& welded);

    /// The layers of a mesh that was triangulated from `polygons`, which has its sources. A layer of which the mesh has
    /// no value is left out.
    std::vector<AttributeLayer> carry(const PolygonMesh& polygons, const Mesh& mesh);

  private:
    void list_corners(std::uint32_t polygon);
    std::uint32_t corner_at(std::uint32_t vertex) const;

    const PolygonSoup& soup_;
    const std::vector<std::uint32_t>& welded_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> corners_;  // of one polygon: welded vertex, corner
    std::vector<std::vector<std::uint32_t>> own_rows_;              // per layer and row of the soup: that of the mesh
};

}  // namespace burin
