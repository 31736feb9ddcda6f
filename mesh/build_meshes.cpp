#include "mesh/build_meshes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/huge_pages.h"
#include "base/interrupt.h"
#include "mesh/carry_attributes.h"
#include "mesh/collect_triangles.h"
#include "mesh/duplicate_polygons.h"
#include "mesh/edge_links.h"
#include "mesh/marked_edges.h"
#include "mesh/moving_vertices.h"
#include "mesh/object_collector.h"
#include "mesh/repeated_edges.h"
#include "mesh/round_positions.h"
#include "mesh/spatial_order.h"
#include "mesh/triangulate.h"

namespace burin {
namespace {

constexpr std::uint32_t kNoObject = 0xFFFFFFFFu;

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
        for (const std::uint32_t v : polygon) corners.push_back(polygons.local_position(v));
        pieces.clear();
        triangulate_polygon(corners, pieces);
        for (const auto& [a, b, c] : pieces) {
            mesh.triangles.push_back({polygon[a], polygon[b], polygon[c]});
            mesh.triangle_polygon.push_back(i);
        }
        mesh.polygon_normals.push_back(polygon_normal(corners));
    }
}

PolygonMesh without(const PolygonMesh& mesh, const std::vector<std::uint32_t>& dropped) {
    PolygonMesh result;
    result.positions = mesh.positions;
    result.residuals = mesh.residuals;
    result.marked_edges = mesh.marked_edges;
    result.source_vertices = mesh.source_vertices;
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
        if (!mesh.sources.empty()) result.sources.push_back(mesh.sources[i]);
    }
    return result;
}

void triangulate_and_link(const PolygonMesh& polygons, Mesh& mesh) {
    triangulate_into(polygons, mesh);
    mesh.next_on_edge = link_edges(mesh.triangles, polygons.positions.size());
}

/// `has_marks`: gets which of the marked edges are edges of the polygons. `attributes`: nullptr: there are none.
/// `moving`: gets where vertices come from.
Mesh finish_mesh(PolygonMesh polygons, const MeshOptions& options, Mesh mesh, std::vector<bool>& has_marks,
                 AttributeCarrier* attributes = nullptr, MovingVertices* moving = nullptr) {
    triangulate_and_link(polygons, mesh);
    const std::vector<std::uint32_t> duplicates = find_duplicates(polygons, mesh);
    mesh.repairs.duplicate_polygons = duplicates.size();
    const bool is_subdivided = options.subdivision_levels > 0 && mesh.polygon_count > duplicates.size();
    if (!duplicates.empty()) {
        polygons = without(polygons, duplicates);
        mesh.input_order.drop(duplicates);
    }
    if (moving != nullptr) moving->sources = polygons.source_vertices;
    if (is_subdivided) {
        has_marks = marks_of_polygons(polygons);
        if (moving != nullptr) moving->control = polygons;
        polygons = subdivide(polygons, options.scheme, options.subdivision_levels, mesh.name);
    }
    if (!duplicates.empty() || is_subdivided) triangulate_and_link(polygons, mesh);
    std::vector<bool> found = mark_half_edges(polygons, mesh);
    if (!is_subdivided) has_marks = std::move(found);
    if (attributes != nullptr && !is_subdivided) mesh.attributes = attributes->carry(polygons, mesh);
    mesh.polygon_material = std::move(polygons.polygon_material);
    const bool one_material =
        std::all_of(mesh.polygon_material.begin(), mesh.polygon_material.end(), [](std::uint32_t m) { return m == 0; });
    if (one_material) mesh.polygon_material.clear();
    mesh.positions = std::move(polygons.positions);
    mesh.residuals = std::move(polygons.residuals);
    mesh.borders = index_borders(mesh);
    return mesh;
}

/// Finishes a mesh that has nothing but triangles and has them already.
Mesh finish_triangles(const MeshOptions& options, Mesh mesh) {
    check_triangle_count(mesh.name, mesh.triangles.size());
    bool has_duplicates = false;
    if (options.subdivision_levels == 0) {
        mesh.next_on_edge = link_edges(mesh.triangles, mesh.positions.size(), &has_duplicates);
    }
    if (options.subdivision_levels > 0 || has_duplicates) {
        PolygonMesh polygons;
        polygons.positions = std::move(mesh.positions);
        for (const auto& [a, b, c] : mesh.triangles) polygons.corners.insert(polygons.corners.end(), {a, b, c});
        std::vector<bool> has_none;
        return finish_mesh(std::move(polygons), options, std::move(mesh), has_none);
    }
    mesh.borders = index_borders(mesh);
    return mesh;
}

/// Pieces of polygons that were cut were counted one by one; in the input they are one polygon.
void note_cut_polygons(const CutPolygons& cut, MeshRepairs& repairs) {
    repairs.cut_polygons = cut.polygons;
    repairs.cut_pieces = cut.pieces;
    repairs.input_polygons -= cut.pieces - cut.polygons;
    repairs.input_triangles += cut.triangles - cut.piece_triangles;
}

/// Counts what subdivision makes of all objects together, before the first of them is made. Corners become four in each
/// step, by either scheme.
void count_subdivision(const PolygonSoup& soup, const MeshOptions& options) {
    if (options.subdivision_levels == 0 || options.budget == nullptr) return;
    const bool has_triangles = soup.corners.size() == 3 * soup.polygon_count();
    std::uint64_t corners = soup.corners.size();
    for (int level = 0; level < options.subdivision_levels; ++level) corners = saturating_product(corners, 4);
    const std::string object = soup.object_names.size() == 1 ? "object '" + soup.object_names[0] + "'" : "the model";
    count_mesh(*options.budget, {corners / (has_triangles ? 3 : 4), corners}, object,
               "subdivide " + std::to_string(options.subdivision_levels));
}

