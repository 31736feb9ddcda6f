#pragma once

#include <optional>

#include "mesh/crack_sides.h"

namespace burin {

/// Closes the narrow cracks of a mesh: borders that run along each other become one, in the middle, also where one has
/// corners that the other has not. Needles whose short edge is left open then are taken out, see collapse_needles().
/// Polygons keep their numbers, their normals, and what was said about them; they may get more triangles, or none.
/// nullopt: there is nothing to close.
///
/// The sides of a crack are as near as `reach` and 1/20 of their length, or 1/4 of `reach` and 1/3 of their length, and
/// half of the height of their triangles or 1/8 of `reach`. What folds back on itself within 20 degrees is no crack.
/// The result does not depend on the order of the triangles. `threads`: 0 = all cores.
std::optional<Mesh> stitch_cracks(const Mesh& mesh, const CrackReach& reach, int threads);

}  // namespace burin
