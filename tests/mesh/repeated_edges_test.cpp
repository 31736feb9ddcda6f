#include "mesh/repeated_edges.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "mesh/build_meshes.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/mesh/model_files.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Polygons;
using test::polygons_of;
using test::Random;
using test::soup_of;

std::vector<std::uint32_t> unwelded(std::size_t vertices) {
    std::vector<std::uint32_t> numbers(vertices);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

/// Vertices on a parabola: no three of them on a line.
std::vector<glm::dvec3> places(int count) {
    std::vector<glm::dvec3> result;
    for (int i = 0; i < count; ++i) result.emplace_back(i, i * i, 0);
    return result;
}

Polygons pieces_of(const std::vector<std::uint32_t>& polygon) {
    PolygonSoup soup = soup_of(places(30), {polygon});
    cut_at_repeated_edges(soup, unwelded(30));
    return polygons_of(soup);
}

TEST(RepeatedEdges, APolygonIsCutWhereItPassesAnEdgeAgain) {
    EXPECT_EQ(pieces_of({0, 1, 2, 0, 1, 3, 0, 1, 4}), (Polygons{{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}));
    EXPECT_EQ(pieces_of({0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3}), (Polygons{{0, 1, 2, 3}, {0, 1, 2, 3}, {0, 1, 2, 3}}));
    EXPECT_EQ(pieces_of({5, 0, 1, 2, 0, 1, 3}), (Polygons{{0, 1, 2}, {5, 0, 1, 3}}));
    EXPECT_EQ(pieces_of({1, 2, 0, 1, 3, 0}), (Polygons{{0, 1, 3}, {1, 2, 0}})) << "the edge from its end to its start";
}

TEST(RepeatedEdges, WhatPassesEachEdgeOnceInEitherDirectionStays) {
    for (const std::vector<std::uint32_t>& polygon :
         {std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6},              // nothing twice
          std::vector<std::uint32_t>{0, 1, 2, 3, 0, 4, 5, 6, 4},        // a hole, joined by the bridge 0 4
          std::vector<std::uint32_t>{0, 1, 2, 0, 3, 4},                 // a figure of eight
          std::vector<std::uint32_t>{0, 1, 2, 3, 0, 4, 5, 4, 6, 7, 4},  // with a spike, which is for others to remove
          std::vector<std::uint32_t>{0, 1, 0, 1, 2, 3}, std::vector<std::uint32_t>{0, 1, 1, 2, 3, 3, 4}}) {
        EXPECT_EQ(pieces_of(polygon), Polygons{polygon});
    }
}

TEST(RepeatedEdges, LongPolygonsAreCutAsShortOnes) {
    std::vector<std::uint32_t> polygon;
    Polygons expected;
    for (std::uint32_t i = 2; i < 30; ++i) {
        polygon.insert(polygon.end(), {0, 1, i});
        expected.push_back({0, 1, i});
    }
    EXPECT_EQ(pieces_of(polygon), expected);
    std::vector<std::uint32_t> round_again;
    for (std::uint32_t i = 0; i < 99000; ++i) round_again.push_back(i % 30);
    PolygonSoup soup = soup_of(places(30), {round_again});
    EXPECT_EQ(cut_at_repeated_edges(soup, unwelded(30))[0].pieces, 3300u);
}

/// All pieces together have the edges that the polygon has without its spikes, in their direction,
/// but for pairs there and back.
TEST(RepeatedEdges, PiecesHaveTheEdgesOfThePolygon) {
    int cut = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        Random random(seed);
        const int vertices = random.integer(3, 8);
        std::vector<std::uint32_t> polygon(static_cast<std::size_t>(random.integer(3, 40)));
        for (auto& v : polygon) v = static_cast<std::uint32_t>(random.integer(0, vertices - 1));
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> net;  // how often in one direction, less the other
        const auto count = [&](const std::vector<std::uint32_t>& corners, int sign) {
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const std::uint32_t a = corners[i], b = corners[(i + 1) % corners.size()];
                if (a != b) net[std::minmax(a, b)] += a < b ? sign : -sign;
            }
        };
        count(polygon, 1);
        const Polygons pieces = pieces_of(polygon);
        for (const std::vector<std::uint32_t>& piece : pieces) {
            count(piece, -1);
            std::map<std::pair<std::uint32_t, std::uint32_t>, int> passes;
            if (pieces.size() == 1) break;
            for (std::size_t i = 0; i < piece.size(); ++i) ++passes[{piece[i], piece[(i + 1) % piece.size()]}];
            for (const auto& [edge, times] : passes) ASSERT_EQ(times, 1) << "seed " << seed;
        }
        for (const auto& [edge, times] : net) ASSERT_EQ(times, 0) << "seed " << seed;
        cut += pieces.size() > 1;
    }
    EXPECT_GT(cut, 1000);
}

TEST(RepeatedEdges, AreFoundAmongWeldedVerticesAndCountedPerObject) {
    std::vector<glm::dvec3> positions = places(5);
    const std::vector<glm::dvec3> again = positions;
    positions.insert(positions.end(), again.begin(), again.end());  // vertex 5 + i is vertex i
    PolygonSoup soup = soup_of(positions, {{0, 1, 2}, {0, 1, 2, 5, 6, 3}, {2, 3, 4}, {0, 2, 3, 5, 7, 8}});
    soup.polygon_object = {0, 0, 1, 1};
    soup.polygon_material = {0, 1, 0, 2};
    soup.object_names = {"a", "b"};
    soup.materials.resize(3);
    const std::vector<Mesh> meshes = build_meshes(soup, {});
    ASSERT_EQ(meshes.size(), 2u);
    for (const Mesh& mesh : meshes) {
        test::expect_consistent(mesh, mesh.name);
        EXPECT_EQ(mesh.repairs.input_polygons, 2u) << "as in the file";
        EXPECT_EQ(mesh.repairs.input_triangles, 5u);
        EXPECT_EQ(mesh.repairs.cut_polygons, 1u);
        EXPECT_EQ(mesh.repairs.cut_pieces, 2u);
        EXPECT_EQ(mesh.repairs.duplicate_polygons, 1u);
        EXPECT_EQ(mesh.polygon_count, 2u);
    }
    EXPECT_EQ(meshes[0].polygon_material, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(meshes[1].polygon_material, (std::vector<std::uint32_t>{0, 2}));
}

/// Nothing in a mesh passes an edge twice but edges between polygons; inside of one polygon, no
/// more than two triangles meet.
TEST(RepeatedEdges, NoMoreThanTwoTrianglesOfAPolygonMeet) {
    const Mesh mesh = build_meshes(soup_of(places(30), {{0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 1, 5, 0, 1, 6}}), {})[0];
    EXPECT_EQ(mesh.polygon_count, 5u);
    for (HalfEdge h = 0; h < mesh.next_on_edge.size(); ++h) {
        std::map<std::uint32_t, int> triangles;
        HalfEdge other = h;
        do {
            EXPECT_LE(++triangles[mesh.polygon_of(other / 3)], 2);
            other = mesh.next_on_edge[other];
        } while (other != h);
    }
}

}  // namespace
}  // namespace burin
