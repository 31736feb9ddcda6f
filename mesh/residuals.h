#pragma once

#include <glm/glm.hpp>

// Files that single precision would blur keep the rest of each coordinate beside it.

namespace burin {

/// What single precision leaves of a place that it has rounded, in single precision again.
inline glm::vec3 residual_of(const glm::dvec3& place, const glm::vec3& rounded) {
    return glm::vec3(place - glm::dvec3(rounded)) + 0.0f;
}

/// Adds a vertex to what has `positions` and `residuals`, as Mesh has. `has_residuals`: whether it
/// is one of those.
template <typename Vertices>
void add_position(Vertices& vertices, const glm::dvec3& place, bool has_residuals) {
    const glm::vec3 rounded(place);
    vertices.positions.push_back(rounded);
    if (has_residuals) vertices.residuals.push_back(residual_of(place, rounded));
}

}  // namespace burin
