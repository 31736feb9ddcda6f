#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/polygon_soup.h"

namespace burin::test {

/// A soup of one object.
inline PolygonSoup soup_of(std::vector<glm::dvec3> positions, const std::vector<std::vector<std::uint32_t>>& polygons) {
    PolygonSoup soup;
    soup.positions = std::move(positions);
    for (const auto& polygon : polygons) soup.add_polygon(polygon);
    soup.object_names = {"soup"};
    soup.materials = {Material{}};
    return soup;
}

/// The rings of half-edges on the same two vertices, made in the most obvious way.
inline std::vector<HalfEdge> link_edges_by_map(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<HalfEdge>> edges;
    for (HalfEdge h = 0; h < 3 * triangles.size(); ++h) {
        const std::uint32_t a = triangles[h / 3][h % 3], b = triangles[h / 3][(h + 1) % 3];
        edges[{std::min(a, b), std::max(a, b)}].push_back(h);
    }
    std::vector<HalfEdge> next(3 * triangles.size());
    for (const auto& [edge, ring] : edges) {
        for (std::size_t i = 0; i < ring.size(); ++i) next[ring[i]] = ring[(i + 1) % ring.size()];
    }
    return next;
}

/// How the half-edges of a mesh's edges lie, over all edges between two vertices, diagonals too.
struct Winding {
    int opposite = 0;      ///< two triangles, walking the edge in opposite directions
    int equal = 0;         ///< two triangles, walking it in the same direction
    int border = 0;        ///< one triangle
    int non_manifold = 0;  ///< three or more
};
inline Winding winding_of(const Mesh& mesh) {
    Winding w;
    const auto from = [&](HalfEdge h) { return mesh.triangles[h / 3][h % 3]; };
    for (HalfEdge h = 0; h < mesh.next_on_edge.size(); ++h) {
        const HalfEdge g = mesh.next_on_edge[h];
        if (g == h) {
            ++w.border;
        } else if (mesh.next_on_edge[g] != h) {
            ++w.non_manifold;
        } else if (g > h) {
            ++(from(g) == from(h) ? w.equal : w.opposite);
        }
    }
    return w;
}

/// Volume inside a closed surface; positive if it is wound to be seen from outside.
inline double volume_of(const Mesh& mesh) {
    double six_volumes = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        six_volumes += glm::dot(mesh.position(a), glm::cross(mesh.position(b), mesh.position(c)));
    }
    return six_volumes / 6;
}

/// What must hold for every Mesh, whatever it was made of.
inline void expect_consistent(const Mesh& mesh, const std::string& what) {
    const std::size_t half_edges = 3 * mesh.triangles.size();
    ASSERT_EQ(mesh.next_on_edge, link_edges_by_map(mesh.triangles)) << what;
    ASSERT_TRUE(mesh.marked.empty() || mesh.marked.size() == half_edges) << what;
    for (const AttributeLayer& layer : mesh.attributes) {
        ASSERT_EQ(layer.rows.size(), half_edges) << what;
        for (const std::uint32_t row : layer.rows)
            ASSERT_TRUE(row < layer.row_count() || row == AttributeLayer::kNoRow) << what;
    }
    std::vector<bool> used(mesh.positions.size(), false);
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t v : triangle) {
            ASSERT_LT(v, used.size()) << what;
            used[v] = true;
        }
    }
    for (const auto& edge : mesh.loose_edges) {
        ASSERT_NE(edge[0], edge[1]) << what;
        for (const std::uint32_t v : edge) {
            ASSERT_LT(v, used.size()) << what;
            used[v] = true;
        }
    }
    ASSERT_EQ(std::count(used.begin(), used.end(), false), 0) << what << ": vertices that nothing uses";
    if (mesh.triangle_polygon.empty()) {
        ASSERT_EQ(mesh.polygon_count, mesh.triangles.size()) << what;
        ASSERT_TRUE(mesh.polygon_normals.empty()) << what;
    } else {
        ASSERT_EQ(mesh.triangle_polygon.size(), mesh.triangles.size()) << what;
        ASSERT_TRUE(std::is_sorted(mesh.triangle_polygon.begin(), mesh.triangle_polygon.end())) << what;
        ASSERT_EQ(mesh.triangle_polygon.front(), 0u) << what;
        ASSERT_EQ(mesh.triangle_polygon.back() + 1, mesh.polygon_count) << what;
        ASSERT_EQ(mesh.polygon_normals.size(), mesh.polygon_count) << what;
        for (const glm::vec3& n : mesh.polygon_normals) {
            ASSERT_NEAR(glm::dot(glm::dvec3(n), glm::dvec3(n)), 1, 1e-5) << what;
        }
    }
    ASSERT_TRUE(mesh.polygon_material.empty() || mesh.polygon_material.size() == mesh.polygon_count) << what;
    const MeshRepairs& r = mesh.repairs;
    ASSERT_EQ(r.input_polygons - r.cut_polygons + r.cut_pieces - r.degenerate_polygons - r.duplicate_polygons,
              mesh.polygon_count)
        << what;
    std::vector<HalfEdge> borders;
    for (HalfEdge h = 0; h < half_edges; ++h) {
        if (mesh.next_on_edge[h] == h) borders.push_back(h);
    }
    ASSERT_EQ(mesh.borders.segments().size(), borders.size()) << what;
    for (std::size_t i = 0; i < borders.size(); ++i) {
        const BorderIndex::Segment& s = mesh.borders.segments()[i];
        const HalfEdge h = borders[i];
        ASSERT_EQ(s.half_edge, h) << what;
        ASSERT_EQ(s.polygon, mesh.polygon_of(h / 3)) << what;
        ASSERT_EQ(s.a, mesh.local_position(mesh.triangles[h / 3][h % 3])) << what;
        ASSERT_EQ(s.b, mesh.local_position(mesh.triangles[h / 3][(h + 1) % 3])) << what;
    }
}

}  // namespace burin::test
