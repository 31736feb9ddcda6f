#pragma once

#include <cstdint>
#include <optional>

// The wireframe methods read these settings of a scene.

namespace burin {

/// How dark a line is at a distance from it (methods/wire_profile.h has the formulas).
enum class WireProfileKind : std::uint8_t { gauss, nv, step, linear, smooth, box };

/// How wide lines are.
enum class WireWidth : std::uint8_t {
    matched,    ///< the integrated width of a line inside of a surface is lines.width
    published,  ///< the method's own profile and size
};

/// How the distance to an edge reaches a pixel.
enum class WirePath : std::uint8_t {
    linear,         ///< distances at the corners, interpolated linearly on the screen
    premultiplied,  ///< distances times w, interpolated in perspective, times 1 / w
    homogeneous,    ///< the edge's line in homogeneous coordinates: no division, any sign of w
    cases,          ///< linear, and a table of cases for triangles with corners behind the eye
};

/// How edges that are not to be drawn are left out.
enum class WireExclude : std::uint8_t {
    flags,    ///< a triangle has distances to its own drawn edges only
    q,        ///< the same, but left-out edges are moved away by a constant at two of the corners
    polygon,  ///< a triangle has distances to all drawn edges of its polygon
};

/// How lines get thinner with depth.
enum class WireThinning : std::uint8_t { none, linear, hermite };

enum class WirePattern : std::uint8_t { solid, dash, dots };

/// What the methods single-pass, solid-wireframe and id-buffer look at.
struct WireSettings {
    WireWidth width = WireWidth::matched;
    std::optional<WireProfileKind> profile;  ///< none: the method's own
    std::optional<double> thickness_px;      ///< published width: t of the profile, W of nv
    std::optional<WirePath> path;            ///< none: the method's own
    std::optional<WireExclude> exclude;      ///< none: the method's own
    double q_px = 100;
    double fade_distance = 0;  ///< lines are fade_distance / distance as dark; world units, 0 = off
    WireThinning thinning = WireThinning::none;
    double alpha_test = 0;          ///< pixels of surfaces with less line than this are removed; 0 = off
    bool dotted_diagonals = false;  ///< solid-wireframe: diagonals within polygons as dots
    double transition_px = 1.8;     ///< id-buffer: where the flank of the profile is cut off
    bool slope = false;             ///< id-buffer: allow for the slope of the surface beside the line

    WirePattern pattern = WirePattern::solid;
    double period_px = 12;    ///< of dashes
    double dot_period = 1.5;  ///< from dot to dot, in diameters of dots
    double duty = 0.5;        ///< drawn part of a dash
    double phase = 0;         ///< in periods
    double repeats = 0;       ///< dashes per edge, in space; 0: dashes by period_px on the screen
    double squeeze_min = 1;   ///< part of the width in the middle of an edge
    double squeeze_max = 1;   ///< part of the width at its ends
    double dual = 0;          ///< part of the width that is left empty inside of a line; 0 = off
};

}  // namespace burin
