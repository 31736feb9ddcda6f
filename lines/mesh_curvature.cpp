#include "lines/mesh_curvature.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "lines/corner_normals.h"

namespace burin {
namespace {

/// A polygon that is thinner than this part of its length says nothing of how the surface turns.
constexpr double kThinnest = 1e-7;
/// No matrix has larger numbers: what is finite stays so when it is computed with in single precision.
constexpr double kLargestTurn = 1e30;

using Turn = std::array<double, 6>;  // as VertexCurvature has it

/// What a polygon says of its surface.
struct PolygonTurn {
    glm::dvec3 along{0.0}, across{0.0};  ///< unit vectors in its plane
    double e = 0, f = 0, g = 0;          ///< the matrix in them: along-along, along-across, across-across
    bool is_known = false;
};

/// The solution of a symmetric system of three equations a x = r; 0 if there is none.
glm::dvec3 solved(const glm::dmat3& a, const glm::dvec3& r) {
    const glm::dvec3 c0 = glm::cross(a[1], a[2]), c1 = glm::cross(a[2], a[0]), c2 = glm::cross(a[0], a[1]);
    const double determinant = glm::dot(a[0], c0);
    if (!(std::abs(determinant) > 0)) return glm::dvec3(0.0);
    return glm::dvec3(glm::dot(c0, r), glm::dot(c1, r), glm::dot(c2, r)) / determinant;
}

/// Whether an edge is inside a polygon, which has been cut into triangles there.
bool is_diagonal(const Mesh& mesh, HalfEdge h) {
    const HalfEdge g = mesh.next_on_edge[h];
    return g != h && mesh.next_on_edge[g] == h && mesh.polygon_of(g / 3) == mesh.polygon_of(h / 3);
}

/// Of the triangles [first, end), which are one polygon.
PolygonTurn turn_of(const Mesh& mesh, const SmoothMesh& smooth, std::uint32_t first, std::uint32_t end) {
    const auto place = [&](HalfEdge h) { return mesh.local_position(mesh.triangles[h / 3][h % 3]); };
    const auto next = [](HalfEdge h) { return h - h % 3 + (h % 3 + 1) % 3; };
    double longest = 0;
    for (HalfEdge h = 3 * first; h < 3 * end; ++h) longest = std::max(longest, glm::distance(place(h), place(next(h))));
    PolygonTurn turn;
    if (!(longest > 0) || !std::isfinite(longest)) return turn;
    glm::dvec3 area_vector(0.0), sum(0.0), longest_edge(0.0);
    for (HalfEdge h = 3 * first; h < 3 * end; h += 3) {
        const glm::dvec3 a = (place(h + 1) - place(h)) / longest, b = (place(h + 2) - place(h)) / longest;
        area_vector += glm::cross(a, b);
    }
    for (HalfEdge h = 3 * first; h < 3 * end; ++h) {
        sum += glm::dvec3(smooth.normals[h]);
        const glm::dvec3 edge = (place(next(h)) - place(h)) / longest;
        if (glm::dot(edge, edge) > glm::dot(longest_edge, longest_edge)) longest_edge = edge;
    }
    const double twice_area = glm::length(area_vector);
    if (!(twice_area > kThinnest)) return turn;
    const glm::dvec3 normal = area_vector / twice_area;
    // At a tip the surface has the polygon's own normal, on the side of the others.
    const glm::dvec3 normal_at_tips = glm::dot(sum, normal) < 0 ? -normal : normal;
    const auto normal_at = [&](HalfEdge h) {
        return smooth.normals[h] == glm::vec3(0.0f) ? normal_at_tips : glm::dvec3(smooth.normals[h]);
    };
    turn.across = glm::cross(normal, longest_edge);
    const double length = glm::length(turn.across);
    if (!(length > kThinnest)) return turn;
    turn.across /= length;
    turn.along = glm::cross(turn.across, normal);
    glm::dmat3 a(0.0);
    glm::dvec3 r(0.0);
    for (HalfEdge h = 3 * first; h < 3 * end; ++h) {
        if (is_diagonal(mesh, h)) continue;
        const glm::dvec3 edge = (place(next(h)) - place(h)) / longest, change = normal_at(next(h)) - normal_at(h);
        const double u = glm::dot(edge, turn.along), v = glm::dot(edge, turn.across);
        const double p = glm::dot(change, turn.along), q = glm::dot(change, turn.across);
        a[0][0] += u * u;
        a[1][0] += u * v;
        a[1][1] += u * u + v * v;
        a[2][2] += v * v;
        r += glm::dvec3(u * p, v * p + u * q, v * q);
    }
    a[0][1] = a[1][2] = a[2][1] = a[1][0];
    const glm::dvec3 fitted = solved(a, r) / longest;
    turn.is_known =
        std::abs(fitted.x) < kLargestTurn && std::abs(fitted.y) < kLargestTurn && std::abs(fitted.z) < kLargestTurn;
    turn.e = fitted.x;
    turn.f = fitted.y;
    turn.g = fitted.z;
    return turn;
}

/// The part of a triangle's area that is nearest to a corner; of one with an obtuse angle, half of it there, and a
/// quarter at the others (Meyer et al. 2003).
double area_at(const Mesh& mesh, HalfEdge corner) {
    const auto place = [&](std::size_t k) {
        return mesh.local_position(mesh.triangles[corner / 3][(corner % 3 + k) % 3]);
    };
    const glm::dvec3 own = place(0), ab = place(1) - own, ac = place(2) - own, bc = place(2) - place(1);
    const double twice_area = glm::length(glm::cross(ab, ac));
    const double at_a = glm::dot(ab, ac), at_b = -glm::dot(ab, bc), at_c = glm::dot(ac, bc);
    if (!(twice_area > 0)) return 0;
    if (at_a <= 0) return 0.25 * twice_area;
    if (at_b <= 0 || at_c <= 0) return 0.125 * twice_area;
    return (glm::dot(ab, ab) * at_c + glm::dot(ac, ac) * at_b) / (8 * twice_area);
}

/// The matrix of a polygon, turned with its plane into the plane across a normal.
Turn turned_into(const PolygonTurn& turn, const glm::dvec3& normal) {
    glm::dvec3 own = glm::cross(turn.along, turn.across);
    if (glm::dot(own, normal) < 0) own = -own;
    const glm::dvec3 axis = glm::cross(own, normal);
    const double cosine = glm::dot(own, normal);
    const auto turned = [&](const glm::dvec3& v) {
        return cosine * v + glm::cross(axis, v) + axis * (glm::dot(axis, v) / (1 + cosine));
    };
    const glm::dvec3 a = turned(turn.along), b = turned(turn.across);
    const auto part = [&](int i, int k) {
        return turn.e * a[i] * a[k] + turn.f * (a[i] * b[k] + b[i] * a[k]) + turn.g * b[i] * b[k];
    };
    return {part(0, 0), part(0, 1), part(0, 2), part(1, 1), part(1, 2), part(2, 2)};
}

/// The normal at a vertex with polygons all around that is exact on a ball, whatever their shapes (Max 1999): means by
/// angles lean towards the side with more polygons, as beside the pole of a globe. `given`: the mean by angles, which
/// stays where there is no other.
glm::dvec3 normal_around(const Mesh& mesh, std::span<const HalfEdge> corners, const glm::dvec3& given,
                         std::vector<glm::dvec3>& parts) {
    parts.clear();
    for (const HalfEdge h : corners) {
        const auto place = [&](std::size_t k) { return mesh.local_position(mesh.triangles[h / 3][(h % 3 + k) % 3]); };
        const glm::dvec3 a = place(1) - place(0), b = place(2) - place(0);
        const glm::dvec3 part = glm::cross(a / glm::dot(a, a), b / glm::dot(b, b));
        parts.push_back(glm::dot(part, given) < 0 ? -part : part);
    }
    std::sort(parts.begin(), parts.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    });
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& part : parts) sum += part;
    const glm::dvec3 normal = sum / glm::length(sum);
    constexpr double kLeastCosine = 0.9;
    return glm::dot(normal, given) > kLeastCosine ? normal : given;  // NaN is no normal either
}

