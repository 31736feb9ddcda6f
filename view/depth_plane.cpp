#include "view/depth_plane.h"

#include "view/screen_polygon.h"

namespace burin {
namespace {

DepthPlane with_range(const Projection& projection, const glm::dvec3 (&corners)[3]) {
    DepthPlane plane;
    double nearest = 1e300, farthest = -1e300;  // distances
    for (const glm::dvec3& corner : corners) {
        const double distance = std::max(-corner.z, projection.near_distance);
        nearest = std::min(nearest, distance);
        farthest = std::max(farthest, distance);
    }
    plane.highest = projection.nearness({0, 0, -nearest});
    plane.lowest = projection.nearness({0, 0, -farthest});
    return plane;
}

/// Triangles seen exactly edge-on have no plane on the screen: any place of them will do.
DepthPlane usable(DepthPlane plane) {
    if (!std::isfinite(plane.at_origin) || !std::isfinite(plane.per_x) || !std::isfinite(plane.per_y)) {
        plane.per_x = plane.per_y = 0;
        plane.at_origin = plane.highest;
    }
    return plane;
}

/// Points P of a plane in space fulfil normal.P = offset; the normal has unit length.
struct SpacePlane {
    glm::dvec3 normal;
    double offset;
};

SpacePlane space_plane(const glm::dvec3 (&corners)[3]) {
    const glm::dvec3 area = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const glm::dvec3 normal = area / std::max(glm::length(area), 1e-300);
    return {normal, glm::dot(normal, corners[0])};
}

}  // namespace

DepthPlane exact_depth_plane(const Projection& projection, const glm::dvec3 (&corners)[3]) {
    DepthPlane plane = with_range(projection, corners);
    const auto [n, c] = space_plane(corners);
    const glm::dvec2 f = projection.focal_xy_px();
    const glm::dvec2 center = projection.center_px;
    if (projection.orthographic) {
        // z = (c - n.x x - n.y y) / n.z, x = (px - center.x) / f.x, y = (center.y - py) / f.y
        plane.per_x = -n.x / (n.z * f.x);
        plane.per_y = n.y / (n.z * f.y);
        plane.at_origin = c / n.z - plane.per_x * center.x - plane.per_y * center.y;
    } else {
        // P = t * direction: 1/t = n.direction / c, direction = ((px - center.x) / f.x, (center.y - py) / f.y, -1)
        plane.per_x = n.x / (f.x * c);
        plane.per_y = -n.y / (f.y * c);
        plane.at_origin = -n.z / c - plane.per_x * center.x - plane.per_y * center.y;
    }
    return usable(plane);
}

DepthPlane snapped_depth_plane(const Projection& projection, const glm::dvec3 (&corners)[3]) {
    glm::dvec2 p[3];
    double q[3];
    for (int k = 0; k < 3; ++k) {
        if (!needs_no_clipping(projection, corners[k])) return exact_depth_plane(projection, corners);
        const glm::dvec2 pixel = projection.to_pixel(corners[k]);
        p[k] = to_pixels(glm::dvec2(snap_to_subpixels(pixel.x), snap_to_subpixels(pixel.y)));
        q[k] = projection.nearness(corners[k]);
    }
    DepthPlane plane = with_range(projection, corners);
    const glm::dvec2 u = p[1] - p[0], v = p[2] - p[0];
    const double area = u.x * v.y - u.y * v.x;
    plane.per_x = ((q[1] - q[0]) * v.y - (q[2] - q[0]) * u.y) / area;
    plane.per_y = ((q[2] - q[0]) * u.x - (q[1] - q[0]) * v.x) / area;
    plane.at_origin = q[0] - plane.per_x * p[0].x - plane.per_y * p[0].y;
    return usable(plane);
}

}  // namespace burin
