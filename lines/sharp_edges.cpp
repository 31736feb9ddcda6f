#include "lines/sharp_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <numeric>

#include "base/parallel.h"
#include "base/unfilled_vector.h"
#include "kernels/tile_kernels.h"

namespace burin {
namespace {

using Normal = std::array<float, 4>;  // the last number is 0
using RoughNormal = std::array<std::int16_t, 4>;

constexpr double kThinSquare = 1.001 * kSliverHeightPart * 1.001 * kSliverHeightPart;
constexpr std::size_t kChunk = 1 << 14;  // triangles at a time

bool is_crease(const Normal& a, const Normal& b, float cos_crease) {
    return !(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > cos_crease);
}

template <typename Work>
void for_chunks(std::size_t triangles, int threads, const Work& work) {
    parallel_for((triangles + kChunk - 1) / kChunk, threads,
                 [&](std::size_t chunk, int) { work(chunk * kChunk, std::min(kChunk, triangles - chunk * kChunk)); });
}

/// The corners of triangles [first, first + count), each triangle's seen from its first one: so single precision
/// resolves them.
std::vector<glm::vec3> corners_apart(const Mesh& mesh, std::size_t first, std::size_t count) {
    std::vector<glm::vec3> corners;
    corners.reserve(3 * count);
    for (std::size_t t = first; t < first + count; ++t) {
        const glm::dvec3 origin = mesh.local_position(mesh.triangles[t][0]);
        for (const std::uint32_t v : mesh.triangles[t]) corners.emplace_back(mesh.local_position(v) - origin);
    }
    return corners;
}

/// The polygons' normals, in single precision; with kThinTriangle where a triangle is a sliver in its own
/// proportions, or nearly.
UnfilledVector<Normal> unit_normals(const Mesh& mesh, std::vector<std::uint8_t>& thin, int threads) {
    const TileKernels& kernels = best_kernels();
    UnfilledVector<Normal> normals(thin.size());
    for_chunks(thin.size(), threads, [&](std::size_t first, std::size_t count) {
        if (mesh.has_residuals()) {
            const std::vector<glm::vec3> corners = corners_apart(mesh, first, count);
            std::vector<std::uint32_t> numbers(corners.size());
            std::iota(numbers.begin(), numbers.end(), 0u);
            kernels.mesh.normals(glm::value_ptr(corners.front()), numbers.data(), count, kThinSquare,
                                 normals[first].data(), &thin[first]);
        } else {
            kernels.mesh.normals(glm::value_ptr(mesh.positions.front()), mesh.triangles[first].data(), count,
                                 kThinSquare, normals[first].data(), &thin[first]);
        }
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

/// How far a cosine of rough normals may be off, for both may be off by 3 units of 1 / kRoughUnit.
constexpr double kDoubt = 2e-4;

/// Finds creases between triangles, where nothing else is looked for. Rough normals, which take half of the memory,
/// tell nearly always.
void find_creases(const Mesh& mesh, float cos_crease, std::vector<std::uint8_t>& sharp, int threads) {
    constexpr double kSquare = double{kRoughUnit} * double{kRoughUnit};
    const double cosine{cos_crease};
    const auto low = static_cast<std::int32_t>((cosine - kDoubt) * kSquare),
               high = static_cast<std::int32_t>((cosine + kDoubt) * kSquare);
    const TileKernels& kernels = best_kernels();
    const float* const positions = glm::value_ptr(mesh.positions.front());
    UnfilledVector<RoughNormal> normals(sharp.size());
    for_chunks(sharp.size(), threads, [&](std::size_t first, std::size_t count) {
        kernels.mesh.rough_normals(positions, mesh.triangles[first].data(), count, kThinSquare, normals[first].data(),
                                   &sharp[first]);
    });
    const auto exact_normal = [&](std::uint32_t triangle) {
        Normal normal;
        std::uint8_t thin = 0;
        kernels.mesh.normals(positions, mesh.triangles[triangle].data(), 1, 0, normal.data(), &thin);
        return normal;
    };
    for_chunks(sharp.size(), threads, [&](std::size_t first, std::size_t count) {
        UnfilledVector<HalfEdge> in_doubt(3 * count);
        in_doubt.resize(kernels.mesh.find_creases(mesh.triangles.front().data(), mesh.next_on_edge.data(),
                                                  normals.front().data(), first, count, low, high, &sharp[first],
                                                  in_doubt.data()));
        for (const HalfEdge h : in_doubt) {
            if (is_crease(exact_normal(h / 3), exact_normal(mesh.next_on_edge[h] / 3), cos_crease)) continue;
            sharp[h / 3] = static_cast<std::uint8_t>(sharp[h / 3] & ~(1u << h % 3));
        }
    });
}

}  // namespace

std::vector<std::uint8_t> find_sharp_edges(const Mesh& mesh, const LineCriteria& criteria, int threads) {
    std::vector<std::uint8_t> sharp(mesh.triangles.size());
    if (sharp.empty()) return sharp;
    const bool by_polygon = criteria.classes.has(LineClass::polygon);
    const bool by_material = criteria.classes.has(LineClass::material) && !mesh.polygon_material.empty();
    const bool by_crease = criteria.classes.has(LineClass::crease);
    // What is close to the angle counts as sharp and is looked at again.
    const float cos_crease = static_cast<float>(criteria.cos_crease_angle) + kCreaseSlack;
    const bool has_only_creases =
        mesh.marked.empty() && mesh.triangle_polygon.empty() && !mesh.has_residuals() && !by_polygon && !by_material;
    // Near an angle of 0 all that is flat would be in doubt.
    const bool is_flat_told = double{cos_crease} + 2 * kDoubt < 1;
    if (has_only_creases && by_crease && is_flat_told && mesh.next_on_edge.size() < std::size_t{1} << 29) {
        find_creases(mesh, cos_crease, sharp, threads);
        return sharp;
    }
    const UnfilledVector<Normal> normals = unit_normals(mesh, sharp, threads);
    const auto is_sharp = [&](HalfEdge h, HalfEdge g) {
        if (mesh.is_marked(h)) return true;
        const std::uint32_t p = mesh.polygon_of(h / 3), q = mesh.polygon_of(g / 3);
        if (p == q) return false;
        if (by_polygon || (by_material && mesh.polygon_material[p] != mesh.polygon_material[q])) return true;
        return by_crease && is_crease(normals[p], normals[q], cos_crease);
    };
    // Both half-edges of a pair find the same: a branch on which of them comes first would be unpredictable and take
    // longer.
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
    find(is_sharp);
    return sharp;
}

bool keeps_angles(const glm::dmat4& m) {
    // Matrices of other programs are rounded to single precision, some of them products of such: off by some 1e-7.
    // Cosines of angles between normals then change by less than six times the slack, which kCreaseSlack allows for.
    constexpr double kSlack = 1e-6;
    static_assert(7 * kSlack < double{kCreaseSlack});
    const glm::dvec3 a(m[0]), b(m[1]), c(m[2]);
    const double size = glm::dot(a, a), slack = kSlack * size;
    return std::abs(glm::dot(a, b)) < slack && std::abs(glm::dot(b, c)) < slack && std::abs(glm::dot(a, c)) < slack &&
           std::abs(glm::dot(b, b) - size) < slack && std::abs(glm::dot(c, c) - size) < slack;
}

}  // namespace burin
