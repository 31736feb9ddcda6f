#pragma once

#include <glm/glm.hpp>

#include "scene/animation/key_curve.h"
#include "scene/camera.h"

namespace burin {

/// Where something stands: scaled first, then turned about X, Y and Z, then moved.
struct Placement {
    glm::dvec3 translate{0.0};
    glm::dvec3 rotate_deg{0.0};
    glm::dvec3 scale{1.0};
};
glm::dmat4 matrix_of(const Placement& placement);

/// The keys of an object of a scene file: [[object.key]].
struct ObjectKeys {
    Interpolation interpolation = Interpolation::smooth;
    KeyCurve<glm::dvec3> translate, rotate_deg, scale;
    Placement rest;  ///< what has no keys

    bool empty() const { return translate.empty() && rotate_deg.empty() && scale.empty(); }
    glm::dmat4 at(double frame) const;
};

/// The keys of a camera of a scene file: [[camera.key]].
struct CameraKeys {
    Interpolation interpolation = Interpolation::smooth;
    KeyCurve<glm::dvec3> eye, target, up;
    KeyCurve<double> fov_deg, height;

    bool empty() const { return eye.empty() && target.empty() && up.empty() && fov_deg.empty() && height.empty(); }
    /// The camera at a frame; `rest` says what has no keys.
    CameraSettings at(double frame, const CameraSettings& rest) const;
};

}  // namespace burin
