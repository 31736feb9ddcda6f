#include "mesh/marked_edges.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/error.h"

namespace burin {
namespace {

/// A mesh's marks, found by their vertices.
class MarkIndex {
  public:
    explicit MarkIndex(const std::vector<std::array<std::uint32_t, 2>>& marks) : is_met_(marks.size(), false) {
        for (std::uint32_t i = 0; i < marks.size(); ++i) keys_.push_back({key(marks[i][0], marks[i][1]), i});
        std::sort(keys_.begin(), keys_.end());
    }
    /// Whether the edge between two vertices is marked; if so, its marks count as met.
    bool meet(std::uint32_t a, std::uint32_t b) {
        const Vertices own = key(a, b);
        bool is_any = false;
        for (auto i = std::lower_bound(keys_.begin(), keys_.end(), Key{own, 0}); i != keys_.end() && i->first == own;
             ++i) {
            is_met_[i->second] = is_any = true;
        }
        return is_any;
    }
    std::vector<bool> take_met() { return std::move(is_met_); }

  private:
    using Vertices = std::pair<std::uint32_t, std::uint32_t>;
    using Key = std::pair<Vertices, std::uint32_t>;
    static Vertices key(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

    std::vector<Key> keys_;
    std::vector<bool> is_met_;
};

}  // namespace

MarkedEdges::MarkedEdges(const PolygonSoup& soup, const std::vector<std::uint32_t>& welded) {
    for (std::size_t i = 0; i < soup.marked_edges.size(); ++i) {
        const std::uint32_t u = welded[soup.marked_edges[i][0]], v = welded[soup.marked_edges[i][1]];
        if (u != v) marks_.push_back({{std::min(u, v), std::max(u, v)}, soup.object_of_mark(i)});
    }
    std::sort(marks_.begin(), marks_.end());
    marks_.erase(std::unique(marks_.begin(), marks_.end()), marks_.end());
    is_of_polygon_.assign(marks_.size(), false);
}

std::size_t MarkedEdges::first_from(std::uint32_t vertex) const {
    const auto it = std::lower_bound(marks_.begin(), marks_.end(), vertex,
                                     [](const Mark& m, std::uint32_t v) { return m.vertices[0] < v; });
    return static_cast<std::size_t>(it - marks_.begin());
}

std::vector<MarkedEdges::Mark> MarkedEdges::loose_edges() const {
    std::vector<Mark> loose;
    for (std::size_t i = 0; i < marks_.size(); ++i) {
        if (!is_of_polygon_[i]) loose.push_back(marks_[i]);
    }
    std::stable_sort(loose.begin(), loose.end(), [](const Mark& a, const Mark& b) { return a.object < b.object; });
    return loose;
}

void add_loose_edges(std::span<const MarkedEdges::Mark> edges, const RoundedPositions& rounded, Mesh& mesh,
                     MovingVertices* moving) {
    constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    using Place = std::array<float, 6>;  // position and residual
    struct Vertex {
        Place place;
        std::uint32_t kind;  // those that move otherwise are others
        std::uint32_t in_mesh;
        auto key() const { return std::pair(place, kind); }
    };
    const auto kind_of = [&](std::uint32_t v) { return moving == nullptr ? 0 : moving->kinds[v]; };
    const auto place_of = [](const auto& vertices, std::size_t v) {
        const glm::vec3 p = vertices.positions[v],
                        r = vertices.residuals.empty() ? glm::vec3(0) : vertices.residuals[v];
        return Place{p.x, p.y, p.z, r.x, r.y, r.z};
    };
    const bool keeps_residuals = !rounded.residuals.empty() && (mesh.positions.empty() || mesh.has_residuals());
    std::vector<Vertex> vertices;  // by place
    for (const MarkedEdges::Mark& edge : edges) {
        for (const std::uint32_t v : edge.vertices) vertices.push_back({place_of(rounded, v), kind_of(v), kNone});
    }
    std::sort(vertices.begin(), vertices.end(), [](const Vertex& a, const Vertex& b) { return a.key() < b.key(); });
    const auto is_same = [](const Vertex& a, const Vertex& b) { return a.key() == b.key(); };
    vertices.erase(std::unique(vertices.begin(), vertices.end(), is_same), vertices.end());
    const auto find = [&](const Place& place, std::uint32_t kind) {
        const std::pair key(place, kind);
        const auto it = std::lower_bound(vertices.begin(), vertices.end(), key,
                                         [](const Vertex& v, const auto& k) { return v.key() < k; });
        return it != vertices.end() && it->key() == key ? &*it : nullptr;
    };
    // What is subdivided stands elsewhere in each frame.
    const bool has_subdivided = moving != nullptr && moving->control.polygon_count() > 0;
    for (std::uint32_t v = 0; v < mesh.positions.size() && !has_subdivided; ++v) {
        const std::uint32_t kind = moving == nullptr ? 0 : moving->kinds[moving->sources[v]];
        if (Vertex* const known = find(place_of(mesh, v), kind)) known->in_mesh = v;
    }
    for (const MarkedEdges::Mark& edge : edges) {
        std::array<std::uint32_t, 2>& ends = mesh.loose_edges.emplace_back();
        for (std::size_t end = 0; end < 2; ++end) {
            const std::uint32_t v = edge.vertices[end];
            Vertex& vertex = *find(place_of(rounded, v), kind_of(v));
            if (vertex.in_mesh == kNone) {
                vertex.in_mesh = static_cast<std::uint32_t>(mesh.positions.size());
                mesh.positions.push_back(rounded.positions[v]);
                if (keeps_residuals) mesh.residuals.push_back(rounded.residuals[v]);
                if (moving != nullptr) moving->sources.push_back(v);
            }
            ends[end] = vertex.in_mesh;
        }
    }
    if (3 * mesh.triangles.size() + mesh.loose_edges.size() >= kNoHalfEdge) {
        throw InputError("object '" + mesh.name + "': more than 4 billion edges and lines; split the model");
    }
}

std::vector<bool> marks_of_polygons(const PolygonMesh& polygons) {
    MarkIndex index(polygons.marked_edges);
    for (std::size_t i = 0; i < polygons.polygon_count(); ++i) {
        const std::span<const std::uint32_t> polygon = polygons.polygon(i);
        for (std::size_t k = 0; k < polygon.size(); ++k)
            index.meet(polygon[k], polygon[k + 1 == polygon.size() ? 0 : k + 1]);
    }
    return index.take_met();
}

std::vector<bool> mark_half_edges(const PolygonMesh& polygons, Mesh& mesh) {
    if (polygons.marked_edges.empty()) return {};
    MarkIndex index(polygons.marked_edges);
    mesh.marked.assign(3 * mesh.triangles.size(), false);
    for (HalfEdge h = 0; h < mesh.marked.size(); ++h) {
        const auto& t = mesh.triangles[h / 3];
        mesh.marked[h] = index.meet(t[h % 3], t[(h + 1) % 3]);
    }
    return index.take_met();
}

}  // namespace burin
