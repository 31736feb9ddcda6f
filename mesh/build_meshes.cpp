#include "mesh/build_meshes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/interrupt.h"
#include "mesh/edge_links.h"
#include "mesh/triangulate.h"

namespace burin {
namespace {

/// Where to put 0 so that single precision resolves the model: its centre if the model lies more
/// than 16 of its own half sizes away from 0, else 0 itself (and coordinates keep their values).
/// Vertices that no polygon uses, such as a stray one at 0, do not count.
glm::dvec3 choose_origin(const PolygonSoup& soup) {
    if (soup.corners.empty()) return glm::dvec3(0.0);
    glm::dvec3 low = soup.positions[soup.corners[0]], high = low;
    for (const std::uint32_t v : soup.corners) {
        const glm::dvec3& p = soup.positions[v];
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 center = 0.5 * (low + high);
    const glm::dvec3 half = 0.5 * (high - low);
    const double distance = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
    return distance > 16 * std::max({half.x, half.y, half.z}) ? center : glm::dvec3(0.0);
}

/// For every vertex the number of the first vertex with equal coordinates.
class VertexWelder {
  public:
    explicit VertexWelder(const std::vector<glm::vec3>& positions) : positions_(positions) {
        table_.assign(std::bit_ceil(std::max<std::size_t>(16, 2 * positions.size())), kEmpty);
        first_.resize(positions.size());
        for (std::uint32_t i = 0; i < positions.size(); ++i) first_[i] = find_or_insert(i);
    }
    std::vector<std::uint32_t> take() { return std::move(first_); }

  private:
    static constexpr std::uint32_t kEmpty = 0xFFFFFFFFu;

    std::uint32_t find_or_insert(std::uint32_t i) {
        const glm::vec3 p = positions_[i];
        std::size_t slot = hash(p) & (table_.size() - 1);
        while (table_[slot] != kEmpty) {
            if (positions_[table_[slot]] == p) return table_[slot];
            slot = (slot + 1) & (table_.size() - 1);
        }
        table_[slot] = i;
        return i;
    }
    static std::size_t hash(const glm::vec3& p) {
        const std::uint64_t xy = std::uint64_t{std::bit_cast<std::uint32_t>(p.x)} << 32 |
                                 std::bit_cast<std::uint32_t>(p.y);
        std::uint64_t h = xy * 0x9E3779B97F4A7C15u;
        h = (h ^ h >> 32 ^ std::bit_cast<std::uint32_t>(p.z)) * 0xD6E8FEB86659FD93u;
        return static_cast<std::size_t>(h ^ h >> 32);
    }

    const std::vector<glm::vec3>& positions_;
    std::vector<std::uint32_t> table_;
    std::vector<std::uint32_t> first_;
};

/// Polygons of the soup, object by object, in their order.
struct PolygonsByObject {
    std::vector<std::uint32_t> order;  ///< empty: one object, in the soup's order
    std::vector<std::size_t> end;      ///< per object
};

PolygonsByObject group_by_object(const PolygonSoup& soup) {
    PolygonsByObject groups;
    const std::size_t objects = std::max<std::size_t>(1, soup.object_names.size());
    groups.end.assign(objects, 0);
    if (soup.polygon_object.empty()) {
        groups.end[0] = soup.polygon_count();
        return groups;
    }
    for (const std::uint32_t object : soup.polygon_object) ++groups.end[object];
    std::size_t sum = 0;
    for (std::size_t& end : groups.end) end = std::exchange(sum, sum + end);
    groups.order.resize(soup.polygon_count());
    for (std::uint32_t i = 0; i < groups.order.size(); ++i) {
        groups.order[groups.end[soup.polygon_object[i]]++] = i;
    }
    return groups;
}

/// A normal to any three corners that do not lie on one line; 0 if all do.
glm::dvec3 normal_of_any_corners(std::span<const glm::dvec3> corners) {
    glm::dvec3 along(0.0);
    for (const glm::dvec3& corner : corners.subspan(1)) {
        const glm::dvec3 d = corner - corners[0];
        if (along == glm::dvec3(0.0)) {
            along = d;
        } else if (const glm::dvec3 normal = glm::cross(along, d); normal != glm::dvec3(0.0)) {
            return normal;
        }
    }
    return glm::dvec3(0.0);
}

/// Collects one object's polygons: own vertex numbers, nothing repeated, nothing without area.
class ObjectCollector {
  public:
    ObjectCollector(const PolygonSoup& soup, const std::vector<glm::vec3>& positions,
                    const std::vector<std::uint32_t>& welded)
        : soup_(soup), positions_(positions), welded_(welded), local_(positions.size(), kUnused),
          is_corner_(positions.size(), false), is_welded_corner_(positions.size(), false) {
        for (const auto& [a, b] : soup.marked_edges) {
            const std::uint32_t u = welded[a], v = welded[b];
            if (u != v) marks_.push_back({std::min(u, v), std::max(u, v)});
        }
        std::sort(marks_.begin(), marks_.end());
    }

    PolygonMesh collect(const PolygonsByObject& groups, std::size_t begin, std::size_t end,
                        MeshRepairs& repairs) {
        PolygonMesh mesh;
        mesh.corners.reserve(3 * (end - begin));
        for (std::size_t i = begin; i < end; ++i) {
            if ((i & 0xFFFF) == 0) throw_if_interrupted();
            const std::size_t polygon = groups.order.empty() ? i : groups.order[i];
            collapse(soup_.polygon(polygon), repairs);
            if (corners_.size() < 3 || has_no_area()) {
                ++repairs.degenerate_polygons;
                continue;
            }
            for (const std::uint32_t v : corners_) mesh.corners.push_back(local_number(v, mesh));
            if (corners_.size() != 3 && mesh.ends.empty()) {
                // The first polygon that is no triangle: list the ends of those before it.
                for (std::size_t e = 3; e + corners_.size() <= mesh.corners.size(); e += 3) {
                    mesh.ends.push_back(static_cast<std::uint32_t>(e));
                }
                mesh.ends.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
            } else if (!mesh.ends.empty()) {
                mesh.ends.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
            }
            if (!soup_.polygon_material.empty()) {
                mesh.polygon_material.push_back(soup_.material_of(polygon));
            }
        }
        add_marks(mesh);
        repairs.welded_vertices = corners_seen_ - welded_corners_seen_;
        forget(groups, begin, end);
        return mesh;
    }

  private:
    static constexpr std::uint32_t kUnused = 0xFFFFFFFFu;

    /// The polygon's welded corners, without repetitions in a row and spikes, into corners_.
    void collapse(std::span<const std::uint32_t> corners, MeshRepairs& repairs) {
        ++repairs.input_polygons;
        if (corners.size() > 2) repairs.input_triangles += corners.size() - 2;
        corners_.clear();
        for (const std::uint32_t corner : corners) {
            const std::uint32_t v = welded_[corner];
            if (!is_corner_[corner]) {
                is_corner_[corner] = true;
                ++corners_seen_;
                welded_corners_seen_ += !is_welded_corner_[v];
                is_welded_corner_[v] = true;
            }
            const std::size_t n = corners_.size();
            if (n > 0 && corners_[n - 1] == v) continue;
            if (n > 1 && corners_[n - 2] == v) {
                corners_.pop_back();  // there and back: a spike
            } else {
                corners_.push_back(v);
            }
        }
        // The same where the end meets the start.
        std::size_t first = 0, end = corners_.size();
        while (end - first > 1) {
            if (corners_[first] == corners_[end - 1] || corners_[first + 1] == corners_[end - 1]) {
                first += corners_[first] != corners_[end - 1];
                --end;
            } else if (corners_[first] == corners_[end - 2]) {
                --end;
            } else {
                break;
            }
        }
        corners_.resize(end);
        corners_.erase(corners_.begin(), corners_.begin() + static_cast<std::ptrdiff_t>(first));
    }

    /// The marks between vertices of the object.
    void add_marks(PolygonMesh& mesh) const {
        if (marks_.empty()) return;
        for (const std::uint32_t u : used_) {
            const std::array<std::uint32_t, 2> first{u, u + 1};
            for (auto it = std::lower_bound(marks_.begin(), marks_.end(), first);
                 it != marks_.end() && (*it)[0] == u; ++it) {
                const std::uint32_t v = local_[(*it)[1]];
                if (v != kUnused) mesh.marked_edges.push_back({local_[u], v});
            }
        }
    }

    /// Makes ready for the next object.
    void forget(const PolygonsByObject& groups, std::size_t begin, std::size_t end) {
        for (const std::uint32_t v : used_) local_[v] = kUnused;
        used_.clear();
        corners_seen_ = welded_corners_seen_ = 0;
        if (groups.order.empty()) return;  // there is no other object
        for (std::size_t i = begin; i < end; ++i) {
            for (const std::uint32_t corner : soup_.polygon(groups.order[i])) {
                is_corner_[corner] = false;
                is_welded_corner_[welded_[corner]] = false;
            }
        }
    }

    bool has_no_area() {
        places_.clear();
        for (const std::uint32_t v : corners_) places_.emplace_back(positions_[v]);
        return normal_of_any_corners(places_) == glm::dvec3(0.0);
    }

    std::uint32_t local_number(std::uint32_t v, PolygonMesh& mesh) {
        if (local_[v] == kUnused) {
            local_[v] = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.push_back(positions_[v]);
            used_.push_back(v);
        }
        return local_[v];
    }

    const PolygonSoup& soup_;
    const std::vector<glm::vec3>& positions_;
    const std::vector<std::uint32_t>& welded_;
    std::vector<std::uint32_t> local_;  // per soup vertex: its number in the object
    std::vector<std::uint32_t> used_;
    // Per soup vertex, whether a polygon of the object has it as a corner, before and after welding.
    std::vector<bool> is_corner_, is_welded_corner_;
    std::uint64_t corners_seen_ = 0, welded_corners_seen_ = 0;
    std::vector<std::array<std::uint32_t, 2>> marks_;  // welded, smaller vertex first, sorted
    std::vector<std::uint32_t> corners_;
    std::vector<glm::dvec3> places_;  // of corners_
};

/// Triangles, their polygons, and the polygons' normals.
void triangulate_into(const PolygonMesh& polygons, Mesh& mesh) {
    mesh.polygon_count = static_cast<std::uint32_t>(polygons.polygon_count());
    if (3 * (polygons.corners.size() - 2 * polygons.polygon_count()) >= kNoHalfEdge) {
        throw InputError("object '" + mesh.name + "': more than 1.4 billion triangles; split the model");
    }
    mesh.triangles.clear();
    mesh.triangle_polygon.clear();
    mesh.polygon_normals.clear();
    if (polygons.ends.empty()) {
        mesh.triangles.resize(polygons.polygon_count());
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const std::uint32_t* const c = &polygons.corners[3 * t];
            mesh.triangles[t] = {c[0], c[1], c[2]};
        }
        return;
    }
    std::vector<glm::dvec3> corners;
    std::vector<std::array<std::uint32_t, 3>> pieces;
    for (std::uint32_t i = 0; i < mesh.polygon_count; ++i) {
        if ((i & 0xFFFF) == 0) throw_if_interrupted();
        const std::span<const std::uint32_t> polygon = polygons.polygon(i);
        corners.clear();
        for (const std::uint32_t v : polygon) corners.emplace_back(polygons.positions[v]);
        pieces.clear();
        triangulate_polygon(corners, pieces);
        for (const auto& [a, b, c] : pieces) {
            mesh.triangles.push_back({polygon[a], polygon[b], polygon[c]});
            mesh.triangle_polygon.push_back(i);
        }
        glm::dvec3 normal = area_vector(corners);
        if (normal == glm::dvec3(0.0)) normal = normal_of_any_corners(corners);  // a figure of eight
        const double length = glm::length(normal);
        mesh.polygon_normals.emplace_back(length > 0 ? normal / length : normal);
    }
}

/// Finds polygons with the same edges as an earlier one, whatever their winding and first corner.
class DuplicateFinder {
  public:
    DuplicateFinder(const PolygonMesh& polygons, const Mesh& mesh) : polygons_(polygons), mesh_(mesh) {}

