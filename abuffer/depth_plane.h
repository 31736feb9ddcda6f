#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "abuffer/projection.h"

namespace burin {

/// The nearness (see Projection) of a triangle's plane as an affine function of the screen
/// position, with its first derivatives.
struct DepthPlane {
    double at_origin = 0;  ///< nearness at pixel position (0, 0)
    double per_x = 0;      ///< change per pixel to the right
    double per_y = 0;      ///< change per pixel down
    double lowest = 0;     ///< range of nearness over the triangle: slivers seen edge-on have
    double highest = 0;    ///< planes that run wild as soon as one leaves the triangle
    /// Nearness within which two planes count as coincident: what rounding the coordinates can do.
    double tolerance_constant = 0;
    double tolerance_per_nearness = 0;

    /// Nearness of the plane anywhere on the screen.
    double extended_to(glm::dvec2 pixel) const {
        return at_origin + per_x * pixel.x + per_y * pixel.y;
    }
    /// Nearness at a position on the triangle.
    double nearness(glm::dvec2 pixel) const {
        return std::clamp(extended_to(pixel), lowest, highest);
    }
    double tolerance(double nearness_value) const {
        return tolerance_constant + tolerance_per_nearness * std::abs(nearness_value);
    }
};

/// The plane of the triangle with these corners in view space. `coordinate_error` says how exact
/// the corners are, in world units.
DepthPlane depth_plane(const Projection& projection, const glm::dvec3 (&corners)[3],
                       double coordinate_error);

}  // namespace burin
