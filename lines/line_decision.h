#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>

#include "lines/surface_walk.h"

// Two visible points are decided: is there a line between them, of which classes, and why?

namespace burin {

/// The classes that a contact gives a line, too, where the two surfaces pass through each other.
constexpr LineClassSet kClassesBesideIntersection = LineClass::object | LineClass::material;

/// What is visible at a position on the screen.
struct VisiblePoint {
    glm::dvec2 pixel{0.0};
    SurfaceId surface;  ///< kBackground where nothing is
};

/// Why there is a line between two visible points, or why there is none.
enum class LineReason : std::uint8_t {
    same_surface,      ///< none: one triangle, or two of one flat polygon, or background
    smooth,            ///< none: the surface goes on from one to the other without a feature
    feature_edge,      ///< the surface goes on, over an edge with a class
    turns_away,        ///< the front surface ends at an edge whose polygons face apart
    ends_at_border,    ///< the front surface ends at an edge of one polygon, the other is farther
    crack,             ///< none by itself: a gap between two patches lets the other one shine through
    touches,           ///< the front surface ends where the other touches it
    touches_smoothly,  ///< none: it ends where another touches it, and nothing sets them apart
    passes_through,    ///< the surfaces pass through each other
    unexplained,       ///< the visible surfaces are apart, though the mesh does not say where
};
std::string_view describe(LineReason reason);

struct LineDecision {
    LineClassSet classes;  ///< all that apply; empty: no line
    LineReason reason = LineReason::same_surface;
    /// Which of the two points' surfaces owns the line: the nearer one. 0 = first, 1 = second.
    int front = 0;
    /// Where the line crosses the way from the first point to the second, 0..1.
    double fraction = 0.5;
    /// The edge that the line is; none for intersections.
    SurfaceEdge edge;
    /// How much farther the other surface is at that place, in pixel widths there. Infinite for the
    /// background, 0 where not computed.
    double gap_px = 0;
    /// Where classes has crease: the least cosine between the normals that meet here.
    double crease_cosine = 1;
};

/// Decides whether a line passes between two neighbouring visible points, and which classes it has.
///
/// This is the meaning of the line classes (docs/conventions.md), for all methods that have
/// triangles at hand; it is Patel's edge criteria (2000) with the mesh's own neighbours. The two
/// points should be about a sample apart. Swapping them gives the same classes.
LineDecision decide_line(const SurfaceSet& surfaces, const VisiblePoint& a, const VisiblePoint& b,
                         const LineCriteria& criteria);

}  // namespace burin
