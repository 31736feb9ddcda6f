#pragma once

#include <optional>

#include "mesh/crack_sides.h"

namespace burin {

/// Cuts borders where a corner of another border lies beside them (T-junctions), so that both can be joined from corner
/// to corner. Nothing moves; triangles are cut into fans that belong to the same polygon. nullopt: there are none.
/// `threads`: 0 = all cores.
std::optional<Mesh> split_borders(const Mesh& mesh, const CrackReach& reach, int threads);

}  // namespace burin
