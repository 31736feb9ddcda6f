// Polygons that cross themselves cover what the even-odd rule says.

#include "mesh/self_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "mesh/model.h"
#include "mesh/triangulate.h"
#include "tests/mesh/model_files.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::Polygons;
using test::polygons_of;
using test::Random;
using Outline = std::vector<glm::dvec2>;

PolygonSoup soup_of(const std::vector<glm::dvec3>& corners) {
    PolygonSoup soup;
    soup.positions = corners;
    std::vector<std::uint32_t> polygon(corners.size());
    std::iota(polygon.begin(), polygon.end(), 0u);
    soup.add_polygon(polygon);
    return soup;
}
PolygonSoup cut(PolygonSoup soup) {
    cut_at_self_crossings("a.obj", soup);
    return soup;
}
PolygonSoup cut(const Outline& outline) {
    std::vector<glm::dvec3> corners;
    for (const glm::dvec2& p : outline) corners.emplace_back(p, 0);
    return cut(soup_of(corners));
}

/// How many triangles of all polygons a point lies in.
int layers_at(const PolygonSoup& soup, glm::dvec2 p) {
    int layers = 0;
    for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
        std::vector<glm::dvec3> corners;
        for (const std::uint32_t v : soup.polygon(i)) corners.push_back(soup.positions[v]);
        std::vector<std::array<std::uint32_t, 3>> triangles;
        triangulate_polygon(corners, triangles);
        for (const auto& t : triangles) {
            int left = 0, right = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec2 a(corners[t[k]]), b(corners[t[(k + 1) % 3]]);
                const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
                left += side > 0;
                right += side < 0;
            }
            layers += left == 3 || right == 3;
        }
    }
    return layers;
}

bool is_inside(const Outline& outline, glm::dvec2 p) {
    bool inside = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
        if ((a.y > p.y) == (b.y > p.y)) continue;
        if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
    return inside;
}

double distance_to_sides(const Outline& outline, glm::dvec2 p) {
    double nearest = 1e9;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i], d = outline[(i + 1) % outline.size()] - a;
        const double t = glm::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0);
        nearest = std::min(nearest, glm::distance(p, a + t * d));
    }
    return nearest;
}

TEST(SelfCrossings, ABowTieIsTwoTriangles) {
    const PolygonSoup soup = cut(Outline{{0, 0}, {1, 1}, {1, 0}, {0, 1}});
    EXPECT_EQ(polygons_of(soup), (Polygons{{0, 4, 3}, {1, 4, 2}}));
    ASSERT_EQ(soup.positions.size(), 5u);
    EXPECT_EQ(soup.positions[4], glm::dvec3(0.5, 0.5, 0));
    EXPECT_TRUE(soup.notes.empty());
}

TEST(SelfCrossings, ThePolygonsAroundStayAndSoDoTheirObjects) {
    PolygonSoup soup = soup_of({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}});
    soup.corners = {0, 1, 2, 0, 1, 2, 3, 1, 2, 3};
    soup.polygon_ends = {3, 7, 10};
    soup.polygon_object = {0, 1, 2};
    soup.polygon_material = {5, 6, 7};
    soup = cut(soup);
    EXPECT_EQ(polygons_of(soup), (Polygons{{0, 1, 2}, {0, 4, 3}, {1, 4, 2}, {1, 2, 3}}));
    EXPECT_EQ(soup.polygon_object, (std::vector<std::uint32_t>{0, 1, 1, 2}));
    EXPECT_EQ(soup.polygon_material, (std::vector<std::uint32_t>{5, 6, 6, 7}));
}

TEST(SelfCrossings, APentagramIsFiveTips) {
    Outline outline;
    for (int i = 0; i < 5; ++i) outline.emplace_back(std::cos(2.513274 * i), std::sin(2.513274 * i));
    const PolygonSoup soup = cut(outline);
    EXPECT_EQ(soup.polygon_count(), 5u);
    for (const auto& polygon : polygons_of(soup)) EXPECT_EQ(polygon.size(), 3u);
    EXPECT_EQ(soup.positions.size(), 10u);
    EXPECT_EQ(layers_at(soup, {0, 0}), 0);
    EXPECT_EQ(layers_at(soup, {0.7, 0}), 1);
}

TEST(SelfCrossings, ALoopWithinIsAHole) {
    const Outline outline{{0, 0}, {10, 0}, {10, 10}, {4, 4}, {6, 4}, {0, 10}};  // the small loop turns the same way
    const PolygonSoup soup = cut(outline);
    EXPECT_EQ(layers_at(soup, {1, 5}), 1);
    EXPECT_EQ(layers_at(soup, {5, 4.5}), 0) << "inside of the loop";
    EXPECT_EQ(layers_at(soup, {5, 1}), 1);
    EXPECT_EQ(layers_at(soup, {5, 9}), 0);
}

TEST(SelfCrossings, ACornerOnASideMayBeACrossing) {
    const Outline outline{{0, 0}, {2, 0}, {1, 1}, {0, 2}, {2, 2}};  // its third corner lies on its last side
    const PolygonSoup soup = cut(outline);
    EXPECT_EQ(polygons_of(soup), (Polygons{{0, 1, 2}, {3, 2, 4}}));
    const Outline only_touches{{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}};
    EXPECT_EQ(polygons_of(cut(only_touches)), (Polygons{{0, 1, 2, 3, 4}}));
}

