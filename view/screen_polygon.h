#pragma once

#include <array>
#include <glm/glm.hpp>

#include "kernels/subpixel.h"
#include "view/projection.h"

// A triangle in view space becomes a polygon on the screen: clipped, projected and snapped.

namespace burin {

/// Positions farther than this from the centre of the view are clipped away, so that snapped
/// coordinates and their products fit their integers.
constexpr double kGuardBandPx = 65536;

/// A triangle as it falls on the screen: a convex polygon, because the near plane and the guard
/// band may cut corners off. Its corners are snapped.
struct ScreenPolygon {
    static constexpr int kMaxCorners = 8;  ///< 3, and one more for each of five clip planes
    int count = 0;                         ///< 0 if nothing is left, else 3 or more
    std::array<SubpixelPoint, kMaxCorners> corners;
};

/// Whether a corner lies in front of the near plane and within the guard band.
bool needs_no_clipping(const Projection& projection, const glm::dvec3& corner);

/// Clips and projects a triangle given in view space.
///
/// Two triangles with a common edge get the same snapped corners along it, also where it is clipped.
ScreenPolygon project_triangle(const Projection& projection, const glm::dvec3 (&corners)[3]);

}  // namespace burin
