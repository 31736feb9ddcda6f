#include "abuffer/screen/face_plane.h"

#include <algorithm>

namespace burin {

FacePlane::FacePlane(const SurfaceSet& surfaces, SurfaceId s) {
    glm::dvec3 c[3];
    surfaces.view_corners(s, c);
    const glm::dvec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
    corner = c[0];
    is_counterclockwise = glm::dot(normal, surfaces.projection.orthographic ? glm::dvec3(0, 0, 1) : -c[0]) >= 0;
    to_eye = normal * ((is_counterclockwise ? 1 : -1) / std::max(glm::length(normal), 1e-300));
}

bool rises_in_front(const SurfaceSet& surfaces, SurfaceId s, const FacePlane& plane, double slack_px) {
    constexpr double kErrors = 4;  // of two triangles' coordinates
    glm::dvec3 own[3];
    surfaces.view_corners(s, own);
    return std::any_of(std::begin(own), std::end(own), [&](const glm::dvec3& corner) {
        // Behind the eye nothing has a size in pixels.
        const double slack = slack_px * std::max(surfaces.projection.pixel_size(-corner.z), 0.0);
        return plane.height(corner) > kErrors * surfaces.coordinate_error + slack;
    });
}

}  // namespace burin
