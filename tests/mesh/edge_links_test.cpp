#include "mesh/edge_links.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/mesh/mesh_checks.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

TEST(LinkEdges, AgreesWithAMapOnRandomTriangles) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        // Few vertices make edges of many triangles, and vertices of more than 32.
        const int vertices = random.integer(3, seed % 2 == 0 ? 6 : 60);
        Triangles triangles(static_cast<std::size_t>(random.integer(0, 200)));
        for (auto& t : triangles) {
            for (auto& v : t) v = static_cast<std::uint32_t>(random.integer(0, vertices - 1));
        }
        ASSERT_EQ(link_edges(triangles, static_cast<std::size_t>(vertices)), test::link_edges_by_map(triangles))
            << "seed " << seed;
    }
}

/// Meshes have any number of triangles here, for they are linked some at a time.
TEST(LinkEdges, TellsTwins) {
    int without = 0, with = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        Random random(seed);
        const int vertices = random.integer(4, 100);
        Triangles triangles;
        std::set<std::set<std::uint32_t>> seen;
        bool has_twins = false;
        for (int i = random.integer(0, 200); i > 0; --i) {
            std::array<std::uint32_t, 3> t{};
            for (auto& v : t) v = static_cast<std::uint32_t>(random.integer(0, vertices - 1));
            const std::set<std::uint32_t> corners(t.begin(), t.end());
            if (corners.size() < 3 || (seed % 2 == 0 && seen.contains(corners))) continue;
            has_twins |= !seen.insert(corners).second;
            triangles.push_back(t);
        }
        bool found = !has_twins;
        const std::vector<HalfEdge> next = link_edges(triangles, static_cast<std::size_t>(vertices), &found);
        ASSERT_EQ(next, test::link_edges_by_map(triangles)) << "seed " << seed;
        ASSERT_EQ(found, has_twins) << "seed " << seed;
        ++(has_twins ? with : without);
    }
    EXPECT_GT(std::min(with, without), 500);
}

TEST(LinkEdges, RingsGoThroughTheirHalfEdgesInOrder) {
    // Three triangles around the edge 0-1, in both directions, and their other edges.
    const Triangles triangles{{0, 1, 2}, {3, 1, 0}, {4, 0, 1}};
    const std::vector<HalfEdge> next = link_edges(triangles, 5);
    EXPECT_EQ(next, (std::vector<HalfEdge>{4, 1, 2, 3, 7, 5, 6, 0, 8}));
}

TEST(LinkEdges, WindingPlaysNoPart) {
    EXPECT_EQ(link_edges(Triangles{{0, 1, 2}, {0, 1, 3}}, 4), (std::vector<HalfEdge>{3, 1, 2, 0, 4, 5}));
    EXPECT_EQ(link_edges(Triangles{{0, 1, 2}, {1, 0, 3}}, 4), (std::vector<HalfEdge>{3, 1, 2, 0, 4, 5}));
}

TEST(LinkEdges, NothingLinksNothing) {
    EXPECT_TRUE(link_edges(Triangles{}, 0).empty());
    EXPECT_TRUE(link_edges(Triangles{}, 7).empty());
}

TEST(LinkEdges, ManyTrianglesAroundOneVertexComeToAnEnd) {
    constexpr std::uint32_t kCount = 100000;
    Triangles fan;  // the hub is vertex 0, so that all spokes land in one bucket
    for (std::uint32_t i = 0; i < kCount; ++i) fan.push_back({0, 1 + i, 1 + (i + 1) % kCount});
    const std::vector<HalfEdge> next = link_edges(fan, kCount + 1);
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const std::uint32_t following = (i + 1) % kCount;
        ASSERT_EQ(next[3 * i + 2], 3 * following);
        ASSERT_EQ(next[3 * following], 3 * i + 2);
        ASSERT_EQ(next[3 * i + 1], 3 * i + 1);
    }
}

TEST(LinkEdges, ManyTrianglesAroundOneEdgeComeToAnEnd) {
    constexpr std::uint32_t kCount = 100000;
    Triangles book;
    for (std::uint32_t i = 0; i < kCount; ++i) book.push_back({1, 0, 2 + i});
    const std::vector<HalfEdge> next = link_edges(book, kCount + 2);
    for (std::uint32_t i = 0; i < kCount; ++i) ASSERT_EQ(next[3 * i], 3 * ((i + 1) % kCount));
}

TEST(IndexBorders, ListsTheHalfEdgesThatAreAlone) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.triangle_polygon = {7, 7};
    mesh.next_on_edge = link_edges(mesh.triangles, 4);
    const BorderIndex borders = index_borders(mesh);
    ASSERT_EQ(borders.segments().size(), 4u);
    const HalfEdge expected[] = {0, 1, 4, 5};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(borders.segments()[i].half_edge, expected[i]);
        EXPECT_EQ(borders.segments()[i].polygon, 7u);
    }
    EXPECT_EQ(borders.segments()[2].a, glm::dvec3(1, 1, 0));
    EXPECT_EQ(borders.segments()[2].b, glm::dvec3(0, 1, 0));
}

}  // namespace
}  // namespace burin
