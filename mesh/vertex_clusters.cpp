#include "mesh/vertex_clusters.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include "mesh/edge_links.h"
#include "mesh/residuals.h"

namespace burin {
namespace {

/// The least cosine between a triangle's normals before and after.
constexpr double kCosLargestTurn = 0.5;
/// The end of a needle: in parts of its next longer edge, and of what its corners are moved by.
constexpr double kNeedleEndPart = 1.0 / 3, kNeedleMoves = 4;
constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// Marks all half-edges of an edge if one is marked.
void spread_marks(Mesh& mesh) {
    for (HalfEdge h = 0; h < mesh.marked.size(); ++h) {
        if (!mesh.marked[h]) continue;
        for (HalfEdge g = mesh.next_on_edge[h]; g != h; g = mesh.next_on_edge[g]) mesh.marked[g] = true;
    }
}

}  // namespace

bool is_less(const glm::dvec3& p, const glm::dvec3& q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); }

VertexClusters::VertexClusters(const Mesh& mesh, std::span<const Pair> pairs)
    : mesh_(mesh), number_(mesh.positions.size(), kNone) {
    given_.reserve(mesh.positions.size());
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) given_.push_back(mesh.local_position(v));
    for (const auto& [u, v] : pairs) {
        for (const std::uint32_t vertex : {u, v}) {
            if (number_[vertex] != kNone) continue;
            number_[vertex] = static_cast<std::uint32_t>(vertices_.size());
            vertices_.push_back(vertex);
        }
    }
    const std::size_t count = vertices_.size();
    cluster_.resize(count);
    members_.resize(count);
    triangles_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        cluster_[i] = i;
        members_[i].push_back(i);
    }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t vertex : mesh.triangles[t]) {
            if (number_[vertex] != kNone) triangles_[number_[vertex]].push_back(t);
        }
    }
}

bool VertexClusters::may_join(Pair pair, double largest, bool may_collapse) const {
    const std::uint32_t a = cluster_of(pair.first), b = cluster_of(pair.second);
    if (a == b) return true;
    for (const std::uint32_t m : members_[a]) {
        for (const std::uint32_t n : members_[b]) {
            if (glm::distance(place(m), place(n)) > largest) return false;
        }
        if (may_collapse) continue;
        for (const std::uint32_t t : triangles_[m]) {
            for (const std::uint32_t vertex : mesh_.triangles[t]) {
                if (number_[vertex] != kNone && cluster_of(vertex) == b) return false;
            }
        }
    }
    return true;
}

void VertexClusters::join(Pair pair) {
    std::uint32_t a = cluster_of(pair.first), b = cluster_of(pair.second);
    if (a == b) return;
    if (members_[a].size() < members_[b].size()) std::swap(a, b);
    for (const std::uint32_t m : members_[b]) cluster_[m] = a;
    members_[a].insert(members_[a].end(), members_[b].begin(), members_[b].end());
    members_[b].clear();
}

/// The positions of all vertices once each cluster is one.
VertexClusters::Positions VertexClusters::positions() const {
    Positions result = given_, places;
    for (const auto& members : members_) {
        if (members.size() < 2) continue;
        places.clear();
        for (const std::uint32_t m : members) places.push_back(place(m));
        std::sort(places.begin(), places.end(), is_less);  // sums depend on the order
        glm::dvec3 sum(0.0);
        for (const glm::dvec3& p : places) sum += p;
        glm::dvec3 middle = sum / static_cast<double>(places.size());
        if (!mesh_.has_residuals()) middle = glm::dvec3(glm::vec3(middle));
        for (const std::uint32_t m : members) result[vertices_[m]] = middle;
    }
    return result;
}

glm::dvec3 VertexClusters::area_of(const Positions& positions, std::uint32_t triangle) const {
    const auto& t = mesh_.triangles[triangle];
    const glm::dvec3 a = positions[t[0]];
    return glm::cross(positions[t[1]] - a, positions[t[2]] - a);
}

/// Whether a triangle is a needle whose end is about as short as what its corners are moved by: then its normal says
/// nothing.
bool VertexClusters::is_needle(const Positions& moved, std::uint32_t triangle) const {
    const auto& t = mesh_.triangles[triangle];
    std::array<double, 3> lengths{};
    double farthest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 p = given_[t[k]], next = given_[t[(k + 1) % 3]];
        lengths[k] = glm::distance(p, next);
        farthest = std::max(farthest, glm::distance(p, moved[t[k]]));
    }
    std::sort(lengths.begin(), lengths.end());
    return lengths[0] <= kNeedleMoves * farthest && lengths[0] <= kNeedleEndPart * lengths[1];
}

