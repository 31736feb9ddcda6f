#include "lines/vertex_normal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "mesh/vectors.h"

namespace burin {
namespace {

/// More triangles than that around a vertex are not looked at.
constexpr std::size_t kMostAround = 64;

glm::dvec3 normal_of(const Mesh& mesh, HalfEdge h) { return unit(mesh.polygon_area_vector(h / 3)); }
HalfEdge turned(HalfEdge h, unsigned by) { return h - h % 3 + (h % 3 + by) % 3; }
std::uint32_t start_of(const Mesh& mesh, HalfEdge h) { return mesh.triangles[h / 3][h % 3]; }
/// Whether the triangles at an edge are wound the same way round: they run along it in opposite directions.
bool are_alike(const Mesh& mesh, HalfEdge h, HalfEdge g) { return start_of(mesh, h) != start_of(mesh, g); }

}  // namespace

double angle_at(const Mesh& mesh, HalfEdge corner) {
    const auto& t = mesh.triangles[corner / 3];
    const glm::dvec3 p = mesh.local_position(t[corner % 3]);
    const glm::dvec3 a = mesh.local_position(t[(corner + 1) % 3]) - p;
    const glm::dvec3 b = mesh.local_position(t[(corner + 2) % 3]) - p;
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

bool is_smooth_edge(const Mesh& mesh, HalfEdge h, double cos_crease_angle) {
    const HalfEdge g = mesh.next_on_edge[h];
    if (g == h || mesh.next_on_edge[g] != h || mesh.is_marked(h)) return false;
    const double cosine = glm::dot(normal_of(mesh, h), normal_of(mesh, g));
    return (are_alike(mesh, h, g) ? cosine : -cosine) > cos_crease_angle;
}

glm::dvec3 smooth_normal_at(const Mesh& mesh, HalfEdge corner, double cos_crease_angle) {
    std::array<glm::dvec3, kMostAround> parts;
    std::size_t count = 0;
    const auto add = [&](HalfEdge at, double side) {
        parts[count++] = normal_of(mesh, at) * (side * angle_at(mesh, at));
    };
    add(corner, 1);
    for (const bool is_first_way : {true, false}) {
        HalfEdge at = corner;
        double side = 1;
        bool leaves_by_own = is_first_way;
        while (count < kMostAround) {
            const HalfEdge exit = leaves_by_own ? at : turned(at, 2);
            if (!is_smooth_edge(mesh, exit, cos_crease_angle)) break;
            const HalfEdge entry = mesh.next_on_edge[exit];
            if (!are_alike(mesh, exit, entry)) side = -side;
            leaves_by_own = start_of(mesh, entry) != start_of(mesh, corner);
            at = leaves_by_own ? turned(entry, 1) : entry;
            if (at == corner) break;
            add(at, side);
        }
        if (at == corner && count > 1) break;  // all around
    }
    // Sums depend on their order, and that must not depend on the triangles'.
    std::sort(
        parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count),
        [](const glm::dvec3& a, const glm::dvec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < count; ++i) sum += parts[i];
    return unit(sum);
}

}  // namespace burin
