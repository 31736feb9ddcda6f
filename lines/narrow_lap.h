#pragma once

#include "lines/surface_walk.h"

// Faces that lap over each other by a narrow strip are in contact, and not one face.

namespace burin {

/// A triangle, and where on the screen it is, in pixels.
struct FacePlace {
    SurfaceId surface;
    glm::dvec2 pixel;
};

/// laps_narrowly() says whether the face of a triangle, which ends at an edge of it in the plane of another face, laps
/// over that one by no more than a narrow strip: the other face ends there as well, at an edge that runs nearly along
/// this one, and the own face goes on beyond that. So a pin lies in a hole of its size. `other`: a place of the other
/// face near there; `at`: on the edge, in pixels.
bool laps_narrowly(const SurfaceSet& surfaces, SurfaceId own, HalfEdge edge, const FacePlace& other, glm::dvec2 at);

}  // namespace burin