/// Gives a vertex the mean of matrices by their areas. Sums depend on their order, and that must not depend on the
/// triangles'.
void set_mean(std::vector<std::pair<double, Turn>>& parts, VertexCurvature& vertex) {
    std::sort(parts.begin(), parts.end());
    double area = 0;
    Turn sum{};
    for (const auto& [part_area, part] : parts) {
        area += part_area;
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += part_area * part[k];
    }
    for (std::size_t k = 0; area > 0 && k < sum.size(); ++k) {
        const double mean = sum[k] / area;
        vertex.turn[k] = std::isfinite(mean) ? static_cast<float>(mean) : 0.0f;
    }
}

}  // namespace

MeshCurvature make_curvature(const Mesh& mesh, double cos_crease_angle, int threads) {
    SmoothMesh smooth = make_smooth(mesh, cos_crease_angle);
    constexpr std::size_t kChunk = 4096;
    const auto in_chunks = [threads](std::size_t count, const auto& work) {
        parallel_for((count + kChunk - 1) / kChunk, threads, [&](std::size_t chunk, int) {
            throw_if_interrupted();
            work(chunk * kChunk, std::min(count, (chunk + 1) * kChunk));
        });
    };
    MeshCurvature result;
    constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    result.corners.assign(3 * mesh.triangles.size(), kNone);
    std::vector<HalfEdge> first_corners;  // of vertices
    for (HalfEdge c = 0; c < result.corners.size(); ++c) {
        if (result.corners[c] != kNone) continue;
        visit_smooth_corners(mesh, smooth, c,
                             [&](HalfEdge h) { result.corners[h] = static_cast<std::uint32_t>(first_corners.size()); });
        first_corners.push_back(c);
    }
    // All corners of a vertex are in one chunk.
    in_chunks(first_corners.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<HalfEdge> corners;
        std::vector<glm::dvec3> parts;
        for (std::size_t i = begin; i < end; ++i) {
            corners.clear();
            bool is_closed = true;
            visit_smooth_corners(mesh, smooth, first_corners[i], [&](HalfEdge h) {
                corners.push_back(h);
                is_closed = is_closed && !smooth.is_sharp(h) && !smooth.is_sharp(h - h % 3 + (h % 3 + 2) % 3);
            });
            const glm::vec3 given = smooth.normals[first_corners[i]];
            if (!is_closed || given == glm::vec3(0.0f)) continue;
            const glm::vec3 normal(normal_around(mesh, corners, glm::dvec3(given), parts));
            for (const HalfEdge h : corners) smooth.normals[h] = normal;
        }
    });

    std::vector<std::uint32_t> first_triangles;  // of polygons, and the end
    std::vector<std::uint32_t> polygons;         // of triangles
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (t == 0 || mesh.polygon_of(t) != mesh.polygon_of(t - 1)) first_triangles.push_back(t);
        polygons.push_back(static_cast<std::uint32_t>(first_triangles.size() - 1));
    }
    first_triangles.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
    std::vector<PolygonTurn> turns(first_triangles.size() - 1);
    in_chunks(turns.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            turns[i] = turn_of(mesh, smooth, first_triangles[i], first_triangles[i + 1]);
    });

    result.vertices.resize(first_corners.size());
    in_chunks(first_corners.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<std::pair<double, Turn>> parts;  // area, matrix
        for (std::size_t i = begin; i < end; ++i) {
            VertexCurvature& vertex = result.vertices[i];
            vertex.normal = smooth.normals[first_corners[i]];
            if (vertex.normal == glm::vec3(0.0f)) continue;
            parts.clear();
            visit_smooth_corners(mesh, smooth, first_corners[i], [&](HalfEdge h) {
                const PolygonTurn& turn = turns[polygons[h / 3]];
                const double area = turn.is_known ? area_at(mesh, h) : 0;
                if (area > 0 && std::isfinite(area))
                    parts.emplace_back(area, turned_into(turn, glm::dvec3(vertex.normal)));
            });
            set_mean(parts, vertex);
        }
    });
    return result;
}

