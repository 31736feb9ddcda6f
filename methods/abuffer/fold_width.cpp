#include "methods/abuffer/fold_width.h"

#include <cmath>

namespace burin {

bool is_surface_wide(const ScreenMesh& mesh, HalfEdge half_edge, glm::dvec2 at, double nearness,
                     glm::dvec2 way, double least, double level) {
    const auto vertex = [&](HalfEdge h, std::uint32_t k) -> const ScreenVertex& {
        return mesh.vertices[mesh.corners[h - h % 3 + (h + k) % 3]];
    };
    const auto corner = [&](HalfEdge h, std::uint32_t k) { return glm::dvec2(vertex(h, k).x, vertex(h, k).y); };
    const auto cross = [](glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; };
    const glm::dvec2 along = corner(half_edge, 1) - corner(half_edge, 0);
    if ((cross(along, way) < 0) != (cross(along, corner(half_edge, 2) - corner(half_edge, 0)) < 0))
        way = -way;
    constexpr int kMaxTriangles = 64;
    HalfEdge entry = half_edge;
    double entered = 0, nearness_there = nearness;
    for (int step = 0; step < kMaxTriangles; ++step) {
        if (mesh.facing[entry / 3] == off_screen) return true;  // cut: it has no corners to go by
        // Out by one of the two other edges: the one whose ends lie on either side of the way.
        const bool is_first =
            (cross(way, corner(entry, 2) - at) < 0) == (cross(way, corner(entry, 0) - at) < 0);
        const std::uint32_t k = is_first ? 1 : 2;
        const glm::dvec2 a = corner(entry, k), edge = corner(entry, (k + 1) % 3) - a;
        const double area = cross(way, edge);
        if (area == 0) return false;
        const double reached = cross(a - at, edge) / area;
        if (reached >= least) return true;
        const double on_edge = cross(at - a, way) / cross(edge, way);
        const double nearness_reached = glm::mix(static_cast<double>(vertex(entry, k).nearness),
                                                 static_cast<double>(vertex(entry, (k + 1) % 3).nearness), on_edge);
        if (reached < 0) {  // back again: between two edges, for the plane of a thin triangle says nothing
            return std::abs(glm::mix(nearness_there, nearness_reached, entered / (entered - reached)) - nearness) > level;
        }
        const HalfEdge exit = entry - entry % 3 + (entry + k) % 3, partner = mesh.partners[exit];
        if (partner == exit || mesh.partners[partner] != exit) return false;
        entry = partner;
        entered = reached;
        nearness_there = nearness_reached;
    }
    return false;
}

}  // namespace burin
