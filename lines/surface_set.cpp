#include "lines/surface_set.h"

#include <utility>

namespace burin {
namespace {

/// The triangles [first, second) of the polygon that a triangle belongs to.
std::pair<std::uint32_t, std::uint32_t> triangles_of_polygon(const Mesh& mesh, std::uint32_t triangle) {
    std::uint32_t begin = triangle, end = triangle + 1;
    if (mesh.triangle_polygon.empty()) return {begin, end};
    const std::uint32_t polygon = mesh.polygon_of(triangle);
    while (begin > 0 && mesh.polygon_of(begin - 1) == polygon) --begin;
    while (end < mesh.triangles.size() && mesh.polygon_of(end) == polygon) ++end;
    return {begin, end};
}

}  // namespace

SurfaceOrder SurfaceSet::order(SurfaceId a, SurfaceId b) const {
    const auto compare = [&](SurfaceId s, SurfaceId t) {
        glm::dvec3 corners_s[3], corners_t[3];
        view_corners(s, corners_s);
        view_corners(t, corners_t);
        return compare_surfaces(projection, corners_s, corners_t, s.instance == t.instance, coordinate_error);
    };
    // The triangles in question first: they tell for most.
    SurfaceOrder order = compare(a, b);
    const auto [begin_a, end_a] = triangles_of_polygon(mesh_of(a), a.triangle);
    const auto [begin_b, end_b] = triangles_of_polygon(mesh_of(b), b.triangle);
    for (std::uint32_t s = begin_a; s < end_a; ++s) {
        for (std::uint32_t t = begin_b; t < end_b; ++t) {
            if (order.is_apart) return order;
            if (s != a.triangle || t != b.triangle) order += compare({a.instance, s}, {b.instance, t});
        }
    }
    return order;
}

}  // namespace burin