    /// A duplicate shares all its edges with its twin, so only polygons around one of its edges need
    /// to be compared. The first half-edge of a polygon's first triangle is one of its edges.
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
        constexpr int kLongRing = 32;  // above, sorting beats comparing all pairs
        int length = 1;
        for (HalfEdge h = mesh_.next_on_edge[start]; h != start; h = mesh_.next_on_edge[h]) {
            if (++length > kLongRing) return compare_ring(start);
            const std::uint32_t q = mesh_.polygon_of(h / 3);
            if (q < p && polygons_.polygon(p).size() == polygons_.polygon(q).size() &&
                key_of(p) == key_of(q) && same_edges(p, q)) {
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

    static std::uint64_t mix(std::uint64_t v) {
        v = (v ^ v >> 29) * 0xBF58476D1CE4E5B9u;
        return v ^ v >> 32;
    }
    /// Does not depend on winding and first corner.
    std::uint64_t key_of(std::uint32_t p) const {
        const auto corners = polygons_.polygon(p);
        std::uint64_t key = corners.size();
        std::uint32_t u = corners.back();
        for (const std::uint32_t v : corners) {
            key += mix((std::uint64_t{std::min(u, v)} << 32 | std::max(u, v)) * 0x9E3779B97F4A7C15u);
            u = v;
        }
        return key;
    }
    std::vector<Edge> sorted_edges(std::uint32_t p) const {
        const auto corners = polygons_.polygon(p);
        std::vector<Edge> edges;
        std::uint32_t u = corners.back();
        for (const std::uint32_t v : corners) {
            edges.push_back({std::min(u, v), std::max(u, v)});
            u = v;
        }
        std::sort(edges.begin(), edges.end());
        return edges;
    }
    bool same_edges(std::uint32_t p, std::uint32_t q) const {
        return sorted_edges(p) == sorted_edges(q);
    }

    const PolygonMesh& polygons_;
    const Mesh& mesh_;
    std::vector<std::uint32_t> duplicates_;
    std::vector<bool> compared_;  // per half-edge of a long ring; empty: there is none
};

PolygonMesh without(const PolygonMesh& mesh, const std::vector<std::uint32_t>& dropped) {
    PolygonMesh result;
    result.positions = mesh.positions;
    result.marked_edges = mesh.marked_edges;
    auto next_dropped = dropped.begin();
    for (std::uint32_t i = 0; i < mesh.polygon_count(); ++i) {
        if (next_dropped != dropped.end() && *next_dropped == i) {
            ++next_dropped;
            continue;
        }
        const auto polygon = mesh.polygon(i);
        result.corners.insert(result.corners.end(), polygon.begin(), polygon.end());
        if (!mesh.ends.empty()) {
            result.ends.push_back(static_cast<std::uint32_t>(result.corners.size()));
        }
        if (!mesh.polygon_material.empty()) {
            result.polygon_material.push_back(mesh.polygon_material[i]);
        }
    }
    return result;
}

void mark_edges(const PolygonMesh& polygons, Mesh& mesh) {
    if (polygons.marked_edges.empty()) return;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& [a, b] : polygons.marked_edges) edges.emplace(std::min(a, b), std::max(a, b));
    mesh.marked.assign(3 * mesh.triangles.size(), false);
    for (HalfEdge h = 0; h < mesh.marked.size(); ++h) {
        const auto& t = mesh.triangles[h / 3];
        const std::uint32_t a = t[h % 3], b = t[(h + 1) % 3];
        mesh.marked[h] = edges.contains({std::min(a, b), std::max(a, b)});
    }
}

void triangulate_and_link(const PolygonMesh& polygons, Mesh& mesh) {
    triangulate_into(polygons, mesh);
    mesh.next_on_edge = link_edges(mesh.triangles, polygons.positions.size());
}

Mesh finish_mesh(PolygonMesh polygons, const MeshOptions& options, Mesh mesh) {
    triangulate_and_link(polygons, mesh);
    const std::vector<std::uint32_t> duplicates = DuplicateFinder(polygons, mesh).find();
    mesh.repairs.duplicate_polygons = duplicates.size();
    if (!duplicates.empty()) polygons = without(polygons, duplicates);
    const bool is_subdivided = options.subdivision_levels > 0 && polygons.polygon_count() > 0;
    if (is_subdivided) {
        polygons = subdivide(polygons, options.scheme, options.subdivision_levels, mesh.name);
    }
    if (!duplicates.empty() || is_subdivided) triangulate_and_link(polygons, mesh);
    mark_edges(polygons, mesh);
    mesh.polygon_material = std::move(polygons.polygon_material);
    const bool one_material = std::all_of(mesh.polygon_material.begin(), mesh.polygon_material.end(),
                                          [](std::uint32_t m) { return m == 0; });
    if (one_material) mesh.polygon_material.clear();
    mesh.positions = std::move(polygons.positions);
    mesh.borders = index_borders(mesh);
    return mesh;
}

}  // namespace

std::vector<Mesh> build_meshes(const PolygonSoup& soup, const MeshOptions& options) {
    const glm::dvec3 origin = choose_origin(soup);
    std::vector<glm::vec3> positions(soup.positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        positions[i] = glm::vec3(soup.positions[i] - origin) + 0.0f;  // + 0 turns -0 into 0
    }
    throw_if_interrupted();
    const std::vector<std::uint32_t> welded = VertexWelder(positions).take();
    const PolygonsByObject groups = group_by_object(soup);
    ObjectCollector collector(soup, positions, welded);

    std::vector<Mesh> meshes;
    std::size_t begin = 0;
    for (std::size_t object = 0; object < groups.end.size(); ++object) {
        Mesh mesh;
        mesh.name = soup.object_names.empty() ? "" : soup.object_names[object];
        mesh.origin = origin;
        const std::size_t end = groups.end[object];
        if (begin == end) continue;
        PolygonMesh polygons = collector.collect(groups, begin, end, mesh.repairs);
        begin = end;
        meshes.push_back(finish_mesh(std::move(polygons), options, std::move(mesh)));
    }
    return meshes;
}

}  // namespace burin
