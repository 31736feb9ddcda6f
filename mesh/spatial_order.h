#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "base/unfilled_vector.h"

namespace burin {

/// Meshes of so many triangles and more are put in spatial order; smaller ones fit the caches in any.
constexpr std::size_t kWorthSpatialOrder = std::size_t{1} << 16;

/// The numbers of all triangles, those near each other together: by the first cell that has a corner of theirs, of 32 x 32 x 32
/// cells over the model, row by row, and in a cell in the order given. So triangles with corners at the same places keep their
/// order. `corners`: three per triangle, numbers of `positions`, all of them finite.
UnfilledVector<std::uint32_t> spatial_order(std::span<const std::uint32_t> corners, std::span<const glm::vec3> positions);

}  // namespace burin
