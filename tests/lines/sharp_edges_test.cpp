#include "lines/sharp_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "mesh/build_meshes.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

/// Whether the edge from vertex 0 to vertex 1 is sharp, for the first triangle.
bool is_sharp(const std::vector<std::vector<std::uint32_t>>& polygons, double fold_deg = 0,
              LineClassSet classes = kDefaultLineClasses) {
    const double a = fold_deg * M_PI / 180;
    const Mesh mesh =
        build_meshes(
            soup_of({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -std::cos(a), std::sin(a)}, {0.5, 0, 1}, {1, 1, 0}},
                    polygons),
            {})
            .front();
    LineCriteria criteria;
    criteria.classes = classes;
    const std::vector<std::uint8_t> sharp = find_sharp_edges(mesh, criteria);
    for (HalfEdge h = 0; h < 3; ++h) {
        const glm::vec3 p = mesh.positions[mesh.triangles[0][h]], q = mesh.positions[mesh.triangles[0][(h + 1) % 3]];
        if (p.y == 0 && q.y == 0) return (sharp[0] >> h & 1) != 0;
    }
    ADD_FAILURE() << "no such edge";
    return false;
}

// All of triangles, and with a polygon of four corners beside them, which is another way through the code.
TEST(SharpEdges, AreWhereDecisionsMustLook) {
    for (const bool has_quad : {false, true}) {
        const auto with = [&](std::vector<std::vector<std::uint32_t>> polygons) {
            if (has_quad) polygons.push_back({0, 2, 5, 4});
            return polygons;
        };
        EXPECT_TRUE(is_sharp(with({{0, 1, 2}}))) << "a border";
        EXPECT_FALSE(is_sharp(with({{0, 1, 2}, {1, 0, 3}})));
        EXPECT_TRUE(is_sharp(with({{0, 1, 2}, {0, 1, 3}}), 0, LineClass::silhouette)) << "wound the other way";
        EXPECT_TRUE(is_sharp(with({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}))) << "three triangles";
        EXPECT_FALSE(is_sharp(with({{0, 1, 2}, {1, 0, 3}}), 39));
        EXPECT_TRUE(is_sharp(with({{0, 1, 2}, {1, 0, 3}}), 41));
        EXPECT_FALSE(is_sharp(with({{0, 1, 2}, {1, 0, 3}}), 41, LineClass::silhouette));
        EXPECT_TRUE(is_sharp(with({{0, 1, 2}, {1, 0, 3}}), 0, LineClass::polygon));
    }
}

/// A bumpy sheet, of any size and away from 0, where most angles are near one angle.
Mesh folded_sheet(Random& random, double fold_deg) {
    const int rows = random.integer(1, 20), columns = random.integer(1, 20);
    const double size = std::exp2(random.integer(-30, 30)), length = random.integer(0, 3) == 0 ? 300 : 1,
                 up = std::sin(0.5 * fold_deg * M_PI / 180);
    const double noise = random.integer(0, 1) * 1e-4, forward = std::cos(0.5 * fold_deg * M_PI / 180);
    std::vector<glm::dvec3> positions;
    std::vector<std::vector<std::uint32_t>> triangles;
    for (int r = 0; r <= rows; ++r) {
        for (int c = 0; c <= columns; ++c)
            positions.push_back(size * (glm::dvec3(forward * c, length * r, c % 2 * up) + noise * random.in_box(1)));
    }
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            const auto a = static_cast<std::uint32_t>(r * (columns + 1) + c),
                       b = a + static_cast<std::uint32_t>(columns) + 1;
            triangles.push_back({a, a + 1, b});
            triangles.push_back(random.integer(0, 9) == 0 ? std::vector{b, b + 1, a + 1}
                                                          : std::vector{b + 1, b, a + 1});
        }
    }
    return build_meshes(soup_of(positions, triangles), {}).front();
}

/// Rough normals tell what is far from the angle only.
TEST(SharpEdges, AreThoseThatExactNormalsTell) {
    std::size_t sharp = 0, smooth = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        const double fold_deg = random.integer(1, 179);
        Mesh mesh = folded_sheet(random, fold_deg);
        LineCriteria criteria;
        criteria.classes = LineClass::crease;
        criteria.cos_crease_angle =
            std::cos(fold_deg * M_PI / 180) + random.integer(-5, 5) * std::pow(10, -random.integer(2, 7));
        const std::vector<std::uint8_t> found = find_sharp_edges(mesh, criteria, random.integer(1, 2));
        mesh.triangle_polygon.resize(mesh.triangles.size());  // the way through the code that takes no rough normals
        std::iota(mesh.triangle_polygon.begin(), mesh.triangle_polygon.end(), 0u);
        ASSERT_EQ(found, find_sharp_edges(mesh, criteria)) << "seed " << seed;
        for (const std::uint8_t edges : found) {
            sharp += static_cast<std::size_t>(std::popcount(edges & 7u));
            smooth += static_cast<std::size_t>(3 - std::popcount(edges & 7u));
        }
    }
    EXPECT_GT(std::min(sharp, smooth), 10000u);
}

}  // namespace
}  // namespace burin
