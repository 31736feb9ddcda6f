#include "lines/sharp_edges.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"

namespace burin {
namespace {

glm::vec3 scaled_to_one(const glm::dvec3& v, double square) {
    return glm::vec3(v * (1 / std::max(std::sqrt(square), 1e-300)));
}

/// The polygons' normals, in single precision; with kThinTriangle where a triangle is a sliver in its own
/// proportions, or nearly.
std::vector<glm::vec3> unit_normals(const Mesh& mesh, std::vector<std::uint8_t>& thin, int threads) {
    std::vector<glm::vec3> normals(mesh.polygon_count);
    const bool has_polygons = !mesh.polygon_normals.empty();
    for (std::size_t p = 0; has_polygons && p < normals.size(); ++p) {
        const glm::dvec3 normal(mesh.polygon_normals[p]);
        normals[p] = scaled_to_one(normal, glm::dot(normal, normal));
    }
    parallel_for_each(thin.size(), threads, [&](std::size_t t) {
        const auto& corners = mesh.triangles[t];
        const glm::dvec3 a(mesh.positions[corners[0]]);
        const glm::dvec3 ab = glm::dvec3(mesh.positions[corners[1]]) - a;
        const glm::dvec3 ac = glm::dvec3(mesh.positions[corners[2]]) - a;
        const glm::dvec3 bc = ac - ab, area = glm::cross(ab, ac);
        const double longest2 = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
        const double area2 = glm::dot(area, area);
        constexpr double kPart = 1.001 * kSliverHeightPart;
        thin[t] = !(area2 > kPart * kPart * longest2 * longest2) ? kThinTriangle : 0;
        if (!has_polygons) normals[t] = scaled_to_one(area, area2);
    });
    return normals;
}

}  // namespace

std::vector<std::uint8_t> find_sharp_edges(const Mesh& mesh, const LineCriteria& criteria, int threads) {
    std::vector<std::uint8_t> sharp(mesh.triangles.size());
    const std::vector<glm::vec3> normals = unit_normals(mesh, sharp, threads);
    const bool by_polygon = criteria.classes.has(LineClass::polygon);
    const bool by_material = criteria.classes.has(LineClass::material) && !mesh.polygon_material.empty();
    const bool by_crease = criteria.classes.has(LineClass::crease);
    // Single precision normals: what is close to the angle counts as sharp and is looked at again.
    const float cos_crease = static_cast<float>(criteria.cos_crease_angle) + 1e-5f;
    const auto is_crease = [&](std::uint32_t p, std::uint32_t q) {
        return by_crease && !(glm::dot(normals[p], normals[q]) > cos_crease);
    };
    const auto is_sharp = [&](HalfEdge h, HalfEdge g) {
        if (mesh.is_marked(h)) return true;
        const std::uint32_t p = mesh.polygon_of(h / 3), q = mesh.polygon_of(g / 3);
        if (p == q) return false;
        if (by_polygon || (by_material && mesh.polygon_material[p] != mesh.polygon_material[q])) return true;
        return is_crease(p, q);
    };
    // Both half-edges of a pair find the same: guessing which of them comes first would take longer.
    const auto find = [&](const auto& is_sharp_pair) {
        const std::uint32_t* const begins = mesh.triangles.front().data();  // of half-edges, vertices
        const HalfEdge* const next = mesh.next_on_edge.data();
        parallel_for_each(sharp.size(), threads, [&](std::size_t t) {
            unsigned edges = 0;
            for (unsigned k = 0; k < 3; ++k) {
                const auto h = static_cast<HalfEdge>(3 * t + k), g = next[h];
                const bool is_smooth_pair =
                    (g != h) & (next[g] == h) & (begins[h] != begins[g]) && !is_sharp_pair(h, g);
                edges |= (is_smooth_pair ? 0u : 1u) << k;
            }
            sharp[t] |= static_cast<std::uint8_t>(edges);
        });
    };
    if (sharp.empty()) return sharp;
    const bool has_only_creases = mesh.marked.empty() && mesh.triangle_polygon.empty() && !by_polygon && !by_material;
    if (has_only_creases) {
        find([&](HalfEdge h, HalfEdge g) { return is_crease(h / 3, g / 3); });
    } else {
        find(is_sharp);
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
