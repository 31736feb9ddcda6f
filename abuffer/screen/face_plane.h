#pragma once

#include "view/surface_set.h"

// What lies in front beside a line is asked in view space, where snapping does not matter.

namespace burin {

/// The plane of a triangle in view space, as exact as its coordinates: beside a line snapping may decide on the screen
/// what lies in front.
struct FacePlane {
    FacePlane(const SurfaceSet& surfaces, SurfaceId s);

    glm::dvec3 corner, to_eye;  // a unit normal
    bool is_counterclockwise;   // as seen

    double height(const glm::dvec3& p) const { return glm::dot(to_eye, p - corner); }
};

/// Whether a part of a triangle is nearer to the eye than a plane, by more than what coordinates are off by and
/// `slack_px` pixels' widths.
bool rises_in_front(const SurfaceSet& surfaces, SurfaceId s, const FacePlane& plane, double slack_px = 0);

}  // namespace burin
