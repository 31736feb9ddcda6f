#pragma once

#include <glm/glm.hpp>

#include "scene/camera.h"

namespace burin {

/// A camera that goes around what it looks at, once in so many frames: [turntable].
struct Turntable {
    int frames = 0;
    glm::dvec3 axis{0, 1, 0};  ///< through the camera's target
    double degrees = 360;      ///< in all; counter-clockwise, seen from the tip of the axis
    double first = 1;          ///< the frame at which nothing is turned
};

/// The angle at a frame, less whole turns: frames that are a turn apart have exactly the same.
double degrees_at(const Turntable& turntable, double frame);

/// A camera as it is at a frame. `target`: what the axis goes through.
Camera turned(const Camera& camera, const Turntable& turntable, const glm::dvec3& target, double frame);

/// The camera that a turntable turns: one that is fitted sees a sphere around all points, so that the scene fits from
/// all sides. Throws as resolve_camera().
Camera resolve_turning_camera(const CameraSettings& settings, const PointSource& points, double aspect);

}  // namespace burin
