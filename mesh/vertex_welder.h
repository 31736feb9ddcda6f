#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

// Vertices in one place become one, for files write every polygon with corners of its own.

namespace burin {

/// For every position the number of the first one with equal coordinates. There must be no -0 and
/// no NaN among the coordinates.
std::vector<std::uint32_t> weld_vertices(std::span<const glm::vec3> positions);

}  // namespace burin
