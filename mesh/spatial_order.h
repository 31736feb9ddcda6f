#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "base/unfilled_vector.h"
#include "mesh/polygon_soup.h"

// Large meshes are put in an order in which neighbours lie near each other in memory
// (docs/decisions/0014-spatial-order.md).

namespace burin {

/// Meshes of this many polygons and more are put in spatial order; smaller ones fit the caches in any.
constexpr std::size_t kWorthSpatialOrder = std::size_t{1} << 16;

/// Puts polygons together that are near each other: by the first cell that has a corner of theirs, of 16 x 16 x 16
/// cells over the model, row by row, and in a cell in the order given. So triangles with corners at the same places
/// keep their order.
class SpatialOrder {
  public:
    /// `positions`: of vertices, all of them finite. `corners`: of polygons, numbers of vertices; of other vertices,
    /// where they are does not count.
    SpatialOrder(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners);

    /// The numbers of all triangles. `corners`: three vertices per triangle.
    UnfilledVector<std::uint32_t> of_triangles(std::span<const std::uint32_t> corners) const;
    /// The order of some polygons of a soup, as places in `polygons`, which has their numbers.
    UnfilledVector<std::uint32_t> of_polygons(const PolygonSoup& soup, std::span<const std::uint32_t> polygons) const;

  private:
    UnfilledVector<std::uint16_t> cells_;  // of vertices
};

}  // namespace burin
