#include "lines/corner_normals.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lines/sharp_edges.h"
#include "lines/vertex_normal.h"
#include "mesh/vectors.h"

namespace burin {
namespace {

/// The cosine of 60 degrees: whatever the crease angle, no surface is smooth that turns by more around a vertex.
constexpr double kCosBluntestTip = 0.5;

glm::dvec3 unit_normal(const Mesh& mesh, std::uint32_t t) { return unit(glm::dvec3(mesh.polygon_area_vector(t))); }

/// Whether two triangles at an edge are wound the other way than each other: both run along it in one direction.
bool are_turned(const Mesh& mesh, HalfEdge h, HalfEdge g) {
    return mesh.triangles[h / 3][h % 3] == mesh.triangles[g / 3][g % 3];
}

/// Makes the edges between such triangles smooth where no crease is.
void clear_turned_edges(const Mesh& mesh, double cos_crease_angle, std::vector<std::uint8_t>& sharp) {
    const double least_cosine = cos_crease_angle + double{kCreaseSlack};
    for (HalfEdge h = 0; h < mesh.next_on_edge.size(); ++h) {
        const HalfEdge g = mesh.next_on_edge[h];
        if (g == h || mesh.next_on_edge[g] != h || !are_turned(mesh, h, g) || mesh.is_marked(h)) continue;
        if (-glm::dot(unit_normal(mesh, h / 3), unit_normal(mesh, g / 3)) <= least_cosine) continue;
        sharp[h / 3] &= static_cast<std::uint8_t>(~(1u << h % 3));
    }
}

/// Per triangle, whether it is wound as the first one of its smooth surface, 1, or the other way round, -1. Edges
/// become sharp where that contradicts itself, as on a Möbius strip.
std::vector<std::int8_t> find_windings(const Mesh& mesh, std::vector<std::uint8_t>& sharp) {
    std::vector<std::int8_t> windings(mesh.triangles.size(), 0);  // 0: not known yet
    std::vector<std::uint32_t> surface;
    for (std::uint32_t start = 0; start < windings.size(); ++start) {
        if (windings[start] != 0) continue;
        windings[start] = 1;
        surface.assign(1, start);
        for (std::size_t i = 0; i < surface.size(); ++i) {
            const std::uint32_t t = surface[i];
            for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
                const HalfEdge g = mesh.next_on_edge[h];
                if ((sharp[t] >> (h - 3 * t) & 1) != 0) continue;
                const auto winding = static_cast<std::int8_t>(are_turned(mesh, h, g) ? -windings[t] : windings[t]);
                std::int8_t& known = windings[g / 3];
                if (known == 0) {
                    known = winding;
                    surface.push_back(g / 3);
                } else if (known != winding) {
                    for (const HalfEdge e : {h, g}) sharp[e / 3] |= static_cast<std::uint8_t>(1u << e % 3);
                }
            }
        }
    }
    return windings;
}

}  // namespace

SmoothMesh make_smooth(const Mesh& mesh, double cos_crease_angle) {
    SmoothMesh smooth;
    LineCriteria criteria;
    criteria.classes = LineClass::crease;
    criteria.cos_crease_angle = cos_crease_angle;
    smooth.sharp = find_sharp_edges(mesh, criteria);
    clear_turned_edges(mesh, cos_crease_angle, smooth.sharp);
    const std::vector<std::int8_t> windings = find_windings(mesh, smooth.sharp);
    const auto normal_of = [&](HalfEdge h) { return unit_normal(mesh, h / 3) * static_cast<double>(windings[h / 3]); };
    smooth.normals.resize(3 * mesh.triangles.size());
    std::vector<bool> done(smooth.normals.size(), false);
    std::vector<HalfEdge> corners;
    std::vector<glm::dvec3> parts;
    for (HalfEdge c = 0; c < done.size(); ++c) {
        if (done[c]) continue;
        corners.clear();
        parts.clear();
        visit_smooth_corners(mesh, smooth, c, [&](HalfEdge h) {
            corners.push_back(h);
            parts.push_back(normal_of(h) * angle_at(mesh, h));
        });
        // Sums depend on their order, and that must not depend on the triangles'.
        std::sort(parts.begin(), parts.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
            return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        });
        glm::dvec3 sum(0.0);
        for (const glm::dvec3& part : parts) sum += part;
        const glm::dvec3 normal = unit(sum);
        const bool is_tip = std::any_of(corners.begin(), corners.end(), [&](HalfEdge h) {
            return glm::dot(normal_of(h), normal) < std::max(cos_crease_angle, kCosBluntestTip);
        });
        for (const HalfEdge h : corners) {
            smooth.normals[h] = is_tip ? glm::vec3(0.0f) : glm::vec3(normal);
            done[h] = true;
        }
    }
    return smooth;
}

}  // namespace burin
