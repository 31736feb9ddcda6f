#include "lines/sharp_edges.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace burin {
namespace {

std::vector<glm::vec3> unit_normals(const Mesh& mesh) {
    std::vector<glm::vec3> normals(mesh.polygon_count);
    const auto unit = [](const glm::dvec3& v) { return glm::vec3(v / std::max(glm::length(v), 1e-300)); };
    if (!mesh.polygon_normals.empty()) {
        for (std::size_t p = 0; p < normals.size(); ++p) normals[p] = unit(glm::dvec3(mesh.polygon_normals[p]));
        return normals;
    }
    for (std::size_t t = 0; t < normals.size(); ++t) {
        const auto& c = mesh.triangles[t];
        const glm::dvec3 a(mesh.positions[c[0]]);
        normals[t] = unit(glm::cross(glm::dvec3(mesh.positions[c[1]]) - a, glm::dvec3(mesh.positions[c[2]]) - a));
    }
    return normals;
}

/// Whether a triangle is a sliver in its own proportions, or nearly.
bool is_thin(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
    const glm::dvec3 a(mesh.positions[t[0]]);
    const glm::dvec3 ab = glm::dvec3(mesh.positions[t[1]]) - a, ac = glm::dvec3(mesh.positions[t[2]]) - a;
    const glm::dvec3 bc = ac - ab, area = glm::cross(ab, ac);
    const double longest2 = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
    constexpr double kPart = 1.001 * kSliverHeightPart;
    return !(glm::dot(area, area) > kPart * kPart * longest2 * longest2);
}

}  // namespace

std::vector<std::uint8_t> find_sharp_edges(const Mesh& mesh, const LineCriteria& criteria) {
    const std::vector<glm::vec3> normals = unit_normals(mesh);
    const bool by_polygon = criteria.classes.has(LineClass::polygon);
    const bool by_material = criteria.classes.has(LineClass::material) && !mesh.polygon_material.empty();
    const bool by_crease = criteria.classes.has(LineClass::crease);
    // Single precision normals: what is close to the angle counts as sharp and is looked at again.
    const float cos_crease = static_cast<float>(criteria.cos_crease_angle) + 1e-5f;
    std::vector<std::uint8_t> sharp(mesh.triangles.size(), 0);
    const auto is_sharp = [&](HalfEdge h, HalfEdge g) {
        const std::uint32_t t = h / 3, u = g / 3;
        if (mesh.is_marked(h) || mesh.triangles[t][h % 3] == mesh.triangles[u][g % 3]) return true;
        const std::uint32_t p = mesh.polygon_of(t), q = mesh.polygon_of(u);
        if (p == q) return false;
        if (by_polygon || (by_material && mesh.polygon_material[p] != mesh.polygon_material[q])) return true;
        return by_crease && !(glm::dot(normals[p], normals[q]) > cos_crease);
    };
    for (HalfEdge h = 0; h < mesh.next_on_edge.size(); ++h) {
        const HalfEdge g = mesh.next_on_edge[h];
        const auto bit = static_cast<std::uint8_t>(1u << h % 3);
        if (g == h || mesh.next_on_edge[g] != h) {
            sharp[h / 3] |= bit;
        } else if (h < g && is_sharp(h, g)) {
            sharp[h / 3] |= bit;
            sharp[g / 3] |= static_cast<std::uint8_t>(1u << g % 3);
        }
    }
    for (std::size_t t = 0; t < sharp.size(); ++t) {
        if (is_thin(mesh, mesh.triangles[t])) sharp[t] |= kThinTriangle;
    }
    return sharp;
}

bool keeps_angles(const glm::dmat4& m) {
    const glm::dvec3 a(m[0]), b(m[1]), c(m[2]);
    const double size = glm::dot(a, a), slack = 1e-9 * size;
    return std::abs(glm::dot(a, b)) < slack && std::abs(glm::dot(b, c)) < slack &&
           std::abs(glm::dot(a, c)) < slack && std::abs(glm::dot(b, b) - size) < slack &&
           std::abs(glm::dot(c, c) - size) < slack;
}

}  // namespace burin