/// Lets clusters fall apart where triangles turn too far, and says whether there were any.
bool VertexClusters::undo_turned(const Positions& moved) {
    std::vector<std::uint32_t> undone;
    for (const auto& members : members_) {
        if (members.size() < 2) continue;
        const auto turns = [&](std::uint32_t m) {
            return std::any_of(triangles_[m].begin(), triangles_[m].end(), [&](std::uint32_t t) {
                const glm::dvec3 before = area_of(given_, t), after = area_of(moved, t);
                return glm::dot(before, after) < kCosLargestTurn * glm::length(before) * glm::length(after) &&
                       !is_needle(moved, t);
            });
        };
        if (std::any_of(members.begin(), members.end(), turns)) undone.push_back(cluster_[members.front()]);
    }
    for (const std::uint32_t cluster : undone) {
        const std::vector<std::uint32_t> members = std::move(members_[cluster]);
        for (const std::uint32_t m : members) {
            cluster_[m] = m;
            members_[m] = {m};
        }
    }
    return !undone.empty();
}

/// The vertex that stands for a vertex: the first of its cluster.
std::uint32_t VertexClusters::stand_in(std::uint32_t vertex) const {
    return number_[vertex] == kNone ? vertex : vertices_[members_[cluster_of(vertex)].front()];
}

Mesh VertexClusters::merge() {
    Positions moved = positions();
    while (undo_turned(moved)) moved = positions();
    const auto corners_of = [&](std::uint32_t t) {
        const auto& [a, b, c] = mesh_.triangles[t];
        return std::array{stand_in(a), stand_in(b), stand_in(c)};
    };
    const auto has_collapsed = [](const std::array<std::uint32_t, 3>& c) {
        return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
    };
    Mesh result = with_polygons_of(mesh_);
    result.positions.reserve(moved.size());
    for (const glm::dvec3& p : moved) add_position(result, p, mesh_.has_residuals());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        const std::array<std::uint32_t, 3> corners = corners_of(t);
        if (has_collapsed(corners)) continue;
        result.triangles.push_back(corners);
        result.triangle_polygon.push_back(mesh_.polygon_of(t));
        for (std::size_t i = 0; i < result.attributes.size(); ++i) {
            const auto own = mesh_.attributes[i].rows.begin() + 3 * static_cast<std::ptrdiff_t>(t);
            result.attributes[i].rows.insert(result.attributes[i].rows.end(), own, own + 3);
        }
        if (mesh_.marked.empty()) continue;
        for (HalfEdge k = 0; k < 3; ++k) result.marked.push_back(mesh_.marked[3 * t + k]);
    }
    // Where every polygon is still its triangle, that says best where it lies now.
    if (mesh_.polygon_normals.empty() && result.triangles.size() == mesh_.triangles.size()) {
        result.polygon_normals.clear();
        result.triangle_polygon.clear();
    }
    for (auto& edge : result.loose_edges) edge = {stand_in(edge[0]), stand_in(edge[1])};
    result.next_on_edge = link_edges(result.triangles, result.positions.size());
    spread_marks(result);
    result.borders = index_borders(result);
    return result;
}

Mesh with_polygons_of(const Mesh& mesh) {
    Mesh result;
    result.name = mesh.name;
    result.origin = mesh.origin;
    result.polygon_count = mesh.polygon_count;
    result.input_order = mesh.input_order;
    result.polygon_material = mesh.polygon_material;
    result.repairs = mesh.repairs;
    result.loose_edges = mesh.loose_edges;
    for (const AttributeLayer& layer : mesh.attributes)
        result.attributes.push_back({layer.kind, layer.name, layer.values, {}});
    result.polygon_normals = mesh.polygon_normals;
    if (!result.polygon_normals.empty()) return result;
    result.polygon_normals.reserve(mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::dvec3 normal = mesh.polygon_area_vector(t);
        const double length = glm::length(normal);
        result.polygon_normals.emplace_back(length > 0 ? normal / length : normal);
    }
    return result;
}

}  // namespace burin
