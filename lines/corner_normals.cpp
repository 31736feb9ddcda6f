#include "lines/corner_normals.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lines/sharp_edges.h"

namespace burin {
namespace {

/// Of 60 degrees: whatever the crease angle, no surface is smooth that turns by more around a vertex.
constexpr double kCosBluntestTip = 0.5;

glm::dvec3 unit(const glm::dvec3& v) { return v / std::max(glm::length(v), 1e-300); }

double angle_at(const Mesh& mesh, HalfEdge corner) {
    const auto& t = mesh.triangles[corner / 3];
    const glm::dvec3 p(mesh.positions[t[corner % 3]]);
    const glm::dvec3 a = glm::dvec3(mesh.positions[t[(corner + 1) % 3]]) - p;
    const glm::dvec3 b = glm::dvec3(mesh.positions[t[(corner + 2) % 3]]) - p;
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

SmoothMesh make_smooth(const Mesh& mesh, double cos_crease_angle) {
    SmoothMesh smooth;
    LineCriteria criteria;
    criteria.classes = LineClass::crease;
    criteria.cos_crease_angle = cos_crease_angle;
    smooth.sharp = find_sharp_edges(mesh, criteria);
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
            parts.push_back(unit(glm::dvec3(mesh.polygon_area_vector(h / 3))) * angle_at(mesh, h));
        });
        // Sums depend on their order, and that must not depend on the triangles'.
        std::sort(parts.begin(), parts.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
            return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        });
        glm::dvec3 sum(0.0);
        for (const glm::dvec3& part : parts) sum += part;
        const glm::dvec3 normal = unit(sum);
        const bool is_tip = std::any_of(corners.begin(), corners.end(), [&](HalfEdge h) {
            const glm::dvec3 own = unit(glm::dvec3(mesh.polygon_area_vector(h / 3)));
            return glm::dot(own, normal) < std::max(cos_crease_angle, kCosBluntestTip);
        });
        for (const HalfEdge h : corners) {
            smooth.normals[h] = is_tip ? glm::vec3(0.0f) : glm::vec3(normal);
            done[h] = true;
        }
    }
    return smooth;
}

}  // namespace burin
