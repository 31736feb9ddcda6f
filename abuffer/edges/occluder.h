#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "abuffer/screen/screen_surfaces.h"
#include "lines/whole_line.h"

// An occluder is a triangle that may hide a line, set up so that lines can be clipped against it.

namespace burin {

/// A triangle on the screen as something that hides lines.
struct Occluder : TrianglePlane {
    double transmission = 0;  ///< 0 = opaque
    std::uint32_t number, instance;
    std::array<std::uint32_t, 3> vertices;

    bool covers(glm::dvec2 p) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t n = k == 2 ? 0 : k + 1;
            const double side = (x[n] - x[k]) * (p.y - y[k]) - (y[n] - y[k]) * (p.x - x[k]);
            if (side < 0 || (side == 0 && !owns_edge[k])) return false;
        }
        return true;
    }
    double nearness_at(glm::dvec2 p) const { return nearness + per_x * (p.x - x[0]) + per_y * (p.y - y[0]); }
};

/// The part of [begin, end] in which a value that runs from `at_0` at 0 to `at_1` at 1 is positive.
/// False if there is none.
bool clip_where_positive(double at_0, double at_1, double& begin, double& end);

/// Keeps the part of [begin, end] of a line that is within a rectangle, in 1/256 pixel.
bool clip_to_rect(glm::dvec2 line_from, glm::dvec2 line_to, glm::dvec2 low, glm::dvec2 high, double& begin,
                  double& end);
inline bool clip_to_rect(const WholeLine& line, glm::dvec2 low, glm::dvec2 high, double& begin, double& end) {
    return clip_to_rect(line.from, line.to, low, high, begin, end);
}

/// A triangle whose corners are all on the screen.
Occluder occluder_of(const ScreenSurfaces& screen, SurfaceId s, std::uint32_t number);
/// Makes the same occluder in place, but for its transmission.
void set_up_occluder(const ScreenSurfaces& screen, SurfaceId s, std::uint32_t number, Occluder& triangle);
/// What the near plane and the guard band leave of any other one.
std::vector<Occluder> clipped_occluders(const ScreenSurfaces& screen, SurfaceId s, std::uint32_t number);

/// The other half-edge on the edge after a corner of a triangle on the screen, if exactly two triangles meet there.
std::optional<HalfEdge> partner_over(const ScreenSurfaces& screen, const Occluder& triangle, std::size_t corner);

inline bool is_owner(const WholeLine& line, std::uint32_t triangle) {
    return triangle == line.owners[0] || triangle == line.owners[1];
}
/// Whether a line is an edge of a triangle, which cannot hide it then.
bool lies_on(const WholeLine& line, const Occluder& triangle);

/// Whether a triangle that has a vertex in common with a line covers only a rim of it narrower than vertices are
/// snapped, 1/256 pixel, where its surface ends or folds: a fold so narrow may lie on either side of its edge.
bool is_grazed_at_end(const ScreenSurfaces& screen, const WholeLine& line, const Occluder& triangle);
/// is_grazed_at_end() for any triangle, with an end in common or not.
inline bool only_grazes(const ScreenSurfaces& screen, const WholeLine& line, const Occluder& t) {
    bool has_end = false;
    for (const std::uint32_t v : t.vertices) {
        const std::uint64_t node = WholeLine::node_of_vertex(t.instance, v);
        has_end |= (node == line.nodes[0]) | (node == line.nodes[1]);
    }
    return has_end && is_grazed_at_end(screen, line, t);
}

/// Things at one depth are nearer to each other than this part of a pixel's width.
constexpr double kLevelPx = 1.0 / 16;
/// What is in front by more than this is so for certain: coordinates and places are not exact.
constexpr double kCertainPx = kLevelPx / 64;

/// What `level_px` pixels' widths are as a step in nearness, at a nearness less farthest_nearness, with what
/// coordinates are off by.
double level_slack(const SurfaceSet& surfaces, double nearness, double level_px = kLevelPx);
/// What snapping does to the nearness of a line.
double snapping_slack(const WholeLine& line);
/// Both slacks together for the part [begin, end] of a line.
double line_slack(const SurfaceSet& surfaces, const WholeLine& line, double begin, double end,
                  double level_px = kLevelPx);

/// Keeps the part of [begin, end] in which a triangle is in front of a line, by more than `slack`. `with_edges`: lines
/// along any of its edges count as within it; else only those along edges that it owns, so that of two neighbours one
/// has them.
bool clip_where_hidden(const WholeLine& line, double slack, const Occluder& triangle, double& begin, double& end,
                       bool with_edges = false);

}  // namespace burin
