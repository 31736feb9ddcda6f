#pragma once

#include "view/surface_set.h"

// Surfaces that are one surface, rounded in two ways, are told from surfaces that pass through each other.

namespace burin {

// Searches around many pairs of triangles come to the same pairs again and again: with a `memory`, which belongs to one
// thread, these are compared once. The answers are the same.

/// Whether two triangles that overlap at a place on the screen belong to surfaces that stay so near each other around
/// them that nobody sees where they pass through each other (docs/decisions/0017-rounded-copies.md).
bool run_along(const SurfaceSet& surfaces, SurfaceId a, SurfaceId b, glm::dvec2 place, OrderMemory* memory = nullptr);
/// Whether two triangles run along each other and pass through each other as well: here the one is in front, there the
/// other one, as of a surface and its copy with rounded coordinates.
bool are_rounded_copies(const SurfaceSet& surfaces, SurfaceId a, SurfaceId b, OrderMemory* memory = nullptr);

}  // namespace burin
