#pragma once

#include <optional>

#include "mesh/crack_sides.h"

namespace burin {

/// Makes one border of two that run along each other from end to end: the vertices at their ends become one, in the
/// middle of all that meet there. No triangle collapses or turns by more than 60 degrees. Not where more than 64
/// borders lie beside one. nullopt: there are none. `threads`: 0 = all cores.
std::optional<Mesh> join_borders(const Mesh& mesh, const CrackReach& reach, int threads);

}  // namespace burin