const MeshCurvature& SceneCurvatures::of(const Mesh& mesh, std::size_t number, std::size_t mesh_count,
                                         double cos_crease_angle, int threads) {
    meshes_.resize(std::max(meshes_.size(), mesh_count));
    if (!meshes_[number])
        meshes_[number] = std::make_unique<const MeshCurvature>(make_curvature(mesh, cos_crease_angle, threads));
    return *meshes_[number];
}

double radial_curvature(const MeshCurvature& curvature, std::uint32_t triangle, const std::array<double, 3>& weights,
                        const glm::dmat3& from_view, const glm::dvec3& towards_eye, const glm::dvec3& eye) {
    double sum = 0, sum_of_weights = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const VertexCurvature& vertex = curvature.at(triangle, k);
        if (!(weights[k] > 0) || vertex.normal == glm::vec3(0.0f)) continue;
        // A way x on the surface is from_view x in the object, and the normal n there is n from_view, but for its
        // length, by which the surface seems to turn less.
        const glm::dvec3 scaled = glm::dvec3(vertex.normal) * from_view;
        const double length = glm::length(scaled);
        if (!(length > 0)) continue;
        const glm::dvec3 normal = scaled / length;
        glm::dvec3 way = eye - normal * glm::dot(normal, eye);
        double square = glm::dot(way, way);
        if (!(square > 1e-12)) {
            // Straight from above all directions are as good: the one that the first axis has.
            const glm::dvec3 axis = std::abs(normal.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
            way = axis - normal * glm::dot(normal, axis);
            square = glm::dot(way, way);
        }
        const glm::dvec3 own_way = from_view * way;
        const double turn = glm::dot(own_way, vertex.matrix() * own_way) / (length * square);
        if (!std::isfinite(turn)) continue;
        sum += weights[k] * (glm::dot(normal, towards_eye) < 0 ? -turn : turn);
        sum_of_weights += weights[k];
    }
    const double result = sum_of_weights > 0 ? sum / sum_of_weights : 0;
    return std::abs(result) < kLargestTurn ? result : 0;
}

}  // namespace burin