// Against the rule itself, at random points, in any plane and from any first corner.
TEST(SelfCrossings, CoverWhatTheEvenOddRuleSays) {
    int crossing = 0;
    for (std::uint64_t seed = 0; seed < 600; ++seed) {
        Random random(seed);
        Outline outline;
        const int n = random.integer(4, seed % 10 == 0 ? 24 : 9);
        for (int i = 0; i < n; ++i) outline.emplace_back(random.real(-1, 1), random.real(-1, 1));
        const PolygonSoup soup = cut(outline);
        ASSERT_TRUE(soup.notes.empty()) << seed;
        crossing += soup.polygon_count() > 1;
        for (int k = 0; k < 60; ++k) {
            const glm::dvec2 p(random.real(-1, 1), random.real(-1, 1));
            if (distance_to_sides(outline, p) < 1e-6) continue;
            ASSERT_EQ(layers_at(soup, p), is_inside(outline, p) ? 1 : 0) << seed << ": " << p.x << ' ' << p.y;
        }
        for (const auto& polygon : polygons_of(soup)) {
            for (std::size_t k = 0; k < polygon.size(); ++k) {
                const glm::dvec2 a(soup.positions[polygon[k]]), b(soup.positions[polygon[(k + 1) % polygon.size()]]);
                ASSERT_LT(distance_to_sides(outline, 0.5 * (a + b)), 1e-9) << seed << ": no side of the polygon";
            }
        }
    }
    EXPECT_GT(crossing, 300);
}

TEST(SelfCrossings, DoNotDependOnThePlane) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        const glm::dvec3 z = random.direction(), x = glm::normalize(glm::cross(random.direction(), z));
        const glm::dmat3 axes(x, glm::cross(z, x), z);
        const glm::dvec3 origin = random.in_box(100);
        std::vector<glm::dvec3> flat, turned;
        for (int i = random.integer(4, 8); i > 0; --i) {
            flat.emplace_back(random.real(-1, 1), random.real(-1, 1), 0);
            turned.push_back(origin + axes * flat.back());
        }
        const PolygonSoup a = cut(soup_of(flat)), b = cut(soup_of(turned));
        ASSERT_EQ(a.polygon_count(), b.polygon_count()) << seed;
        ASSERT_EQ(a.positions.size(), b.positions.size()) << seed;
        for (const glm::dvec3& p : a.positions) {
            double nearest = 1;
            for (const glm::dvec3& q : b.positions) nearest = std::min(nearest, glm::distance(origin + axes * p, q));
            ASSERT_LT(nearest, 1e-9) << seed;
        }
    }
}

TEST(SelfCrossings, OthersStayAsTheyAre) {
    const auto expect_same = [](const std::vector<glm::dvec3>& corners) {
        const PolygonSoup before = soup_of(corners), after = cut(before);
        EXPECT_EQ(after.corners, before.corners);
        EXPECT_EQ(after.polygon_ends, before.polygon_ends);
        EXPECT_EQ(after.positions, before.positions);
        EXPECT_TRUE(after.notes.empty());
    };
    expect_same({{0, 0, 0}, {1, 1, 0.1}, {1, 0, 0}, {0, 1, 0}});  // not flat
    expect_same({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {0.5, 0.5, 0}});
    expect_same({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
    expect_same(
        {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}});
    expect_same({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5, 1e-9, 0}, {0.5, -1e-9, 0}, {0, 1, 0}});  // by rounding alone
}

TEST(SelfCrossings, OfAFileAreCutUnlessItIsSubdivided) {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("bow.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n");
    const Model model = read_model(path, {});
    ASSERT_EQ(model.meshes.size(), 1u);
    EXPECT_EQ(model.meshes[0].triangles.size(), 2u);
    EXPECT_EQ(model.meshes[0].positions.size(), 5u);
    const EdgeCounts edges = count_edges(model.meshes[0]);
    EXPECT_EQ(edges.edges, 6u);
    EXPECT_EQ(edges.border, 6u);
    MeshOptions options;
    options.subdivision_levels = 1;
    EXPECT_EQ(read_model(path, options).meshes[0].polygon_count, 4u) << "a quadrilateral becomes four";
}

TEST(SelfCrossings, OfVeryManyCornersAreNoted) {
    const auto flower = [](int corners, double loops) {
        Outline outline;
        for (int i = 0; i < corners; ++i) {
            const double a = 6.283185307 * i / corners;
            outline.push_back((1 + 1.5 * std::cos(loops * a)) * glm::dvec2(std::cos(a), std::sin(a)));
        }
        return outline;
    };
    EXPECT_TRUE(cut(flower(256, 3)).notes.empty());
    EXPECT_GT(cut(flower(256, 3)).polygon_count(), 1u);
    const PolygonSoup large = cut(flower(257, 3));
    EXPECT_EQ(large.polygon_count(), 1u);
    ASSERT_EQ(large.notes.size(), 1u);
    EXPECT_NE(large.notes[0].find("polygons that cross themselves and are not cut where they do: 1"),
              std::string::npos);
    Outline circle;
    for (int i = 0; i < 5000; ++i)
        circle.emplace_back(std::cos(0.001 * i), (i % 2 == 0 ? 1 : 0.9) * std::sin(0.001 * i));
    EXPECT_TRUE(cut(circle).notes.empty());
}

TEST(SelfCrossings, OfVeryManyCrossingsAreNoted) {
    Random random(1);
    Outline tangle;
    for (int i = 0; i < 200; ++i) tangle.emplace_back(random.real(-1, 1), random.real(-1, 1));
    const PolygonSoup soup = cut(tangle);
    EXPECT_EQ(soup.polygon_count(), 1u);
    EXPECT_EQ(soup.notes.size(), 1u);
}

}  // namespace
}  // namespace burin
