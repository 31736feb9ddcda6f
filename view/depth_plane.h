#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "kernels/subpixel.h"
#include "view/projection.h"

// The depth of a triangle is a plane on the screen, by which samples and lines are compared.

namespace burin {

/// The nearness (see Projection) of a triangle as an affine function of the screen position, with
/// its first derivatives.
struct DepthPlane {
    double at_origin = 0;  ///< nearness at pixel position (0, 0)
    double per_x = 0;      ///< change per pixel to the right
    double per_y = 0;      ///< change per pixel down
    double lowest = 0;     ///< range of nearness over the triangle: slivers seen edge-on have
    double highest = 0;    ///< planes that run wild as soon as one leaves the triangle

    /// Nearness of the plane anywhere on the screen.
    double extended_to(glm::dvec2 pixel) const { return at_origin + per_x * pixel.x + per_y * pixel.y; }
    /// Nearness at a position on the triangle.
    double nearness(glm::dvec2 pixel) const { return std::clamp(extended_to(pixel), lowest, highest); }
    /// How much nearness changes over 1/256 pixel: what snapping may do.
    double snapping_error() const { return (std::abs(per_x) + std::abs(per_y)) / kSubpixelsPerPixel; }
};

/// The plane of a triangle given in view space, through its corners where they are drawn, that is,
/// after snapping. So the planes of two triangles agree along a common edge, and where a surface
/// folds over, its front stays in front up to the last sample.
DepthPlane snapped_depth_plane(const Projection& projection, const glm::dvec3 (&corners)[3]);

/// The plane through the corners as they are.
DepthPlane exact_depth_plane(const Projection& projection, const glm::dvec3 (&corners)[3]);

}  // namespace burin
