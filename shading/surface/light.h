#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "view/projection.h"

namespace burin {

/// A light as a scene has it: at a point, or so far away that all of its light comes from one direction.
struct SceneLight {
    bool is_at_point = false;
    bool is_in_camera = false;        ///< in the camera's axes; else in the world's
    glm::dvec3 place{0.0, 0.0, 1.0};  ///< its position, or a direction towards it
};

/// A light in view space.
struct ViewLight {
    bool is_at_point = false;
    glm::dvec3 place{0.0, 0.0, 1.0};  ///< its position, or the unit vector towards it

    /// The unit vector from a point towards it.
    glm::dvec3 towards(const glm::dvec3& from) const {
        if (!is_at_point) return place;
        const glm::dvec3 way = place - from;
        return way / std::max(glm::length(way), 1e-300);
    }
    /// Of the angle between the way towards it and a normal.
    double cosine(const glm::dvec3& normal, const glm::dvec3& from) const {
        if (!is_at_point) return glm::dot(normal, place);
        const glm::dvec3 way = place - from;
        return glm::dot(normal, way) / std::max(glm::length(way), 1e-300);
    }
    bool operator==(const ViewLight&) const = default;
};

inline ViewLight in_view(const SceneLight& light, const glm::dmat4& world_to_view) {
    const glm::dmat4 to_view = light.is_in_camera ? glm::dmat4(1.0) : world_to_view;
    if (light.is_at_point) return {true, glm::dvec3(to_view * glm::dvec4(light.place, 1.0))};
    return {false, glm::normalize(glm::dmat3(to_view) * light.place)};
}

/// The light of a scene that has none.
inline ViewLight light_at_eye(const Projection& projection) {
    if (projection.orthographic) return {false, {0, 0, 1}};
    return {true, {0, 0, 0}};
}

}  // namespace burin
