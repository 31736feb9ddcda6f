#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "output/paths/vector_drawing.h"
#include "shading/ink/inked_lines.h"

namespace burin {

/// Paths that are shorter are crumbs: they are joined to others, or left out where other ink covers them.
constexpr double kCrumbPx = 1;

/// What lines must have in common to become one path, beside their style.
struct PathKind {
    InkOrder order;
    std::uint32_t style = 0;        ///< in PathLines::styles
    std::uint8_t invisibility = 0;  ///< 0 unless paths are grouped by it
    auto operator<=>(const PathKind&) const = default;
};

/// A line of straight parts that becomes a path, or a part of one.
struct PathLine {
    std::size_t first_point = 0, point_count = 0;  ///< in PathLines::points; a closed one has its first point twice
    PathKind kind;
    bool is_closed = false;
    std::uint32_t object = 0;
    std::uint8_t invisibility = 0;
    float nearness = 0;                          ///< of its nearest point
    std::uint64_t chain = 0;                     ///< InkStroke::chain
    float dash_phase_px = 0;                     ///< where it begins in its pattern
    std::size_t first_edge = 0, edge_count = 0;  ///< in PathLines::edges
    /// Names of the edges that its first and its last point lie on.
    std::array<std::uint64_t, 2> end_edges = {};
};

/// The strokes of a picture on the way to paths.
struct PathLines {
    std::vector<glm::dvec2> points;
    std::vector<PathLine> lines;
    std::vector<std::uint64_t> edges;
    std::vector<VectorStyle> styles;  ///< without phases

    std::span<const glm::dvec2> points_of(const PathLine& line) const {
        return std::span(points).subspan(line.first_point, line.point_count);
    }
    /// The same without its points.
    PathLines without_points() const {
        PathLines rest;
        rest.edges = edges;
        rest.styles = styles;
        return rest;
    }
};

/// Takes the strokes of a picture apart into lines of constant ink and outlines of all others. Points on the way that
/// lie on the straight line through their neighbours are left out. `crop`: lines end where they leave no more ink in
/// it. `lines`: with origins.
PathLines path_lines_of(const InkedLines& lines, VectorGrouping grouping, PixelRect crop);

}  // namespace burin
