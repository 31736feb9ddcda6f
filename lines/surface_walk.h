#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "kernels/subpixel.h"
#include "lines/line_class.h"
#include "view/surface_set.h"

// A walk follows the surface from one visible point towards another, and says how it ended and which edges it crossed.

namespace burin {

/// What makes an edge between two polygons a line.
struct LineCriteria {
    LineClassSet classes = kDefaultLineClasses;  ///< the classes asked for
    double cos_crease_angle = 0.7660444431;      ///< of 40 degrees
};

/// An edge as one of its triangles sees it.
struct SurfaceEdge {
    SurfaceId surface;
    HalfEdge half_edge = kNoHalfEdge;  ///< of surface's mesh; kNoHalfEdge: none
};

/// A walk goes over at most this many triangles. Only meshes with thousands of them along a pixel have more between two
/// samples.
constexpr int kMostTrianglesOfWalk = 1024;
/// A walk goes over at most this many triangles of walls that are seen edge-on, which may have many rows and bring it
/// nowhere.
constexpr int kMostTrianglesOfWall = 1 << 12;

/// How a walk over a surface ended.
enum class WalkEnd : std::uint8_t {
    arrived,  ///< the surface goes on to the goal
    fold,     ///< the surface turns away from the eye, at an edge whose polygons face apart
    border,   ///< the surface ends, at an edge of one polygon
    crack,    ///< the goal lies in a gap between two patches that belong together
    lost,     ///< too many triangles on the way, or a start beside its triangle
};

struct SurfaceWalk {
    WalkEnd end = WalkEnd::lost;
    SurfaceId surface;                 ///< the triangle where the walk ended
    HalfEdge half_edge = kNoHalfEdge;  ///< its edge that stopped the walk (unless arrived, lost)
    SurfaceId beyond;                  ///< crack: the patch on the other side
    double fraction = 1;               ///< how far it came, 0 = start, 1 = goal
    LineClassSet crossed;              ///< classes of the edges on the way
    SurfaceEdge crossed_edge;          ///< the first of them with a class asked for
    double crossed_fraction = 0;       ///< where that is
    double crease_cosine = 1;          ///< of the sharpest crease on the way: between its normals
};

/// Follows the surface of triangle `start` along the straight line on the screen from `from` (a
/// position on that triangle) to `to`, from neighbour to neighbour, as the eye sees it: in space,
/// along the curve in which the plane through the eye and the line cuts the mesh.
///
/// Where two patches of one mesh are not stitched, but their borders run along each other less than
/// a pixel apart, the walk goes on from one to the other.
///
/// Folds that turn back by less than 1/64 pixel, and not by more than the depth tolerance, are
/// walked over: they are slivers between the triangles of one surface, not contours.
/// A wall that is seen edge-on, to the snapping of corners, is a fold if the surface goes on behind it deeper
/// by more than the depth tolerance. But for seams, depths are compared where the walk crosses edges of the mesh: no
/// plane is extended, and slivers do no harm.
SurfaceWalk walk_surface(const SurfaceSet& surfaces, SurfaceId start, glm::dvec2 from, glm::dvec2 to,
                         const LineCriteria& criteria, int most_triangles = kMostTrianglesOfWalk);

/// walk_surface() where only its end is wanted, which is found sooner: what it crosses is not looked at. `sharp`:
/// find_sharp_edges() of the mesh, which tells of most triangles that they are no slivers; or nullptr.
SurfaceWalk walk_to_end(const SurfaceSet& surfaces, SurfaceId start, glm::dvec2 from, glm::dvec2 to,
                        const LineCriteria& criteria, int most_triangles, const std::uint8_t* sharp);

/// The classes of the edge between two polygons as such: mark, material, crease, polygon. For a
/// border edge that can only be mark. Where it is a crease, `crease_cosine` is lowered to the cosine
/// between its normals.
LineClassSet edge_classes(const SurfaceSet& surfaces, SurfaceEdge edge, const LineCriteria& criteria,
                          double* crease_cosine = nullptr);

/// The classes of a place where two visible surfaces touch: object, or, within one object, material,
/// crease, polygon. `at` is the position on the screen.
LineClassSet contact_classes(const SurfaceSet& surfaces, SurfaceId a, SurfaceId b, glm::dvec2 at,
                             const LineCriteria& criteria, double* crease_cosine = nullptr);

/// Adds the classes that follow from the angle between two polygons of one object, crease; `cosine` is between their
/// normals. Where it is a crease, `crease_cosine` is lowered to it.
void add_angle_classes(double cosine, const LineCriteria& criteria, LineClassSet& classes, double* crease_cosine);

/// Whether two triangles lie in one plane without a line between them at a place on the screen
/// (docs/decisions/0013-flush-faces.md).
bool are_flush(const SurfaceSet& surfaces, SurfaceId a, SurfaceId b, glm::dvec2 at, const LineCriteria& criteria);

/// A triangle lower than this part of its length may be a sliver.
constexpr double kSliverHeightPart = 1.0 / 1024;

/// Whether a triangle is so thin (in its own proportions, and less than 1/64 pixel high where it is nearest to the eye)
/// that rounding decides its normal.
bool is_sliver(const SurfaceSet& surfaces, SurfaceId triangle);

/// A walk over more slivers in a row than this is on a finely rounded edge: the next one counts as a part of the
/// surface.
constexpr int kMostSlivers = 4;

/// How far two surfaces must be apart in distance from the eye to be two, in widths of a pixel at that distance: the
/// *farther* surface of docs/conventions.md. Nearer ones may be in contact. All stages of a frame use this one number:
/// where one took two surfaces for one and the next one took them for two, lines would end for no reason.
constexpr double kDepthTolerancePx = 2;
/// `pixels` pixels' widths at a distance, and what the rounding of screen positions does to a steep plane.
double depth_tolerance(const SurfaceSet& surfaces, double distance, const DepthPlane& plane,
                       double pixels = kDepthTolerancePx);
/// A walk that gets farther by no more than this part of its way has met a wall that is seen edge-on.
constexpr double kNoAdvance = 1e-9;

/// A fold that turns back by less than this is no contour.
constexpr double kNegligibleFoldPx = 1.0 / 64;
constexpr double kNegligibleFoldSubpixels = to_subpixels(kNegligibleFoldPx);
/// Snapping of corners to 1/256 pixel may decide which of two edges a walk comes to first if they are nearer than this.
constexpr double kSnappingPx = 4.0 / kSubpixelsPerPixel;
/// Whether a part of a wall between two distances may make it so deep that the surface ends there.
inline bool is_deep(const Projection& projection, double distance, double other) {
    return std::abs(distance - other) > kDepthTolerancePx * projection.pixel_size(std::min(distance, other));
}
/// Where the way from a place, `along` as long as it is, crosses an edge: a part of the way. Nothing if it does not.
/// `p`, `q`: the edge's ends, seen from that place.
inline std::optional<double> part_of_way(glm::dvec2 along, glm::dvec2 p, glm::dvec2 q) {
    const double at_p = along.x * p.y - along.y * p.x, at_q = along.x * q.y - along.y * q.x;
    if ((at_p >= 0) == (at_q >= 0)) return std::nullopt;
    return glm::dot(glm::mix(p, q, at_p / (at_p - at_q)), along) / glm::dot(along, along);
}
/// Whether a way comes to one edge of a mesh behind another one, by part_of_way() with corners taken where they are: as
/// the view changes, a wall passes the edge-on position once, where snapping would let it blink.
inline bool is_beyond(double part, double other, glm::dvec2 along) {
    constexpr double kCertainPx = 0x1p-14;  // coordinates are not exact
    return (part - other) * glm::length(along) > kCertainPx;
}

/// Two surfaces that are further apart than this many pixels' widths, in depth_tolerance(), are so for
/// certain, not by rounding.
constexpr double kCertainlyApartPx = 1.0 / 16;

/// Distance from the eye of a nearness that may lie behind the horizon.
double distance_of(const Projection& projection, double nearness);

}  // namespace burin
