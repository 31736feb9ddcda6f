#include "lines/sharp_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "abuffer/tile_kernels.h"
#include "base/parallel.h"
#include "base/unfilled_vector.h"

namespace burin {
namespace {

using Normal = std::array<float, 4>;  // the last number is 0

/// The polygons' normals, in single precision; with kThinTriangle where a triangle is a sliver in its own
/// proportions, or nearly.
UnfilledVector<Normal> unit_normals(const Mesh& mesh, std::vector<std::uint8_t>& thin, int threads) {
    constexpr double kPart = 1.001 * kSliverHeightPart;
    constexpr std::size_t kChunk = 1 << 14;
    const TileKernels& kernels = best_kernels();
    UnfilledVector<Normal> normals(thin.size());
    parallel_for((thin.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk, int) {
        const std::size_t first = chunk * kChunk, count = std::min(kChunk, thin.size() - first);
        kernels.triangle_normals(glm::value_ptr(mesh.positions.front()), mesh.triangles[first].data(), count, kPart * kPart,
                                 normals[first].data(), &thin[first]);
        for (std::size_t t = first; t < first + count; ++t) thin[t] *= kThinTriangle;
    });
    if (mesh.polygon_normals.empty()) return normals;
    normals.resize(mesh.polygon_count);
    for (std::size_t p = 0; p < normals.size(); ++p) {
        const glm::dvec3 normal(mesh.polygon_normals[p]);
        const glm::vec3 unit(normal * (1 / std::max(std::sqrt(glm::dot(normal, normal)), 1e-300)));
        normals[p] = {unit.x, unit.y, unit.z, 0};
    }
    return normals;
}

}  // namespace

std::vector<std::uint8_t> find_sharp_edges(const Mesh& mesh, const LineCriteria& criteria, int threads) {
    std::vector<std::uint8_t> sharp(mesh.triangles.size());
    const UnfilledVector<Normal> normals = unit_normals(mesh, sharp, threads);
    const bool by_polygon = criteria.classes.has(LineClass::polygon);
    const bool by_material = criteria.classes.has(LineClass::material) && !mesh.polygon_material.empty();
    const bool by_crease = criteria.classes.has(LineClass::crease);
    // Single precision normals: what is close to the angle counts as sharp and is looked at again.
    const float cos_crease = static_cast<float>(criteria.cos_crease_angle) + 1e-5f;
    const auto is_crease = [&](std::uint32_t p, std::uint32_t q) {
        const Normal& a = normals[p];
        const Normal& b = normals[q];
        return by_crease && !(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > cos_crease);
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
    if (has_only_creases && by_crease && mesh.next_on_edge.size() < std::size_t{1} << 31) {
        constexpr std::size_t kChunk = 1 << 14;
        const TileKernels& kernels = best_kernels();
        parallel_for((sharp.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk, int) {
            const std::size_t first = chunk * kChunk, count = std::min(kChunk, sharp.size() - first);
            kernels.find_creases(mesh.triangles.front().data(), mesh.next_on_edge.data(), normals.front().data(), first, count, cos_crease,
                                 &sharp[first]);
        });
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
