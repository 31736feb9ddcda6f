#include "lines/sharp_edges.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/build_meshes.h"
#include "tests/support/drawing.h"

namespace burin {
namespace {

using namespace test;

/// Whether the edge from vertex 0 to vertex 1 is sharp, for the first triangle.
bool is_sharp(const std::vector<std::vector<std::uint32_t>>& polygons, double fold_deg = 0, LineClassSet classes = kDefaultLineClasses) {
    const double a = fold_deg * M_PI / 180;
    const Mesh mesh = build_meshes(soup_of({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -std::cos(a), std::sin(a)}, {0.5, 0, 1}, {1, 1, 0}}, polygons), {}).front();
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

}  // namespace
}  // namespace burin
