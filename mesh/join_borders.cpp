#include "mesh/join_borders.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "base/interrupt.h"
#include "mesh/edge_links.h"

namespace burin {
namespace {

/// Of a triangle's normals before and after.
constexpr double kCosLargestTurn = 0.5;
constexpr std::uint32_t kNone = 0xFFFFFFFFu;

using Segment = BorderIndex::Segment;

/// Two borders that are to be one: which vertices become one.
struct Crack {
    double width;
    std::array<glm::vec3, 4> place;  // tells cracks of one width apart
    std::array<std::pair<std::uint32_t, std::uint32_t>, 2> joins;
};

bool is_less(const glm::vec3& p, const glm::vec3& q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); }

bool is_before(const Crack& a, const Crack& b) {
    if (a.width != b.width) return a.width < b.width;
    for (std::size_t i = 0; i < a.place.size(); ++i) {
        const glm::vec3 &p = a.place[i], &q = b.place[i];
        if (p != q) return is_less(p, q);
    }
    return a.joins < b.joins;
}

/// All that are narrow enough, the narrowest first.
std::vector<Crack> find_cracks(const CrackSides& sides) {
    std::vector<Crack> cracks;
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < sides.segments().size(); ++i) {
        if ((i & 0xFFF) == 0) throw_if_interrupted();
        const double widest = sides.widest(i, sides.length(i));
        if (!(widest > 0)) continue;
        const Segment& s = sides.segments()[i];
        near.clear();
        sides.mesh().borders.find_in_box(glm::dvec3(s.a) - widest, glm::dvec3(s.a) + widest, near);
        for (const std::uint32_t j : near) {
            if (j <= i) continue;
            const Segment& t = sides.segments()[j];
            const auto apart = [](const glm::vec3& p, const glm::vec3& q) { return glm::distance(glm::dvec3(p), glm::dvec3(q)); };
            const double opposite = std::max(apart(s.a, t.b), apart(s.b, t.a));
            const double along = std::max(apart(s.a, t.a), apart(s.b, t.b));
            Crack crack;
            crack.width = std::min(opposite, along);
            if (crack.width > std::min(widest, sides.widest(j, sides.length(j))) || !sides.are_beside(i, j)) continue;
            crack.place = {s.a, s.b, t.a, t.b};
            if (is_less(t.a, s.a) || (t.a == s.a && is_less(t.b, s.b))) crack.place = {t.a, t.b, s.a, s.b};
            const auto [sa, sb] = sides.ends(i);
            const auto [ta, tb] = sides.ends(j);
            crack.joins = {std::pair(sa, opposite <= along ? tb : ta), std::pair(sb, opposite <= along ? ta : tb)};
            cracks.push_back(crack);
        }
    }
    std::sort(cracks.begin(), cracks.end(), is_before);
    return cracks;
}

