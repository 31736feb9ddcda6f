#include "mesh/duplicate_polygons.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "base/interrupt.h"

namespace burin {
namespace {

constexpr int kLongRing = 32;  // above, sorting beats comparing all pairs

/// Finds polygons with the same edges as an earlier one, whatever their winding and first corner.
class DuplicateFinder {
  public:
    DuplicateFinder(const PolygonMesh& polygons, const Mesh& mesh) : polygons_(polygons), mesh_(mesh) {}

    /// A duplicate shares all its edges with its twin, so only polygons around one of its edges
    /// need to be compared. The first half-edge of a polygon's first triangle is one of its edges.
    std::vector<std::uint32_t> find() {
        std::uint32_t previous = 0xFFFFFFFFu;
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            if ((t & 0xFFFF) == 0) throw_if_interrupted();
            const std::uint32_t p = mesh_.polygon_of(t);
            if (p != previous) compare_around(3 * t, p);
            previous = p;
        }
        std::sort(duplicates_.begin(), duplicates_.end());
        duplicates_.erase(std::unique(duplicates_.begin(), duplicates_.end()), duplicates_.end());
        return std::move(duplicates_);
    }

  private:
    using Edge = std::array<std::uint32_t, 2>;

    void compare_around(HalfEdge start, std::uint32_t p) {
        int length = 1;
        for (HalfEdge h = mesh_.next_on_edge[start]; h != start; h = mesh_.next_on_edge[h]) {
            if (++length > kLongRing) return compare_ring(start);
            const std::uint32_t q = mesh_.polygon_of(h / 3);
            if (q < p && polygon(p).size() == polygon(q).size() && key_of(p) == key_of(q) && same_edges(p, q)) {
                duplicates_.push_back(p);
                return;
            }
        }
    }

    void compare_ring(HalfEdge start) {
        if (compared_.empty()) compared_.assign(mesh_.next_on_edge.size(), false);
        if (compared_[start]) return;
        std::vector<std::pair<std::uint64_t, std::uint32_t>> ring;  // key, polygon
        HalfEdge h = start;
        do {
            compared_[h] = true;
            const std::uint32_t p = mesh_.polygon_of(h / 3);
            ring.emplace_back(key_of(p), p);
            h = mesh_.next_on_edge[h];
        } while (h != start);
        std::sort(ring.begin(), ring.end());
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
        for (std::size_t i = 0, first = 0; i < ring.size(); ++i) {
            if (ring[i].first != ring[first].first) first = i;
            // Two different polygons with one key are next to impossible: one comparison will do.
            if (i > first && same_edges(ring[i].second, ring[first].second)) {
                duplicates_.push_back(ring[i].second);
            }
        }
    }

    std::span<const std::uint32_t> polygon(std::uint32_t p) const {
        return mesh_.triangle_polygon.empty() ? std::span(mesh_.triangles[p]) : polygons_.polygon(p);
    }
    static std::uint64_t mix(std::uint64_t v) {
        v = (v ^ v >> 29) * 0xBF58476D1CE4E5B9u;
        return v ^ v >> 32;
    }
    /// Does not depend on winding and first corner.
    std::uint64_t key_of(std::uint32_t p) const {
        const auto corners = polygon(p);
        std::uint64_t key = corners.size();
        std::uint32_t u = corners.back();
        for (const std::uint32_t v : corners) {
            key += mix((std::uint64_t{std::min(u, v)} << 32 | std::max(u, v)) * 0x9E3779B97F4A7C15u);
            u = v;
        }
        return key;
    }
    std::vector<Edge> sorted_edges(std::uint32_t p) const {
        const auto corners = polygon(p);
        std::vector<Edge> edges;
        std::uint32_t u = corners.back();
        for (const std::uint32_t v : corners) {
            edges.push_back({std::min(u, v), std::max(u, v)});
            u = v;
        }
        std::sort(edges.begin(), edges.end());
        return edges;
    }
    bool same_edges(std::uint32_t p, std::uint32_t q) const { return sorted_edges(p) == sorted_edges(q); }

    const PolygonMesh& polygons_;
    const Mesh& mesh_;
    std::vector<std::uint32_t> duplicates_;
    std::vector<bool> compared_;  // per half-edge of a long ring; empty: there is none
};

/// Finds duplicates among triangles in short rings. Triangles on one edge are duplicates if their third vertices are
/// one. Returns false if there is a long ring.
bool find_duplicate_triangles(const Mesh& mesh, std::vector<std::uint32_t>& duplicates) {
    const auto vertices = [&](std::uint32_t t) {
        const auto& [a, b, c] = mesh.triangles[t];
        return a ^ b ^ c;
    };
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if ((t & 0xFFFF) == 0) throw_if_interrupted();
        const std::uint32_t own = vertices(t);
        bool is_duplicate = false;
        int length = 1;
        for (HalfEdge h = mesh.next_on_edge[3 * t]; h != 3 * t; h = mesh.next_on_edge[h]) {
            if (++length > kLongRing) return false;
            is_duplicate |= (h / 3 < t) & (vertices(h / 3) == own);
        }
        if (is_duplicate) duplicates.push_back(t);
    }
    return true;
}

}  // namespace

std::vector<std::uint32_t> find_duplicates(const PolygonMesh& polygons, const Mesh& mesh) {
    std::vector<std::uint32_t> duplicates;
    if (mesh.triangle_polygon.empty() && find_duplicate_triangles(mesh, duplicates)) return duplicates;
    return DuplicateFinder(polygons, mesh).find();
}

}  // namespace burin
