#include "mesh/build_meshes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "base/interrupt.h"
#include "mesh/edge_links.h"
#include "mesh/triangulate.h"

namespace burin {
namespace {

/// Where to put 0 so that single precision resolves the model: its centre if the model lies more
/// than 16 of its own half sizes away from 0, else 0 itself (and coordinates keep their values).
glm::dvec3 choose_origin(const std::vector<glm::dvec3>& positions) {
    if (positions.empty()) return glm::dvec3(0.0);
    glm::dvec3 low = positions[0], high = positions[0];
    for (const glm::dvec3& p : positions) {
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

/// True if all corners lie on one line (or in one point).
bool has_no_area(std::span<const std::uint32_t> corners, const std::vector<glm::vec3>& positions) {
    const glm::dvec3 p(positions[corners[0]]);
    glm::dvec3 along(0.0);
    for (std::size_t i = 1; i < corners.size(); ++i) {
        const glm::dvec3 d = glm::dvec3(positions[corners[i]]) - p;
        if (along == glm::dvec3(0.0)) {
            along = d;
        } else if (glm::cross(along, d) != glm::dvec3(0.0)) {
            return false;
        }
    }
    return true;
}

/// Collects one object's polygons: own vertex numbers, nothing repeated, nothing without area.
class ObjectCollector {
  public:
    ObjectCollector(const PolygonSoup& soup, const std::vector<glm::vec3>& positions,
                    const std::vector<std::uint32_t>& welded)
        : soup_(soup), positions_(positions), welded_(welded), local_(positions.size(), kUnused),
          counted_(positions.size(), false) {}

    PolygonMesh collect(const PolygonsByObject& groups, std::size_t begin, std::size_t end,
                        MeshRepairs& repairs) {
        PolygonMesh mesh;
        mesh.corners.reserve(3 * (end - begin));
        for (std::size_t i = begin; i < end; ++i) {
            if ((i & 0xFFFF) == 0) throw_if_interrupted();
            const std::size_t polygon = groups.order.empty() ? i : groups.order[i];
            collapse(soup_.polygon(polygon), repairs);
            if (corners_.size() < 3 || has_no_area(corners_, positions_)) {
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
        for (const auto& [a, b] : soup_.marked_edges) {
            const std::uint32_t u = local_[welded_[a]], v = local_[welded_[b]];
            if (u != kUnused && v != kUnused && u != v) mesh.marked_edges.push_back({u, v});
        }
        for (const std::uint32_t v : used_) local_[v] = kUnused;
        used_.clear();
        return mesh;
    }

  private:
    static constexpr std::uint32_t kUnused = 0xFFFFFFFFu;

    /// The polygon's welded corners without repetitions in a row, into corners_.
    void collapse(std::span<const std::uint32_t> corners, MeshRepairs& repairs) {
        ++repairs.input_polygons;
        if (corners.size() > 2) repairs.input_triangles += corners.size() - 2;
        corners_.clear();
        for (const std::uint32_t corner : corners) {
            const std::uint32_t v = welded_[corner];
            if (v != corner && !counted_[corner]) {
                counted_[corner] = true;
                ++repairs.welded_vertices;
            }
            if (corners_.empty() || corners_.back() != v) corners_.push_back(v);
        }
        while (corners_.size() > 1 && corners_.front() == corners_.back()) corners_.pop_back();
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
    std::vector<bool> counted_;  // per soup vertex: counted as welded
    std::vector<std::uint32_t> corners_;
};

/// Triangles, their polygons, and the polygons' normals.
void triangulate_into(const PolygonMesh& polygons, Mesh& mesh) {
    mesh.polygon_count = static_cast<std::uint32_t>(polygons.polygon_count());
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
        for (std::size_t k = 0; k < pieces.size() && normal == glm::dvec3(0.0); ++k) {
            const auto& [a, b, c] = pieces[k];  // a figure of eight: any piece's normal will do
            normal = glm::cross(corners[b] - corners[a], corners[c] - corners[a]);
        }
        mesh.polygon_normals.emplace_back(glm::normalize(normal));
    }
}

/// Does not depend on the order of the corners.
std::uint64_t corner_set_key(std::span<const std::uint32_t> corners) {
    std::uint64_t key = corners.size();
    for (const std::uint32_t v : corners) {
        std::uint64_t h = (v + 1) * 0x9E3779B97F4A7C15u;
        h = (h ^ h >> 29) * 0xBF58476D1CE4E5B9u;
        key += h ^ h >> 32;
    }
    return key;
}

bool same_corner_set(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    std::vector<std::uint32_t> x(a.begin(), a.end()), y(b.begin(), b.end());
    std::sort(x.begin(), x.end());
    std::sort(y.begin(), y.end());
    return x == y;
}

/// Polygons with the same corners as an earlier one. A duplicate shares all its edges with its
/// twin, so only polygons around one edge need to be compared.
std::vector<std::uint32_t> find_duplicates(const PolygonMesh& polygons, const Mesh& mesh) {
    std::vector<std::uint32_t> duplicates;
    std::uint32_t previous = 0xFFFFFFFFu;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::uint32_t p = mesh.polygon_of(t);
        if (p == previous) continue;  // one edge of each polygon is enough
        const HalfEdge start = 3 * t;
        for (HalfEdge h = mesh.next_on_edge[start]; h != start; h = mesh.next_on_edge[h]) {
            const std::uint32_t q = mesh.polygon_of(h / 3);
            if (q >= p) continue;
            const auto a = polygons.polygon(p);
            const auto b = polygons.polygon(q);
            if (a.size() == b.size() && corner_set_key(a) == corner_set_key(b) &&
                same_corner_set(a, b)) {
                duplicates.push_back(p);
                break;
            }
        }
        previous = p;
    }
    return duplicates;
}

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
    const std::vector<std::uint32_t> duplicates = find_duplicates(polygons, mesh);
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
    const glm::dvec3 origin = choose_origin(soup.positions);
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
