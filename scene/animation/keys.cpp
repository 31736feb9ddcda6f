#include "scene/animation/keys.h"

#include <glm/gtc/matrix_transform.hpp>

namespace burin {

glm::dmat4 matrix_of(const Placement& placement) {
    glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), placement.translate);
    matrix = glm::rotate(matrix, glm::radians(placement.rotate_deg.z), glm::dvec3(0, 0, 1));
    matrix = glm::rotate(matrix, glm::radians(placement.rotate_deg.y), glm::dvec3(0, 1, 0));
    matrix = glm::rotate(matrix, glm::radians(placement.rotate_deg.x), glm::dvec3(1, 0, 0));
    return glm::scale(matrix, placement.scale);
}

glm::dmat4 ObjectKeys::at(double frame) const {
    Placement placement = rest;
    if (!translate.empty()) placement.translate = translate.at(frame, interpolation);
    if (!rotate_deg.empty()) placement.rotate_deg = rotate_deg.at(frame, interpolation);
    if (!scale.empty()) placement.scale = scale.at(frame, interpolation);
    return matrix_of(placement);
}

CameraSettings CameraKeys::at(double frame, const CameraSettings& rest) const {
    CameraSettings camera = rest;
    if (!eye.empty()) camera.eye = eye.at(frame, interpolation);
    if (!target.empty()) camera.target = target.at(frame, interpolation);
    if (!up.empty()) camera.up = up.at(frame, interpolation);
    if (!fov_deg.empty()) camera.fov_deg = fov_deg.at(frame, interpolation);
    if (!height.empty()) camera.height = height.at(frame, interpolation);
    return camera;
}

}  // namespace burin
