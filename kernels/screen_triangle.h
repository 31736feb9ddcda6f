#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "kernels/subpixel.h"

// Vertices and triangles of a mesh on the screen are what most kernels read.

namespace burin {

/// A vertex on the screen: snapped position in 1/256 pixel and nearness, less a constant of the
/// frame so that single precision resolves the scene. `x == kOffScreen`: it lies behind the near
/// plane or outside the guard band, and its triangles need clipping.
struct alignas(16) ScreenVertex {
    static constexpr std::int32_t kOffScreen = std::numeric_limits<std::int32_t>::min();
    std::int32_t x, y;  // not 0 by default: millions are made without a value, and projected
    float nearness;
};

/// A triangle whose corners all lie on the screen.
struct ScreenTriangle {
    ScreenVertex corners[3];
};

/// Twice the area in (1/256 pixel)^2; positive if the corners run clockwise as seen on the screen.
inline std::int64_t doubled_area(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) {
    return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

/// Nearness of a triangle's plane, extended to a place in 1/256 pixel. The triangle must have an area.
inline double extended_nearness(const ScreenTriangle& t, double x, double y) {
    const ScreenVertex &a = t.corners[0], &b = t.corners[1], &c = t.corners[2];
    const double qa = static_cast<double>(a.nearness), qb = static_cast<double>(b.nearness) - qa,
                 qc = static_cast<double>(c.nearness) - qa;
    const double px = x - a.x, py = y - a.y;
    return qa + ((px * (c.y - a.y) - py * (c.x - a.x)) * qb + ((b.x - a.x) * py - (b.y - a.y) * px) * qc) /
                    static_cast<double>(doubled_area(a, b, c));
}

/// A bit of ScreenMesh::sharp: the triangle may be a sliver.
constexpr std::uint8_t kMayBeSliver = 8;

/// The triangles of one instance of a mesh on the screen.
struct ScreenMesh {
    const ScreenVertex* vertices = nullptr;
    const std::uint32_t* corners = nullptr;  ///< vertex numbers, three per triangle
    std::uint32_t first_number = 0;          ///< of the mesh's first triangle, among all of the frame
    std::uint32_t triangle_count = 0;
    const std::uint8_t* sharp = nullptr;      ///< per triangle, bit k: edge k is sharp; kMayBeSliver
    const std::uint32_t* partners = nullptr;  ///< half-edges on the other side, three per triangle
    /// Facing, per triangle.
    const std::uint8_t* facing = nullptr;
    /// Per triangle, bit k: edge k may be a line. 0: the triangle is plain (see SampleTile).
    const std::uint8_t* line_edges = nullptr;
    /// Kernels may read this many bytes behind the last facing and the last line edges.
    static constexpr std::size_t kPadding = 3;
};

/// Which way a triangle is wound on the screen.
enum Facing : std::uint8_t { edge_on, clockwise, counterclockwise, off_screen };

}  // namespace burin
