#pragma once

#include <algorithm>
#include <glm/glm.hpp>

// What GLM has not.

namespace burin {

/// The z component of the cross product: twice the area of the triangle at the origin, > 0 where `b` is to the left of
/// `a` with y upwards.
inline double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// `v` at unit length; a vector of no length stays as it is.
inline glm::dvec3 unit(const glm::dvec3& v) { return v / std::max(glm::length(v), 1e-300); }

}  // namespace burin