/// Sets of vertices that become one. Vertices are numbered anew: those of cracks only.
class Clusters {
  public:
    Clusters(const Mesh& mesh, const std::vector<Crack>& cracks) : mesh_(mesh), number_(mesh.positions.size(), kNone) {
        for (const Crack& crack : cracks) {
            for (const auto& [u, v] : crack.joins) {
                for (const std::uint32_t vertex : {u, v}) {
                    if (number_[vertex] != kNone) continue;
                    number_[vertex] = static_cast<std::uint32_t>(vertices_.size());
                    vertices_.push_back(vertex);
                }
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

    /// Unless a triangle would collapse, or the cluster get larger than `largest`.
    void join(const Crack& crack, double largest) {
        const auto may_join = [&](const auto& join) { return this->may_join(cluster_of(join.first), cluster_of(join.second), largest); };
        if (!may_join(crack.joins[0]) || !may_join(crack.joins[1])) return;
        for (const auto& [u, v] : crack.joins) unite(cluster_of(u), cluster_of(v));
    }

    /// Positions of all vertices once clusters are one each.
    std::vector<glm::vec3> positions() const {
        std::vector<glm::vec3> result = mesh_.positions;
        std::vector<glm::vec3> places;
        for (const auto& members : members_) {
            if (members.size() < 2) continue;
            places.clear();
            for (const std::uint32_t m : members) places.push_back(place(m));
            // The order must not depend on the triangles'.
            std::sort(places.begin(), places.end(), is_less);
            glm::dvec3 sum(0.0);
            for (const glm::vec3& p : places) sum += glm::dvec3(p);
            const glm::vec3 middle(sum / static_cast<double>(places.size()));
            for (const std::uint32_t m : members) result[vertices_[m]] = middle;
        }
        return result;
    }

    /// Lets clusters fall apart where triangles turn too far. Whether there were any.
    bool undo_turned(const std::vector<glm::vec3>& moved) {
        std::vector<std::uint32_t> undone;
        for (const auto& members : members_) {
            if (members.size() < 2) continue;
            const auto turns = [&](std::uint32_t m) {
                return std::any_of(triangles_[m].begin(), triangles_[m].end(), [&](std::uint32_t t) {
                    const glm::dvec3 before = area_of(mesh_.positions, t), after = area_of(moved, t);
                    return glm::dot(before, after) < kCosLargestTurn * glm::length(before) * glm::length(after);
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
    std::uint32_t stand_in(std::uint32_t vertex) const {
        return number_[vertex] == kNone ? vertex : vertices_[members_[cluster_of(vertex)].front()];
    }

  private:
    std::uint32_t cluster_of(std::uint32_t vertex) const { return cluster_[number_[vertex]]; }
    glm::vec3 place(std::uint32_t number) const { return mesh_.positions[vertices_[number]]; }
    glm::dvec3 area_of(const std::vector<glm::vec3>& positions, std::uint32_t triangle) const {
        const auto& t = mesh_.triangles[triangle];
        const glm::dvec3 a(positions[t[0]]);
        return glm::cross(glm::dvec3(positions[t[1]]) - a, glm::dvec3(positions[t[2]]) - a);
    }

    bool may_join(std::uint32_t a, std::uint32_t b, double largest) const {
        if (a == b) return true;
        for (const std::uint32_t m : members_[a]) {
            for (const std::uint32_t n : members_[b]) {
                if (glm::distance(glm::dvec3(place(m)), glm::dvec3(place(n))) > largest) return false;
            }
            for (const std::uint32_t t : triangles_[m]) {
                for (const std::uint32_t vertex : mesh_.triangles[t]) {
                    if (number_[vertex] != kNone && cluster_of(vertex) == b) return false;
                }
            }
        }
        return true;
    }
    void unite(std::uint32_t a, std::uint32_t b) {
        if (a == b) return;
        if (members_[a].size() < members_[b].size()) std::swap(a, b);
        for (const std::uint32_t m : members_[b]) cluster_[m] = a;
        members_[a].insert(members_[a].end(), members_[b].begin(), members_[b].end());
        members_[b].clear();
    }

    const Mesh& mesh_;
    std::vector<std::uint32_t> number_;    // per vertex of the mesh
    std::vector<std::uint32_t> vertices_;  // the other way round
    std::vector<std::uint32_t> cluster_;
    std::vector<std::vector<std::uint32_t>> members_;    // per cluster
    std::vector<std::vector<std::uint32_t>> triangles_;  // per vertex
};

/// The same mark on all half-edges of an edge.
void spread_marks(Mesh& mesh) {
    for (HalfEdge h = 0; h < mesh.marked.size(); ++h) {
        if (!mesh.marked[h]) continue;
        for (HalfEdge g = mesh.next_on_edge[h]; g != h; g = mesh.next_on_edge[g]) mesh.marked[g] = true;
    }
}

}  // namespace

std::optional<Mesh> join_borders(const Mesh& mesh, const CrackReach& reach) {
    const std::vector<Crack> cracks = find_cracks(CrackSides(mesh, reach));
    if (cracks.empty()) return std::nullopt;
    Clusters clusters(mesh, cracks);
    for (const Crack& crack : cracks) clusters.join(crack, reach(glm::dvec3(crack.place[0])));
    std::vector<glm::vec3> positions = clusters.positions();
    while (clusters.undo_turned(positions)) positions = clusters.positions();
    Mesh result;
    result.name = mesh.name;
    result.origin = mesh.origin;
    result.positions = std::move(positions);
    result.triangles = mesh.triangles;
    for (auto& triangle : result.triangles) {
        for (std::uint32_t& vertex : triangle) vertex = clusters.stand_in(vertex);
    }
    result.triangle_polygon = mesh.triangle_polygon;
    result.polygon_count = mesh.polygon_count;
    result.polygon_normals = mesh.polygon_normals;
    result.polygon_material = mesh.polygon_material;
    result.next_on_edge = link_edges(result.triangles, result.positions.size());
    result.marked = mesh.marked;
    spread_marks(result);
    result.borders = index_borders(result);
    result.repairs = mesh.repairs;
    return result;
}

}  // namespace burin
