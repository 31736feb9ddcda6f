#include "abuffer/screen/edge_on_screen.h"

#include <algorithm>
#include <tuple>

namespace burin {
namespace {

bool is_on_screen(const ScreenVertex& v) { return v.x != ScreenVertex::kOffScreen; }

/// Where a way is in front of the near plane and within the guard band: from t0 to t1, of which it is 1 long.
struct Part {
    double t0 = 0, t1 = 1;
};

Part part_on_screen(const Projection& projection, const glm::dvec3& p, const glm::dvec3& q) {
    Part part;
    const auto keep = [&](double at_p, double at_q) {  // where the affine function is positive
        if (at_p < 0 && at_q < 0)
            part.t1 = -1;
        else if (at_p < 0)
            part.t0 = std::max(part.t0, at_p / (at_p - at_q));
        else if (at_q < 0)
            part.t1 = std::min(part.t1, at_p / (at_p - at_q));
    };
    keep(-p.z - projection.near_distance, -q.z - projection.near_distance);
    const auto depth = [&](const glm::dvec3& view) { return projection.orthographic ? 1.0 : -view.z; };
    for (int axis = 0; axis < 2; ++axis) {
        const double reach = kGuardBandPx / projection.focal_xy_px()[axis];
        keep(reach * depth(p) - p[axis], reach * depth(q) - q[axis]);
        keep(reach * depth(p) + p[axis], reach * depth(q) + q[axis]);
    }
    return part;
}

}  // namespace

std::optional<EdgeOnScreen> clipped_edge(const ScreenSurfaces& screen, std::uint32_t instance, std::uint32_t from,
                                         std::uint32_t to) {
    const SurfaceSet& surfaces = screen.surfaces();
    const Projection& projection = surfaces.projection;
    const glm::dvec3 p = surfaces.view_position(instance, from), q = surfaces.view_position(instance, to);
    const Part part = part_on_screen(projection, p, q);
    if (!(part.t0 < part.t1)) return std::nullopt;
    const auto end = [&](std::uint32_t vertex, double t, glm::dvec2& place, double& nearness) {
        const ScreenVertex& v = screen.vertices(instance)[vertex];
        const glm::dvec3 cut = glm::mix(p, q, t);
        place = is_on_screen(v) ? glm::dvec2(v.x, v.y) : to_subpixels(projection.to_pixel(cut));
        nearness =
            is_on_screen(v) ? static_cast<double>(v.nearness) : projection.nearness(cut) - surfaces.farthest_nearness;
    };
    EdgeOnScreen edge;
    edge.begin = part.t0;
    edge.end = part.t1;
    end(from, part.t0, edge.from, edge.nearness_from);
    end(to, part.t1, edge.to, edge.nearness_to);
    return edge;
}

bool comes_first_in_space(const ScreenSurfaces& screen, std::uint32_t instance, std::uint32_t one, std::uint32_t two) {
    const Mesh& mesh = *screen.surfaces().instances[instance].mesh;
    const glm::dvec3 p = mesh.local_position(one), q = mesh.local_position(two);
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

double share_in_space(const ScreenSurfaces& screen, const EdgeOnScreen& edge, double on_screen) {
    const SurfaceSet& surfaces = screen.surfaces();
    if (surfaces.projection.orthographic) return glm::mix(edge.begin, edge.end, on_screen);
    const double from = surfaces.farthest_nearness + edge.nearness_from,
                 to = surfaces.farthest_nearness + edge.nearness_to;
    return glm::mix(edge.begin, edge.end, on_screen * to / glm::mix(from, to, on_screen));
}

double share_on_screen(const ScreenSurfaces& screen, const EdgeOnScreen& edge, double in_space) {
    const SurfaceSet& surfaces = screen.surfaces();
    const double part = (in_space - edge.begin) / (edge.end - edge.begin);
    if (surfaces.projection.orthographic) return part;
    const double from = surfaces.farthest_nearness + edge.nearness_from,
                 to = surfaces.farthest_nearness + edge.nearness_to;
    return part * from / glm::mix(to, from, part);
}

int side_of_edge(const ScreenSurfaces& screen, std::uint32_t instance, std::uint32_t from, std::uint32_t to,
                 std::uint32_t vertex) {
    const ScreenVertex* const v = screen.vertices(instance);
    const auto sign = [](auto value) { return value > 0 ? 1 : value < 0 ? -1 : 0; };
    if (is_on_screen(v[from]) && is_on_screen(v[to]) && is_on_screen(v[vertex])) {
        return sign(doubled_area(v[from], v[to], v[vertex]));
    }
    const SurfaceSet& surfaces = screen.surfaces();
    const glm::dvec3 p = surfaces.view_position(instance, from), q = surfaces.view_position(instance, to),
                     r = surfaces.view_position(instance, vertex);
    // In space the eye's plane through the edge decides; the screen's y axis points the other way.
    return sign(surfaces.projection.orthographic ? -((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x))
                                                 : glm::dot(glm::cross(p, q), r));
}

}  // namespace burin
