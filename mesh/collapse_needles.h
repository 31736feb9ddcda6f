#pragma once

#include <optional>

#include "mesh/crack_sides.h"

namespace burin {

/// Leaves out triangles with a short border, see CrackSides::is_end_of_needle(), which becomes a point in its middle:
/// those between other polygons, not strips that are thin all along. nullopt: there are none.
std::optional<Mesh> collapse_needles(const Mesh& mesh, const CrackReach& reach);

}  // namespace burin
