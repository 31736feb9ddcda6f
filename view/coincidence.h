#pragma once

#include "view/projection.h"

// Two triangles are compared in depth wherever both are: the answer says which is in front, or that they lie in one
// plane, and is one for all places.

namespace burin {

/// Planes nearer to each other than this, in pixels, cannot be told apart.
constexpr double kCoincidentPx = 1.0 / 64;
/// What two copies of one surface may be apart, in pixels, whose coordinates were rounded in different ways: by up to
/// 1/16 pixel each, so places by 1/16 of the diagonal of a cube. No one can see which of them is in front.
constexpr double kCopiesApartPx = 7.0 / 64;

/// How two polygons lie to each other wherever both are in the picture, or anywhere if nowhere in it.
struct SurfaceOrder {
    bool have_common_place = false;
    /// Places where the first is in front of the second, behind it, or neither for certain: coordinates have errors,
    /// and corners are snapped.
    bool has_front = false, has_behind = false, has_level = false;
    bool is_apart = false;  ///< places where the planes are farther apart than kCoincidentPx, or soon will be
    /// Whether there are such places for the corners where they are, not snapped: only coordinates have errors then.
    bool has_nearer = false, has_farther = false, has_equal = false;
    bool is_far = false;  ///< places where the planes are farther apart than kCopiesApartPx
    /// How far the first is in front of the second, in pixels, at least and at most.
    double least_gap_px = 0, greatest_gap_px = 0;
    /// The two are parts of surfaces that pass through each other, and that are nowhere around farther apart than
    /// kCopiesApartPx.
    bool is_of_copies = false;

    void operator+=(const SurfaceOrder& o);
    /// Files round coordinates, and what was modelled in one plane is read a little off it: a surface that is now in
    /// front and now behind by less than can be seen. The answer is one for all places, so that of two such polygons
    /// the same one is in front everywhere. A surface that is in front for certain, by however little, is in front.
    bool are_coincident() const {
        if (is_of_copies) return true;
        return have_common_place && !is_apart && (has_level || has_front == has_behind) && !is_wholly_in_front() &&
               !is_wholly_behind();
    }
    /// Whether the first is nowhere behind: where both are level, it is only rounding that could show the second.
    bool is_in_front() const { return (is_wholly_in_front() || (has_front && !has_behind)) && !are_coincident(); }
    bool is_behind() const { return (is_wholly_behind() || (has_behind && !has_front)) && !are_coincident(); }

  private:
    /// Whether the first is in front, or behind, wherever both are, by however little; snapping may hide it.
    bool is_wholly_in_front() const { return has_nearer && !has_farther && !has_equal; }
    bool is_wholly_behind() const { return has_farther && !has_nearer && !has_equal; }
};

/// How exact coordinates are, in world units.
struct CoordinateErrors {
    double any;  ///< of all that is in the scene
    double of_a,
        of_b;  ///< how far the planes of two triangles are off by the rounding of their own corners, if that is less

    CoordinateErrors(double everywhere) : CoordinateErrors(everywhere, everywhere, everywhere) {}
    CoordinateErrors(double everywhere, double a, double b) : any(everywhere), of_a(a), of_b(b) {}
};

/// How two triangles lie to each other if they may be parts of one plane, and if they may not, as the two sides of a
/// thin sheet: then nothing but errors of coordinates counts.
struct SurfaceOrders {
    SurfaceOrder of_one_plane, of_two_planes;
};

/// Compares two triangles, with corners in view space, wherever both are.
SurfaceOrders compare_surfaces(const Projection& projection, const glm::dvec3 (&a)[3], const glm::dvec3 (&b)[3],
                               const CoordinateErrors& errors);
/// Compares their planes at one place, in pixels.
SurfaceOrders compare_planes(const Projection& projection, const glm::dvec3 (&a)[3], const glm::dvec3 (&b)[3],
                             glm::dvec2 place, const CoordinateErrors& errors);

/// Whether the corners of a triangle run counterclockwise as seen.
bool faces_eye(const Projection& projection, const glm::dvec3 (&corners)[3]);

}  // namespace burin
