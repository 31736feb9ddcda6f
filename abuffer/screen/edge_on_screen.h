#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <utility>

#include "abuffer/screen/screen_surfaces.h"

// Edges that pass behind the eye are cut, and all edges get a direction that no order in the file changes.

namespace burin {

/// What the near plane and the guard band leave of an edge: places in 1/256 pixel, snapped where they are vertices, and
/// nearness less SurfaceSet::farthest_nearness.
struct EdgeOnScreen {
    glm::dvec2 at(double t) const { return from + (to - from) * t; }
    /// Positive on one side of the edge, negative on the other. `p` in 1/256 pixel.
    double side_of(glm::dvec2 p) const { return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x); }
    double nearness_at(double t) const { return nearness_from + (nearness_to - nearness_from) * t; }

    glm::dvec2 from{0.0}, to{0.0};
    double nearness_from = 0, nearness_to = 0;
    double begin = 0, end = 1;  ///< the part that is left, as shares of the way in space
};

/// edge_on_screen() where an end is cut off.
std::optional<EdgeOnScreen> clipped_edge(const ScreenSurfaces& screen, std::uint32_t instance, std::uint32_t from,
                                         std::uint32_t to);

/// Between two vertices of an instance that is shown. nullopt: nothing of the edge is on the screen.
inline std::optional<EdgeOnScreen> edge_on_screen(const ScreenSurfaces& screen, std::uint32_t instance,
                                                  std::uint32_t from, std::uint32_t to) {
    const ScreenVertex &a = screen.vertices(instance)[from], &b = screen.vertices(instance)[to];
    if (a.x == ScreenVertex::kOffScreen || b.x == ScreenVertex::kOffScreen)
        return clipped_edge(screen, instance, from, to);
    return EdgeOnScreen{{a.x, a.y}, {b.x, b.y}, static_cast<double>(a.nearness), static_cast<double>(b.nearness), 0, 1};
}

/// Whether a vertex comes first by its coordinates in the mesh.
bool comes_first_in_space(const ScreenSurfaces& screen, std::uint32_t instance, std::uint32_t one, std::uint32_t two);

/// The vertices of an edge as it is gone along: to the right on the screen, or downwards, and from one that is off the
/// screen. Rounding depends on the direction, which no order in the file may change.
inline std::pair<std::uint32_t, std::uint32_t> ends_in_order(const ScreenSurfaces& screen, std::uint32_t instance,
                                                             std::uint32_t one, std::uint32_t two) {
    const ScreenVertex &a = screen.vertices(instance)[one], &b = screen.vertices(instance)[two];
    const bool is_known = a.x != b.x || (a.y != b.y && a.x != ScreenVertex::kOffScreen);
    const bool turns =
        is_known ? (a.x != b.x ? a.x > b.x : a.y > b.y) : comes_first_in_space(screen, instance, two, one);
    return turns ? std::pair(two, one) : std::pair(one, two);
}

/// The share of the way in space at which a share of what is left is seen, and the other way round.
double share_in_space(const ScreenSurfaces& screen, const EdgeOnScreen& edge, double on_screen);
double share_on_screen(const ScreenSurfaces& screen, const EdgeOnScreen& edge, double in_space);

/// On which side of the edge between two vertices a third one is seen, or would be if it lay on the screen:
/// the sign of EdgeOnScreen::side_of(), -1, 0 or 1.
int side_of_edge(const ScreenSurfaces& screen, std::uint32_t instance, std::uint32_t from, std::uint32_t to,
                 std::uint32_t vertex);

}  // namespace burin