/// Whether the order of an object's polygons shows in nothing but their numbers: where some coincide, the first one is
/// seen.
bool may_be_put_in_order(const PolygonSoup& soup, std::span<const std::uint32_t> polygons) {
    if (polygons.size() < kWorthSpatialOrder || !soup.marked_edges.empty()) return false;
    return std::all_of(polygons.begin(), polygons.end(),
                       [&](std::uint32_t i) { return soup.material_of(i) == soup.material_of(polygons[0]); });
}

/// Puts an object's polygons in spatial order. Returns where they were.
InputOrder put_in_order(const PolygonSoup& soup, const SpatialOrder& spatial, std::span<std::uint32_t> polygons) {
    UnfilledVector<std::uint32_t> order = spatial.of_polygons(soup, polygons);
    const std::vector<std::uint32_t> given(polygons.begin(), polygons.end());
    for (std::size_t i = 0; i < given.size(); ++i) polygons[i] = given[order[i]];
    return InputOrder(std::move(order), {});
}

/// Keeps vertices apart that do not move alike. `first`: as weld_vertices() has it.
void keep_kinds_apart(const std::vector<std::uint32_t>& kinds, std::vector<std::uint32_t>& first) {
    std::vector<std::uint32_t> order(first.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t v) { return std::pair(first[v], kinds[v]); };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t u, std::uint32_t v) { return std::pair(key(u), u) < std::pair(key(v), v); });
    std::vector<std::uint32_t> result(first.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        result[order[i]] = i > 0 && key(order[i - 1]) == key(order[i]) ? result[order[i - 1]] : order[i];
    }
    first = std::move(result);
}

}  // namespace

glm::vec3 polygon_normal(std::span<const glm::dvec3> corners) {
    glm::dvec3 normal = area_vector(corners);
    if (normal == glm::dvec3(0.0)) normal = normal_of_any_corners(corners);  // a figure of eight
    const double length = glm::length(normal);
    return glm::vec3(length > 0 ? normal / length : normal);
}

std::vector<Mesh> build_meshes(PolygonSoup soup, const MeshOptions& options, MovingVertices* moving) {
    count_subdivision(soup, options);
    RoundedPositions rounded = round_positions(soup);
    std::vector<glm::vec3>& positions = rounded.positions;
    throw_if_interrupted();
    std::vector<std::uint32_t> welded = weld_vertices(rounded);
    if (moving != nullptr) keep_kinds_apart(moving->kinds, welded);
    std::vector<Mesh> meshes;
    const auto empty_mesh = [&](std::size_t object) {
        Mesh mesh;
        mesh.name = soup.object_names.empty() ? "" : soup.object_names[object];
        mesh.origin = rounded.origin;
        return mesh;
    };
    const bool is_subdivided = options.subdivision_levels > 0;  // which numbers polygons anew
    if (moving == nullptr && has_only_triangles(soup) && rounded.residuals.empty() && soup.attributes.empty()) {
        Mesh mesh = empty_mesh(0);
        // Memory that is done with is given back at once: fresh memory costs more than the work on it.
        release(soup.positions);
        const bool is_large = soup.polygon_count() >= kWorthSpatialOrder;
        collect_triangles(soup, positions, welded, is_large && !is_subdivided, mesh);
        release(soup.corners);
        release(positions);
        release(welded);
        meshes.push_back(finish_triangles(options, std::move(mesh)));
        return meshes;
    }
    list_rows(soup.corners, soup.attributes);
    const std::vector<CutPolygons> cut = cut_at_repeated_edges(soup, welded);
    PolygonsByObject groups = group_by_object(soup);
    if (groups.order.empty() && soup.polygon_count() >= kWorthSpatialOrder && !is_subdivided) {
        groups.order.resize(soup.polygon_count());
        std::iota(groups.order.begin(), groups.order.end(), 0u);
    }
    std::optional<SpatialOrder> spatial;
    MarkedEdges marks(soup, welded);
    ObjectCollector collector(soup, positions, rounded.residuals, welded, marks, moving);
    std::optional<AttributeCarrier> attributes;
    if (!soup.attributes.empty()) attributes.emplace(soup, welded);
    std::vector<std::uint32_t> objects;  // of the meshes
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
        if (!cut.empty()) note_cut_polygons(cut[object], mesh.repairs);
        std::vector<bool> has_marks;
        meshes.push_back(finish_mesh(std::move(polygons), options, std::move(mesh), has_marks,
                                     attributes ? &*attributes : nullptr, moving));
        for (std::size_t i = 0; i < has_marks.size(); ++i) {
            if (has_marks[i]) marks.note_polygon_has(collector.collected_marks()[i]);
        }
        objects.push_back(static_cast<std::uint32_t>(object));
        begin = end;
    }
    const std::vector<MarkedEdges::Mark> loose = marks.loose_edges();
    if (loose.empty()) return meshes;
    // Objects of lines alone have their places among those with polygons.
    std::vector<Mesh> all;
    std::size_t next_mesh = 0;
    const auto take_up_to = [&](std::uint32_t object) {
        for (; next_mesh < meshes.size() && objects[next_mesh] <= object; ++next_mesh)
            all.push_back(std::move(meshes[next_mesh]));
    };
    for (std::size_t first = 0, last; first < loose.size(); first = last) {
        const std::uint32_t object = loose[first].object;
        last = first;
        while (last < loose.size() && loose[last].object == object) ++last;
        take_up_to(object);
        if (next_mesh == 0 || objects[next_mesh - 1] != object) all.push_back(empty_mesh(object));
        add_loose_edges(std::span(loose).subspan(first, last - first), rounded, all.back(), moving);
    }
    take_up_to(kNoObject);
    return all;
}

}  // namespace burin
