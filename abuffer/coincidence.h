#pragma once

#include "abuffer/projection.h"

namespace burin {

/// Planes nearer to each other than this, in pixels, cannot be told apart.
constexpr double kCoincidentPx = 1.0 / 64;

/// How two polygons lie to each other wherever both are in the picture, or anywhere if nowhere in it.
struct SurfaceOrder {
    bool have_common_place = false;
    /// Places where the first is in front of the second, behind it, or neither for certain: coordinates have errors, and
    /// corners are snapped.
    bool has_front = false, has_behind = false, has_level = false;
    bool is_apart = false;  ///< places where the planes are farther apart than kCoincidentPx, or soon will be

    void operator+=(const SurfaceOrder& o);
    /// Files round coordinates, and what was modelled in one plane is read a little off it: a surface that is now in front
    /// and now behind by less than can be seen. The answer is one for all places, so that of two such polygons the same
    /// one is in front everywhere. A surface that is in front for certain, by however little, is in front.
    bool are_coincident() const { return have_common_place && !is_apart && (has_level || has_front == has_behind); }
    /// Whether the first is nowhere behind: where both are level, it is only rounding that could show the second.
    bool is_in_front() const { return has_front && !has_behind && !are_coincident(); }
};

/// Of two triangles, with corners in view space. `coordinate_error`: how exact coordinates are, in world units. Where the two
/// may not be one plane, as the two sides of a thin sheet are none, nothing but that error counts.
SurfaceOrder compare_surfaces(const Projection& projection, const glm::dvec3 (&a)[3], const glm::dvec3 (&b)[3],
                              bool may_be_one_plane, double coordinate_error);
/// The same of their planes at one place, in pixels.
SurfaceOrder compare_planes(const Projection& projection, const glm::dvec3 (&a)[3], const glm::dvec3 (&b)[3], glm::dvec2 place,
                            bool may_be_one_plane, double coordinate_error);

/// Whether the corners of a triangle run counterclockwise as seen.
bool faces_eye(const Projection& projection, const glm::dvec3 (&corners)[3]);

}  // namespace burin
