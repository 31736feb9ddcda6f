#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "mesh/vectors.h"

// How dark a pixel is depends on its distance from the edges of its triangle, which papers find in different ways.

namespace burin {

/// Distances from a pixel to the edges of a triangle, in the ways that the papers on wireframes
/// have found. Positions are in pixels; w is the distance from the eye (1 in an orthographic view),
/// and a screen position in homogeneous coordinates is (x w, y w, w). Edge k is opposite of corner
/// k.

constexpr double kNoEdge = std::numeric_limits<double>::infinity();

/// The line through two homogeneous points, scaled so that its product with (x, y, 1) is the signed
/// distance in pixels. Any sign of w, also 0. Points that coincide give no line: all zero.
inline glm::dvec3 line_through(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 line = glm::cross(a, b);
    const double length = std::hypot(line.x, line.y);
    return length > 0 ? line / length : glm::dvec3(0.0);
}

inline bool is_line(const glm::dvec3& line) { return line.x != 0 || line.y != 0; }

inline double signed_distance(const glm::dvec3& line, glm::dvec2 at) { return line.x * at.x + line.y * at.y + line.z; }

/// Where on a segment a position is: the distance from it, with round ends, and the foot's way
/// along the segment from its start, kept within it.
struct SegmentDistance {
    double distance = 0;
    double along = 0;
};
inline SegmentDistance segment_distance(glm::dvec2 p0, glm::dvec2 p1, glm::dvec2 at) {
    const glm::dvec2 whole = p1 - p0;
    const double length = glm::length(whole);
    const double s = glm::dot(at - p0, whole);
    if (s <= 0) return {glm::distance(at, p0), 0};
    if (s >= length * length) return {glm::distance(at, p1), length};
    return {std::abs(cross(whole, at - p0)) / length, s / length};
}

/// Parts (lambda) of the corners of a triangle that add up to a position, on the screen.
inline glm::dvec3 barycentric(const glm::dvec2 (&p)[3], glm::dvec2 at) {
    const double area = cross(p[1] - p[0], p[2] - p[0]);
    return {cross(p[1] - at, p[2] - at) / area, cross(p[2] - at, p[0] - at) / area, cross(p[0] - at, p[1] - at) / area};
}

/// The heights of a triangle: the distance of corner k from edge k. Baerentzen et al. 2006.
inline glm::dvec3 altitudes(const glm::dvec2 (&p)[3]) {
    const double area = std::abs(cross(p[1] - p[0], p[2] - p[0]));
    return {area / glm::distance(p[1], p[2]), area / glm::distance(p[2], p[0]), area / glm::distance(p[0], p[1])};
}

/// What the corners of a triangle say about one edge: a distance at each, to be interpolated.
using EdgeChannel = glm::dvec3;

/// Distances interpolated linearly on the screen: exact, as distances are affine there.
inline double linear_distance(const EdgeChannel& channel, const glm::dvec3& lambda) {
    return glm::dot(channel, lambda);
}

/// The distance through an interpolator that is correct in perspective: each distance multiplied by its corner's w
/// beforehand, and the result by the 1/w that is linear on the screen.
inline double premultiplied_distance(const EdgeChannel& channel, const glm::dvec3& w, const glm::dvec3& lambda) {
    const glm::dvec3 weight = lambda / w;
    const double one_over_w = weight.x + weight.y + weight.z;
    const double interpolated = glm::dot(weight, channel * w) / one_over_w;
    return interpolated * one_over_w;
}

/// Channel k of a triangle whose edge k is left out by moving it `q` pixels away at the edge's own
/// corners, while corner k keeps its height (Clipping Space, 2011).
inline EdgeChannel channel_moved_away(int k, double height, double q) {
    EdgeChannel channel(q);
    channel[k] = height;
    return channel;
}

/// One row of the table of S. Gateau, Solid Wireframe, NVIDIA 2007: which lines to measure
/// distances to when corners are behind the eye. A line through `a` in the direction of `a_to`, one
/// through `b` in the direction of `b_to`, and the one from a to b if `has_third`.
struct SolidWireframeCase {
    int a, a_to, b, b_to;
    bool has_third;
};

/// The cases, by 4 [corner 0 behind] + 2 [corner 1 behind] + [corner 2 behind]; 1 to 6.
constexpr std::array<SolidWireframeCase, 7> kSolidWireframeCases = {{
    {},
    {0, 2, 1, 2, true},
    {0, 1, 2, 1, true},
    {0, 1, 0, 2, false},
    {1, 0, 2, 0, true},
    {1, 0, 1, 2, false},
    {2, 0, 2, 1, false},
}};

/// The edge between two corners.
constexpr int edge_between_corners(int a, int b) { return 3 - a - b; }

/// Distances to edges 0, 1, 2 by that table; kNoEdge where it has none. Corners behind the eye are
/// mirrored points, but these lie on the edges' lines too. Case 0 uses heights, case 7 is
/// invisible.
inline glm::dvec3 solid_wireframe_distances(const glm::dvec2 (&p)[3], const bool (&behind)[3], glm::dvec2 at) {
    glm::dvec3 result(kNoEdge);
    const int number = 4 * behind[0] + 2 * behind[1] + behind[2];
    if (number == 7) return result;
    if (number == 0) {
        const glm::dvec3 height = altitudes(p), lambda = barycentric(p, at);
        return {height.x * lambda.x, height.y * lambda.y, height.z * lambda.z};
    }
    const SolidWireframeCase& c = kSolidWireframeCases[static_cast<std::size_t>(number)];
    const auto distance = [&](int from, int to) {
        const glm::dvec2 direction = glm::normalize(p[from] - p[to]), way = at - p[from];
        const double along = glm::dot(way, direction);
        return std::sqrt(std::max(glm::dot(way, way) - along * along, 0.0));
    };
    result[edge_between_corners(c.a, c.a_to)] = distance(c.a, c.a_to);
    result[edge_between_corners(c.b, c.b_to)] = distance(c.b, c.b_to);
    if (c.has_third) result[edge_between_corners(c.a, c.b)] = distance(c.a, c.b);
    return result;
}

}  // namespace burin
