#include "scene/animation/turntable.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

namespace burin {
namespace {

/// The points of a sphere that decide how far a camera with these axes must be away, and those farthest along the
/// world's axes.
PointSource sphere_points(const glm::dvec3& center, double radius, const glm::dmat3& axes, const glm::dvec2& slopes) {
    std::vector<glm::dvec3> points;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 along(0.0);
            along[axis] = side;
            points.push_back(center + radius * along);
            points.push_back(center + radius * side * axes[axis]);
            // Where planes through the eye touch the sphere.
            if (axis < 2)
                points.push_back(center + radius * glm::normalize(side * axes[axis] + slopes[axis] * axes[2]));
        }
    }
    return [points](const PointVisitor& visit) { visit(points); };
}

}  // namespace

double degrees_at(const Turntable& turntable, double frame) {
    return std::fmod(turntable.degrees * (frame - turntable.first) / turntable.frames, 360.0);
}

Camera turned(const Camera& camera, const Turntable& turntable, const glm::dvec3& target, double frame) {
    const double degrees = degrees_at(turntable, frame);
    if (degrees == 0) return camera;
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), glm::radians(degrees), glm::normalize(turntable.axis)));
    Camera result = camera;
    for (int column = 0; column < 3; ++column)
        result.to_world[column] = glm::dvec4(turn * glm::dvec3(camera.to_world[column]), 0.0);
    result.to_world[3] = glm::dvec4(target + turn * (camera.eye() - target), 1.0);
    return result;
}

Camera resolve_turning_camera(const CameraSettings& settings, const PointSource& points, double aspect) {
    const bool is_fitted = !settings.to_world && (!settings.eye || (settings.orthographic && !settings.height));
    if (!is_fitted) return resolve_camera(settings, points, aspect);
    const Camera first = resolve_camera(settings, points, aspect);  // its axes stay
    const Box box = box_of(points);
    const glm::dvec3 middle = 0.5 * (box.low + box.high);
    CameraSettings around = settings;
    if (!around.target) around.target = middle;
    const double radius = 0.5 * glm::distance(box.low, box.high) + glm::distance(middle, *around.target);
    const glm::dvec2 share = settings.area.high - settings.area.low;
    const double slope = settings.fit * std::tan(glm::radians(settings.fov_deg) / 2);
    const glm::dvec2 slopes(slope * aspect * share.x / share.y * settings.pixel_aspect, slope);
    return resolve_camera(around, sphere_points(*around.target, radius, glm::dmat3(first.to_world), slopes), aspect);
}

}  // namespace burin
