#include "abuffer/depth_plane.h"

#include <cmath>

namespace burin {

DepthPlane depth_plane(const Projection& projection, const glm::dvec3 (&corners)[3],
                       double coordinate_error) {
    DepthPlane plane;
    double nearest = 1e300, farthest = -1e300;  // distances
    for (const glm::dvec3& corner : corners) {
        const double distance = std::max(-corner.z, projection.near_distance);
        nearest = std::min(nearest, distance);
        farthest = std::max(farthest, distance);
    }
    plane.highest = projection.nearness({0, 0, -nearest});
    plane.lowest = projection.nearness({0, 0, -farthest});

    // Points P of the plane fulfil n.P = c, with P = origin + t * direction on a pixel's view ray.
    const glm::dvec3 area = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const glm::dvec3 n = area / std::max(glm::length(area), 1e-300);
    const double c = glm::dot(n, corners[0]);
    const double f = projection.focal_px;
    const glm::dvec2 center = projection.center_px;
    if (projection.orthographic) {
        // z = (c - n.x x - n.y y) / n.z, x = (px - center.x) / f, y = (center.y - py) / f
        plane.per_x = -n.x / (n.z * f);
        plane.per_y = n.y / (n.z * f);
        plane.at_origin = c / n.z - plane.per_x * center.x - plane.per_y * center.y;
        plane.tolerance_constant = coordinate_error / std::abs(n.z);
    } else {
        // 1/t = n.direction / c, direction = ((px - center.x) / f, (center.y - py) / f, -1)
        plane.per_x = n.x / (f * c);
        plane.per_y = -n.y / (f * c);
        plane.at_origin = -n.z / c - plane.per_x * center.x - plane.per_y * center.y;
        plane.tolerance_per_nearness = coordinate_error / std::abs(c);
    }
    const bool usable = std::isfinite(plane.at_origin) && std::isfinite(plane.per_x) &&
                        std::isfinite(plane.per_y);
    if (!usable) {  // seen exactly edge-on: any place of it will do
        plane.per_x = plane.per_y = 0;
        plane.at_origin = plane.highest;
        plane.tolerance_constant = plane.tolerance_per_nearness = 0;
    }
    if (!std::isfinite(plane.tolerance_constant)) plane.tolerance_constant = 0;
    if (!std::isfinite(plane.tolerance_per_nearness)) plane.tolerance_per_nearness = 0;
    return plane;
}

}  // namespace burin
