#include "mesh/deforming_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mesh/shapes.h"
#include "tests/mesh/mesh_checks.h"

namespace burin::deforming_mesh_test {
namespace {

void expect_same_topology(const Mesh& a, const Mesh& b) {
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.triangle_polygon, b.triangle_polygon);
    EXPECT_EQ(a.next_on_edge, b.next_on_edge);
    EXPECT_EQ(a.marked, b.marked);
    EXPECT_EQ(a.loose_edges, b.loose_edges);
    EXPECT_EQ(a.polygon_material, b.polygon_material);
    ASSERT_EQ(a.polygon_count, b.polygon_count);
    for (std::uint32_t t = 0; t < a.triangles.size(); ++t) EXPECT_EQ(a.input_place_of(t), b.input_place_of(t));
}

void expect_same_mesh(const Mesh& a, const Mesh& b) {
    expect_same_topology(a, b);
    EXPECT_EQ(a.origin, b.origin);
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.residuals, b.residuals);
    EXPECT_EQ(a.polygon_normals, b.polygon_normals);
    ASSERT_EQ(a.borders.segments().size(), b.borders.segments().size());
    for (std::size_t i = 0; i < a.borders.segments().size(); ++i) {
        EXPECT_EQ(a.borders.segments()[i].half_edge, b.borders.segments()[i].half_edge);
        EXPECT_EQ(a.borders.segments()[i].a, b.borders.segments()[i].a);
        EXPECT_EQ(a.borders.segments()[i].b, b.borders.segments()[i].b);
    }
}

/// Rows of squares, each with vertices of its own, of which the last row is a triangle.
PolygonSoup strip(int columns, bool has_triangles_only) {
    PolygonSoup soup;
    soup.object_names = {"strip"};
    soup.materials = {Material{}};
    for (int i = 0; i < columns; ++i) {
        const auto first = static_cast<std::uint32_t>(soup.positions.size());
        for (const auto& [x, y] : {std::pair(i, 0), std::pair(i + 1, 0), std::pair(i + 1, 1), std::pair(i, 1)})
            soup.positions.emplace_back(x, y, 0);
        const std::vector<std::uint32_t> corners = {first, first + 1, first + 2, first + 3};
        if (has_triangles_only) {
            soup.add_polygon(std::vector<std::uint32_t>{corners[0], corners[1], corners[2]});
            soup.add_polygon(std::vector<std::uint32_t>{corners[0], corners[2], corners[3]});
        } else {
            soup.add_polygon(corners);
        }
    }
    if (has_triangles_only) soup.polygon_ends.clear();
    return soup;
}

/// Rolls up the strip.
std::vector<glm::dvec3> rolled(const PolygonSoup& soup) {
    std::vector<glm::dvec3> positions;
    for (const glm::dvec3& p : soup.positions) positions.emplace_back(std::sin(0.3 * p.x), p.y, std::cos(0.3 * p.x));
    return positions;
}

PolygonSoup with_positions(PolygonSoup soup, std::vector<glm::dvec3> positions) {
    soup.positions = std::move(positions);
    return soup;
}

std::vector<std::uint32_t> one_kind(const PolygonSoup& soup) {
    return std::vector<std::uint32_t>(soup.positions.size(), 0);
}

TEST(DeformingMesh, IsTheMeshOfTheMovedPolygonsWhereTheseHaveTheSameTopology) {
    PolygonSoup soup = strip(9, true);
    soup.marked_edges = {{1, 2}, {0, 30}};  // an edge, and a line that no polygon has
    soup.polygon_material.assign(soup.polygon_count(), 1);
    DeformingMesh deforming(soup, one_kind(soup), {});
    const Mesh rest = *deforming.take_rest();
    expect_same_mesh(rest, build_meshes(soup, {}).at(0));
    expect_same_mesh(deforming.at(soup.positions), rest);
    const Mesh moved = deforming.at(rolled(soup));
    expect_same_mesh(moved, build_meshes(with_positions(soup, rolled(soup)), {}).at(0));
    test::expect_consistent(moved, "rolled");
    EXPECT_FALSE(moved.loose_edges.empty());
}

TEST(DeformingMesh, LargeOnesKeepTheSpatialOrderOfRest) {
    PolygonSoup soup = strip(40000, true);
    for (glm::dvec3& p : soup.positions) p.y += std::fmod(7 * p.x, 40000);
    DeformingMesh deforming(soup, one_kind(soup), {});
    const Mesh rest = *deforming.take_rest();
    const Mesh moved = deforming.at(rolled(soup));
    EXPECT_EQ(moved.triangles, rest.triangles);
    EXPECT_EQ(moved.next_on_edge, rest.next_on_edge);
    bool is_in_other_order = false;
    for (std::uint32_t t = 0; t < rest.triangles.size(); ++t) {
        EXPECT_EQ(moved.input_place_of(t), rest.input_place_of(t));
        is_in_other_order |= rest.input_place_of(t) != t;
    }
    EXPECT_TRUE(is_in_other_order);
    EXPECT_EQ(moved.position(rest.triangles[5][1]),
              glm::dvec3(glm::vec3(rolled(soup)[soup.polygon(rest.input_place_of(5))[1]])));
}

