#include "mesh/body_sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "mesh/build_meshes.h"
#include "mesh/shapes.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

/// With each polygon turned around or not.
Mesh mesh_of(const PolygonSoup& soup, const std::function<bool(std::size_t)>& is_turned) {
    PolygonSoup result;
    result.positions = soup.positions;
    for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
        std::vector<std::uint32_t> corners(soup.polygon(i).begin(), soup.polygon(i).end());
        if (is_turned(i)) std::reverse(corners.begin(), corners.end());
        result.add_polygon(corners);
    }
    return build_meshes(result, {}).front();
}

PolygonSoup two_boxes(glm::dvec3 apart) {
    PolygonSoup both = make_box({2, 1, 2});
    const PolygonSoup one = make_box({2, 1, 2});
    const auto first = static_cast<std::uint32_t>(both.positions.size());
    for (const glm::dvec3& p : one.positions) both.positions.push_back(p + apart);
    for (std::size_t i = 0; i < one.polygon_count(); ++i) {
        std::vector<std::uint32_t> corners(one.polygon(i).begin(), one.polygon(i).end());
        for (std::uint32_t& c : corners) c += first;
        both.add_polygon(corners);
    }
    return both;
}

// Also where two bodies share an edge or a corner.
TEST(BodySides, OfClosedBodiesHoweverTheyAreWound) {
    for (const PolygonSoup& soup : {make_box({1, 2, 0.001}), make_sphere(1, 12, 8), make_cylinder(1, 0, 2, 5),
                                    two_boxes({0, 1, 2}), two_boxes({2, 1, 2}), two_boxes({9, 0, 0})}) {
        for (int seed = 0; seed < 20; ++seed) {
            Random random(static_cast<std::uint64_t>(seed));
            std::vector<bool> turned;
            for (std::size_t i = 0; i < soup.polygon_count(); ++i)
                turned.push_back(seed > 0 && (seed == 1 || random.bits() % 2 != 0));
            const Mesh mesh = mesh_of(soup, [&](std::size_t i) { return turned[i]; });
            const auto sides = find_body_sides(mesh);
            ASSERT_EQ(sides.size(), mesh.triangles.size());
            for (std::uint32_t t = 0; t < sides.size(); ++t) {
                ASSERT_EQ(sides[t], turned[mesh.polygon_of(t)] ? 1 : -1) << seed << ", triangle " << t;
                for (std::uint32_t other = 0; other < sides.size(); ++other) {
                    ASSERT_TRUE(!are_wound_alike(mesh, t, other) || sides[t] == sides[other])
                        << seed << ", triangles " << t << ", " << other;
                }
                for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
                    const HalfEdge g = mesh.next_on_edge[h];
                    const bool are_two = g != h && mesh.next_on_edge[g] == h;
                    ASSERT_TRUE(!are_two || are_wound_alike(mesh, t, g / 3) == (sides[t] == sides[g / 3]) || seed > 1)
                        << seed << ", half-edge " << h;
                }
            }
        }
    }
}

// By a short way, a long way, or the sides of all: of one sphere the two poles are more than 64 triangles apart, and of
// two that are wound in opposite ways no way leads from one to the other.
TEST(BodySides, AreComparedAsAllSidesSay) {
    PolygonSoup two = make_sphere(1, 40, 40);
    const auto one = two.polygon_count();
    const auto first = static_cast<std::uint32_t>(two.positions.size());
    const PolygonSoup other = make_sphere(1, 40, 40);
    for (const glm::dvec3& p : other.positions) two.positions.push_back(p + glm::dvec3(5, 0, 0));
    for (std::size_t i = 0; i < other.polygon_count(); ++i) {
        std::vector<std::uint32_t> corners(other.polygon(i).begin(), other.polygon(i).end());
        for (std::uint32_t& c : corners) c += first;
        two.add_polygon(corners);
    }
    const Mesh mesh = mesh_of(two, [&](std::size_t i) { return i >= one; });
    const auto all = find_body_sides(mesh);
    const auto last = static_cast<std::uint32_t>(mesh.triangles.size() - 1);
    ASSERT_NE(all[0], all[last]);
    for (const std::uint32_t a : {0u, 7u, last / 4, last}) {
        const BodySides sides(mesh);
        for (std::uint32_t b = 0; b <= last; b += 61)
            EXPECT_EQ(sides.are_same(a, b), all[a] == all[b]) << a << ", " << b;
    }
    EXPECT_FALSE(are_wound_alike(mesh, 0, last / 2 - 40));
    EXPECT_TRUE(are_wound_alike(mesh, 0, last / 2 - 40, 1u << 14));
}

TEST(BodySides, AnOpenBoxIsABodyAndASheetIsNone) {
    PolygonSoup open, sheet;
    const PolygonSoup box = make_box({1, 1, 1});
    open.positions = sheet.positions = box.positions;
    for (std::size_t i = 0; i + 1 < box.polygon_count(); ++i) open.add_polygon(box.polygon(i));
    sheet.add_polygon(box.polygon(2));
    for (const std::int8_t side : find_body_sides(mesh_of(open, [](std::size_t) { return false; })))
        EXPECT_EQ(side, -1);
    for (const std::int8_t side : find_body_sides(mesh_of(sheet, [](std::size_t) { return false; })))
        EXPECT_EQ(side, 0);
}

// All edges of the face in the middle are edges of three or four.
TEST(BodySides, AFaceBetweenCellsIsOneOfABody) {
    PolygonSoup cells;
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            const PolygonSoup box = make_box({1, 1, 1});
            const auto first = static_cast<std::uint32_t>(cells.positions.size());
            for (const glm::dvec3& p : box.positions) cells.positions.push_back(p + glm::dvec3(x, y, 0));
            for (std::size_t i = 0; i < box.polygon_count(); ++i) {
                std::vector<std::uint32_t> corners(box.polygon(i).begin(), box.polygon(i).end());
                for (std::uint32_t& c : corners) c += first;
                cells.add_polygon(corners);
            }
        }
    }
    const Mesh mesh = build_meshes(cells, {}).front();
    const auto sides = find_body_sides(mesh);
    for (std::uint32_t t = 0; t < sides.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const bool is_front = mesh.positions[a].z > 0 && mesh.positions[b].z > 0 && mesh.positions[c].z > 0;
        if (is_front) {
            EXPECT_EQ(sides[t], -1) << t;
        }
    }
}

}  // namespace
}  // namespace burin
