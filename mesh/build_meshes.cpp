#include "mesh/build_meshes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/huge_pages.h"
#include "base/interrupt.h"
#include "mesh/collect_triangles.h"
#include "mesh/duplicate_polygons.h"
#include "mesh/edge_links.h"
#include "mesh/object_collector.h"
#include "mesh/spatial_order.h"
#include "mesh/triangulate.h"
#include "mesh/vertex_welder.h"

namespace burin {
namespace {

double largest_of(const glm::dvec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// If no vertex is so far from 0, choose_origin() finds 0: some corners alone make the model large enough for that.
double plainly_near(const PolygonSoup& soup) {
    if (soup.corners.empty()) return 0;
    glm::dvec3 low = soup.positions[soup.corners[0]], high = low;
    const std::size_t step = soup.corners.size() / 1024 + 1;
    for (std::size_t i = 0; i < soup.corners.size(); i += step) {
        low = glm::min(low, soup.positions[soup.corners[i]]);
        high = glm::max(high, soup.positions[soup.corners[i]]);
    }
    return 16 * largest_of(0.5 * (high - low));
}

/// Where to put 0 so that single precision resolves the model: its centre if the model lies more
/// than 16 of its own half sizes away from 0, else 0 itself (and coordinates keep their values).
/// Vertices that no polygon uses, such as a stray one at 0, do not count.
glm::dvec3 choose_origin(const PolygonSoup& soup) {
    if (soup.corners.empty()) return glm::dvec3(0.0);
    std::vector<std::uint8_t> is_corner(soup.positions.size(), 0);
    for (const std::uint32_t v : soup.corners) is_corner[v] = 1;
    glm::dvec3 low = soup.positions[soup.corners[0]], high = low;
    for (std::size_t v = 0; v < soup.positions.size(); ++v) {
        if (is_corner[v] == 0) continue;
        low = glm::min(low, soup.positions[v]);
        high = glm::max(high, soup.positions[v]);
    }
    const glm::dvec3 center = 0.5 * (low + high);
    return largest_of(center) > 16 * largest_of(0.5 * (high - low)) ? center : glm::dvec3(0.0);
}

/// Puts positions, as seen from the origin that is chosen for them, into `rounded`. Returns the origin.
glm::dvec3 round_positions(const PolygonSoup& soup, std::vector<glm::vec3>& rounded) {
    reserve_large(rounded, soup.positions.size());
    glm::dvec3 largest(0.0);
    for (const glm::dvec3& p : soup.positions) {
        rounded.push_back(glm::vec3(p) + 0.0f);  // + 0 turns -0 into 0
        largest = glm::max(largest, glm::abs(p));
    }
    if (largest_of(largest) < plainly_near(soup)) return glm::dvec3(0.0);
    const glm::dvec3 origin = choose_origin(soup);
    if (origin == glm::dvec3(0.0)) return origin;
    for (std::size_t i = 0; i < rounded.size(); ++i) rounded[i] = glm::vec3(soup.positions[i] - origin) + 0.0f;
    return origin;
}

void check_triangle_count(const std::string& object, std::size_t triangles) {
    if (3 * triangles < kNoHalfEdge) return;
    throw InputError("object '" + object + "': more than 1.4 billion triangles; split the model");
}

/// Gives a vector's memory back, which clear() and an empty list do not.
template <typename T>
void release(std::vector<T>& v) {
    std::vector<T>().swap(v);
}

/// Triangles, their polygons, and the polygons' normals.
void triangulate_into(const PolygonMesh& polygons, Mesh& mesh) {
    mesh.polygon_count = static_cast<std::uint32_t>(polygons.polygon_count());
    check_triangle_count(mesh.name, polygons.corners.size() - 2 * polygons.polygon_count());
    mesh.triangles.clear();
    mesh.triangle_polygon.clear();
    mesh.polygon_normals.clear();
    if (polygons.ends.empty()) {
        reserve_large(mesh.triangles, polygons.polygon_count());
        for (std::size_t i = 0; i < polygons.corners.size(); i += 3) {
            const std::uint32_t* const c = &polygons.corners[i];
            mesh.triangles.push_back({c[0], c[1], c[2]});
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
        if (normal == glm::dvec3(0.0))
            normal = normal_of_any_corners(corners);  // a figure of eight
        const double length = glm::length(normal);
        mesh.polygon_normals.emplace_back(length > 0 ? normal / length : normal);
    }
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
        result.add_polygon(mesh.polygon(i));
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
    const bool is_subdivided =
        options.subdivision_levels > 0 && mesh.polygon_count > duplicates.size();
    if (!duplicates.empty()) {
        polygons = without(polygons, duplicates);
        mesh.input_order.drop(duplicates);
    }
    if (is_subdivided) {
        polygons = subdivide(polygons, options.scheme, options.subdivision_levels, mesh.name);
    }
    if (!duplicates.empty() || is_subdivided) triangulate_and_link(polygons, mesh);
    mark_edges(polygons, mesh);
    mesh.polygon_material = std::move(polygons.polygon_material);
    const bool one_material =
        std::all_of(mesh.polygon_material.begin(), mesh.polygon_material.end(),
                    [](std::uint32_t m) { return m == 0; });
    if (one_material) mesh.polygon_material.clear();
    mesh.positions = std::move(polygons.positions);
    mesh.borders = index_borders(mesh);
    return mesh;
}

/// The same for a mesh that has nothing but triangles and has them already.
Mesh finish_triangles(const MeshOptions& options, Mesh mesh) {
    check_triangle_count(mesh.name, mesh.triangles.size());
    bool has_duplicates = false;
    if (options.subdivision_levels == 0) {
        mesh.next_on_edge = link_edges(mesh.triangles, mesh.positions.size(), &has_duplicates);
    }
    if (options.subdivision_levels > 0 || has_duplicates) {
        PolygonMesh polygons;
        polygons.positions = std::move(mesh.positions);
        for (const auto& [a, b, c] : mesh.triangles)
            polygons.corners.insert(polygons.corners.end(), {a, b, c});
        return finish_mesh(std::move(polygons), options, std::move(mesh));
    }
    mesh.borders = index_borders(mesh);
    return mesh;
}

/// Counts what subdivision makes of all objects together, before the first of them is made. Corners become four in each step, by
/// either scheme.
void count_subdivision(const PolygonSoup& soup, const MeshOptions& options) {
    if (options.subdivision_levels == 0 || options.budget == nullptr) return;
    const bool has_triangles = soup.corners.size() == 3 * soup.polygon_count();
    std::uint64_t corners = soup.corners.size();
    for (int level = 0; level < options.subdivision_levels; ++level) corners = saturating_product(corners, 4);
    const std::string object = soup.object_names.size() == 1 ? "object '" + soup.object_names[0] + "'" : "the model";
    count_mesh(*options.budget, {corners / (has_triangles ? 3 : 4), corners}, object,
               "subdivide " + std::to_string(options.subdivision_levels));
}

/// Whether the order of an object's polygons shows in nothing but their numbers: where some coincide, the first one is seen.
bool may_be_put_in_order(const PolygonSoup& soup, std::span<const std::uint32_t> polygons) {
    if (polygons.size() < kWorthSpatialOrder || !soup.marked_edges.empty()) return false;
    return std::all_of(polygons.begin(), polygons.end(), [&](std::uint32_t i) { return soup.material_of(i) == soup.material_of(polygons[0]); });
}

/// Puts an object's polygons in spatial order. Returns where they were.
InputOrder put_in_order(const PolygonSoup& soup, const SpatialOrder& spatial, std::span<std::uint32_t> polygons) {
    UnfilledVector<std::uint32_t> order = spatial.of_polygons(soup, polygons);
    const std::vector<std::uint32_t> given(polygons.begin(), polygons.end());
    for (std::size_t i = 0; i < given.size(); ++i) polygons[i] = given[order[i]];
    return InputOrder(std::move(order), {});
}

}  // namespace

std::vector<Mesh> build_meshes(PolygonSoup soup, const MeshOptions& options) {
    count_subdivision(soup, options);
    std::vector<glm::vec3> positions;
    const glm::dvec3 origin = round_positions(soup, positions);
    throw_if_interrupted();
    std::vector<std::uint32_t> welded = weld_vertices(positions);
    std::vector<Mesh> meshes;
    const auto empty_mesh = [&](std::size_t object) {
        Mesh mesh;
        mesh.name = soup.object_names.empty() ? "" : soup.object_names[object];
        mesh.origin = origin;
        return mesh;
    };
    const bool is_subdivided = options.subdivision_levels > 0;  // which numbers polygons anew
    if (has_only_triangles(soup)) {
        Mesh mesh = empty_mesh(0);
        // What is done with makes room: fresh memory costs more than the work on it.
        release(soup.positions);
        const bool is_large = soup.polygon_count() >= kWorthSpatialOrder;
        collect_triangles(soup, positions, welded, is_large && !is_subdivided, mesh);
        release(soup.corners);
        release(positions);
        release(welded);
        meshes.push_back(finish_triangles(options, std::move(mesh)));
        return meshes;
    }
    PolygonsByObject groups = group_by_object(soup);
    if (groups.order.empty() && soup.polygon_count() >= kWorthSpatialOrder && !is_subdivided) {
        groups.order.resize(soup.polygon_count());
        std::iota(groups.order.begin(), groups.order.end(), 0u);
    }
    std::optional<SpatialOrder> spatial;
    ObjectCollector collector(soup, positions, welded);
    std::size_t begin = 0;
    for (std::size_t object = 0; object < groups.end.size(); ++object) {
        const std::size_t end = groups.end[object];
        if (begin == end) continue;
        Mesh mesh = empty_mesh(object);
        if (!is_subdivided && !groups.order.empty()) {
            const std::span<std::uint32_t> own(groups.order.data() + begin, end - begin);
            if (may_be_put_in_order(soup, own)) {
                if (!spatial) spatial.emplace(positions, soup.corners);
                mesh.input_order = put_in_order(soup, *spatial, own);
            }
        }
        std::vector<std::uint32_t> dropped;
        PolygonMesh polygons = collector.collect(groups, begin, end, mesh.repairs, dropped);
        mesh.input_order.drop(dropped);
        meshes.push_back(finish_mesh(std::move(polygons), options, std::move(mesh)));
        begin = end;
    }
    return meshes;
}

}  // namespace burin