TEST(DeformingMesh, NothingIsLostInAFrameForLackOfArea) {
    const PolygonSoup soup = strip(3, true);
    DeformingMesh deforming(soup, one_kind(soup), {});
    const Mesh rest = *deforming.take_rest();
    const Mesh flat = deforming.at(std::vector<glm::dvec3>(soup.positions.size(), glm::dvec3(1, 2, 3)));
    EXPECT_EQ(flat.triangles, rest.triangles);
    EXPECT_EQ(flat.next_on_edge, rest.next_on_edge);
    EXPECT_EQ(flat.position(0), glm::dvec3(1, 2, 3));
    test::expect_consistent(flat, "in one place");
}

TEST(DeformingMesh, WhatHasNoAreaInAFrameTakesTheNormalOfANeighbour) {
    PolygonSoup soup = strip(3, true);
    std::swap(soup.corners[6], soup.corners[7]);  // the third triangle is wound the other way
    DeformingMesh deforming(soup, one_kind(soup), {});
    deforming.take_rest();
    std::vector<glm::dvec3> narrow = soup.positions;  // the square in the middle comes to be a line
    for (glm::dvec3& p : narrow) p.x -= p.x > 1.5 ? 1 : 0;
    const Mesh mesh = deforming.at(narrow);
    test::expect_consistent(mesh, "narrow");
    ASSERT_EQ(mesh.polygon_normals.size(), 6u);
    for (std::uint32_t t = 0; t < 6; ++t)
        EXPECT_EQ(mesh.polygon_area_vector(t), glm::dvec3(0, 0, t == 2 ? -1 : 1)) << t;
    EXPECT_TRUE(deforming.at(soup.positions).polygon_normals.empty()) << "all have an area again";
}

TEST(DeformingMesh, VerticesThatMoveOtherwiseAreNotWelded) {
    const PolygonSoup soup = strip(2, true);  // vertices 1 and 4, 2 and 7 are in one place
    std::vector<std::uint32_t> kinds = one_kind(soup);
    kinds[7] = 1;
    DeformingMesh deforming(soup, kinds, {});
    const Mesh rest = *deforming.take_rest();
    EXPECT_EQ(rest.positions.size(), 7u);
    std::vector<glm::dvec3> torn = soup.positions;
    torn[7].z = 5;
    const Mesh moved = deforming.at(torn);
    EXPECT_EQ(moved.next_on_edge, rest.next_on_edge);
    test::expect_consistent(moved, "torn");
}

TEST(DeformingMesh, WhatHasNoAreaAtRestMayGetOne) {
    PolygonSoup soup = strip(1, true);
    for (glm::dvec3& p : soup.positions) p = glm::dvec3(4, 0, 0);
    {
        DeformingMesh never(soup, one_kind(soup), {});
        const std::optional<Mesh> rest = never.take_rest();
        EXPECT_TRUE(!rest || rest->triangles.empty()) << "all corners move alike";
    }
    DeformingMesh deforming(soup, {0, 1, 2, 3}, {});
    EXPECT_EQ(deforming.take_rest()->triangles.size(), 2u);
    const PolygonSoup unfolded = strip(1, true);
    EXPECT_EQ(deforming.at(unfolded.positions).positions, build_meshes(unfolded, {}).at(0).positions);
}

TEST(DeformingMesh, FarFromZeroItIsRoundedAsAModelThatIsThere) {
    const PolygonSoup soup = strip(4, true);
    DeformingMesh deforming(soup, one_kind(soup), {});
    std::vector<glm::dvec3> away = soup.positions;
    for (glm::dvec3& p : away) p += glm::dvec3(1e7, 0, 0.125);
    const Mesh moved = deforming.at(away);
    EXPECT_NE(moved.origin, glm::dvec3(0.0));
    expect_same_mesh(moved, build_meshes(with_positions(soup, away), {}).at(0));
    away[0].y -= 1e12;  // a marker far away: there are residuals
    away[0].x += 3;
    const Mesh blurred = deforming.at(away);
    EXPECT_EQ(blurred.residuals.size(), blurred.positions.size());
}

TEST(DeformingMesh, SubdividesTheControlMeshOfEachFrame) {
    for (const bool has_triangles : {true, false}) {
        PolygonSoup soup = strip(5, has_triangles);
        soup.marked_edges = {{1, 2}, {0, 13}};
        const MeshOptions options{.subdivision_levels = 2};
        DeformingMesh deforming(soup, one_kind(soup), options);
        const Mesh rest = *deforming.take_rest();
        const Mesh moved = deforming.at(rolled(soup));
        expect_same_topology(moved, rest);
        const Mesh built = build_meshes(with_positions(soup, rolled(soup)), options).at(0);
        // Loose lines have vertices of their own here.
        ASSERT_LE(built.positions.size(), moved.positions.size());
        EXPECT_EQ(moved.polygon_normals, built.polygon_normals);
        for (std::size_t v = 0; v < built.positions.size() - 2; ++v) EXPECT_EQ(moved.positions[v], built.positions[v]);
        EXPECT_EQ(moved.next_on_edge, test::link_edges_by_map(moved.triangles));
    }
}

}  // namespace
}  // namespace burin::deforming_mesh_test
