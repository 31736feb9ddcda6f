#include "mesh/stitch_cracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <tuple>

#include "mesh/build_meshes.h"
#include "mesh/split_borders.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;
using test::soup_of;
using Polygon = std::vector<glm::dvec3>;
using Surface = std::function<glm::dvec3(double, double)>;

/// A strip or grid of quadrilaterals.
void add_patch(std::vector<Polygon>& polygons, const Surface& at, glm::dvec2 low, glm::dvec2 high, int columns,
               int rows) {
    const auto corner = [&](int i, int j) {
        return at(glm::mix(low.x, high.x, double(i) / columns), glm::mix(low.y, high.y, double(j) / rows));
    };
    for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j)
            polygons.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
}

glm::dvec3 torus(double u, double v) {
    const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v, r = 1 + 0.4 * std::cos(b);
    return {r * std::cos(a), 0.4 * std::sin(b), r * std::sin(a)};
}

/// Every corner of every polygon moved by itself.
Mesh shaken(const std::vector<Polygon>& polygons, double by, std::uint64_t seed) {
    Random random(seed);
    PolygonSoup soup = soup_of({}, {});
    for (const Polygon& polygon : polygons) {
        std::vector<std::uint32_t> corners;
        for (const glm::dvec3& p : polygon) {
            corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
            soup.positions.push_back(p + random.in_box(by));
        }
        soup.add_polygon(corners);
    }
    return build_meshes(soup, {}).at(0);
}

CrackReach everywhere(double reach) {
    return [reach](const glm::dvec3&) { return reach; };
}

double length_of_borders(const Mesh& mesh) {
    double sum = 0;
    for (const BorderIndex::Segment& s : mesh.borders.segments())
        sum += glm::distance(glm::dvec3(s.a), glm::dvec3(s.b));
    return sum;
}

/// Corners of all triangles, in an order that says nothing about theirs.
std::vector<std::array<float, 9>> sorted_triangles(const Mesh& mesh) {
    std::vector<std::array<float, 9>> all;
    for (const auto& t : mesh.triangles) {
        std::array<glm::vec3, 3> c{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
        std::sort(c.begin(), c.end(), [](const glm::vec3& p, const glm::vec3& q) {
            return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
        });
        all.push_back({c[0].x, c[0].y, c[0].z, c[1].x, c[1].y, c[1].z, c[2].x, c[2].y, c[2].z});
    }
    std::sort(all.begin(), all.end());
    return all;
}

TEST(StitchCracks, PolygonsThatFellApartAreOneSurface) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Random random(seed);
        std::vector<Polygon> polygons;
        add_patch(polygons, torus, {0, 0}, {1, 1}, random.integer(12, 40), random.integer(8, 20));
        const double by =
            random.real(0.0001, 0.008);  // corners of one place are no farther apart than a third of any edge
        const Mesh cracked = shaken(polygons, by, seed);
        const auto whole = stitch_cracks(cracked, everywhere(14 * by), 2);
        ASSERT_TRUE(whole) << seed;
        EXPECT_TRUE(whole->borders.segments().empty()) << seed;
        for (HalfEdge h = 0; h < whole->next_on_edge.size(); ++h) {
            EXPECT_EQ(whole->next_on_edge[whole->next_on_edge[h]], h) << seed;  // two at every edge
        }
        EXPECT_EQ(whole->polygon_count, cracked.polygon_count);
        EXPECT_EQ(whole->triangles.size(), cracked.triangles.size());
        for (std::size_t t = 0; t < whole->triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::vec3 before = cracked.positions[cracked.triangles[t][k]],
                                after = whole->positions[whole->triangles[t][k]];
                EXPECT_LT(glm::distance(before, after), 2 * std::sqrt(3.0) * by) << seed;
            }
        }
    }
}

TEST(StitchCracks, BordersWithDifferentCornersBecomeOne) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Random random(seed);
        std::vector<Polygon> polygons;
        const int strips = random.integer(6, 12);
        for (int i = 0; i < strips; ++i)
            add_patch(polygons, torus, {0, double(i) / strips}, {1, (i + 1.0) / strips}, random.integer(40, 90), 1);
        const Mesh cracked = shaken(polygons, 0.001, seed);
        const auto whole = stitch_cracks(cracked, everywhere(0.02), 2);
        ASSERT_TRUE(whole) << seed;
        // Where corners of both sides are nearly, but not quite, in one place, short slits may be left.
        EXPECT_LT(length_of_borders(*whole), 0.02 * length_of_borders(cracked)) << seed;
        EXPECT_EQ(whole->polygon_count, cracked.polygon_count);
        for (std::uint32_t t = 0; t < whole->triangles.size(); ++t) {
            const auto& c = whole->triangles[t];
            const glm::dvec3 a(whole->positions[c[0]]), b(whole->positions[c[1]]), d(whole->positions[c[2]]);
            EXPECT_GT(glm::dot(glm::cross(b - a, d - a), whole->polygon_area_vector(t)), 0) << seed;
        }
    }
}

TEST(StitchCracks, AFloorOfTilesHasNoBordersInside) {
    for (const double by : {0.0, 0.002}) {
        std::vector<Polygon> polygons;
        const Surface floor = [](double x, double z) { return glm::dvec3(x, 0, z); };
        for (int row = 0; row < 4; ++row) add_patch(polygons, floor, {0, row}, {10, row + 1}, 3 + 2 * row, 1);
        const Mesh cracked = shaken(polygons, by, 1);
        const auto whole = stitch_cracks(cracked, everywhere(0.05), 2);
        ASSERT_TRUE(whole);
        EXPECT_NEAR(length_of_borders(*whole), 28, 0.1) << by;
    }
}

TEST(StitchCracks, DoNotDependOnTheNumberOfThreads) {
    std::vector<Polygon> polygons;  // thousands of borders, more than one thread takes at once
    constexpr int kStrips = 12;
    for (int i = 0; i < kStrips; ++i)
        add_patch(polygons, torus, {0, double(i) / kStrips}, {1, (i + 1.0) / kStrips}, 60 + 7 * i, 1);
    const Mesh cracked = shaken(polygons, 0.001, 3);
    ASSERT_GT(cracked.borders.segments().size(), 8 * kBordersAtOnce);
    const auto of_one = stitch_cracks(cracked, everywhere(0.02), 1),
               of_three = stitch_cracks(cracked, everywhere(0.02), 3);
    ASSERT_TRUE(of_one && of_three);
    EXPECT_EQ(of_one->positions, of_three->positions);
    EXPECT_EQ(of_one->triangles, of_three->triangles);
}

TEST(StitchCracks, DoNotDependOnTheOrderOfPolygons) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        Random random(seed);
        std::vector<Polygon> polygons;
        add_patch(polygons, torus, {0, 0}, {1, 0.5}, 24, 8);
        add_patch(polygons, torus, {0, 0.5}, {1, 1}, 31, 8);
        for (Polygon& polygon : polygons) {
            for (glm::dvec3& p : polygon) p += random.in_box(0.004);
        }
        const auto stitched = [&] {
            return sorted_triangles(stitch_cracks(shaken(polygons, 0, 0), everywhere(0.03), 2).value());
        };
        const auto first = stitched();
        for (std::size_t i = polygons.size(); i > 1; --i) {
            std::swap(polygons[i - 1], polygons[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
        }
        EXPECT_EQ(stitched(), first) << seed;
    }
}

TEST(StitchCracks, WhatIsNoCrackStays) {
    const Polygon square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const auto moved = [&](glm::dvec3 by) {
        Polygon result = square;
        for (glm::dvec3& p : result) p += by;
        return result;
    };
    const auto is_stitched = [](const std::vector<Polygon>& polygons, double reach) {
        return stitch_cracks(shaken(polygons, 0, 0), everywhere(reach), 2).has_value();
    };
    EXPECT_TRUE(is_stitched({square, moved({1.01, 0, 0})}, 0.02));
    EXPECT_FALSE(is_stitched({square, moved({1.01, 0, 0})}, 0.009));  // too wide to reach over
    EXPECT_FALSE(is_stitched({square, moved({1.01, 0, 0})}, 0));
    EXPECT_FALSE(is_stitched({square, moved({1.01, 0, 0})}, -1));
    EXPECT_FALSE(is_stitched({square, moved({1.4, 0, 0})}, 10));        // too wide for its length
    EXPECT_FALSE(is_stitched({square, moved({0, 0, 0.01})}, 0.02));     // a stack
    EXPECT_FALSE(is_stitched({square, moved({1.01, 1.01, 0})}, 0.02));  // corner to corner
    EXPECT_FALSE(is_stitched({square}, 10));
    EXPECT_FALSE(stitch_cracks(Mesh{}, everywhere(1), 2));
}

// However far it may reach.
TEST(StitchCracks, NoTriangleCollapsesOrTurnsOver) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        std::vector<Polygon> polygons;
        const Surface hills = [&](double x, double y) {
            return glm::dvec3(x, y, 0.3 * std::sin(5 * x) * std::cos(4 * y));
        };
        for (int i = 0; i < 4; ++i)
            add_patch(polygons, hills, {i, 0}, {i + 1, 4}, random.integer(1, 5), random.integer(1, 9));
        const Mesh cracked = shaken(polygons, random.real(0, 0.2), seed);
        const auto whole = stitch_cracks(cracked, everywhere(std::pow(10.0, random.real(-3, 1))), 2);
        if (!whole) continue;
        for (std::uint32_t t = 0; t < whole->triangles.size(); ++t) {
            const auto& c = whole->triangles[t];
            EXPECT_TRUE(c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) << seed;
            const glm::dvec3 a(whole->positions[c[0]]), b(whole->positions[c[1]]), d(whole->positions[c[2]]);
            EXPECT_GT(glm::length(glm::cross(b - a, d - a)), 0) << seed;
        }
        EXPECT_TRUE(std::is_sorted(whole->triangle_polygon.begin(), whole->triangle_polygon.end())) << seed;
        EXPECT_EQ(whole->next_on_edge.size(), 3 * whole->triangles.size());
    }
}

// A pole that was one corner: its quadrilaterals have two corners there, and a short edge between them.
TEST(StitchCracks, PolesHaveNoHoles) {
    const Surface sphere = [](double u, double v) {
        const double a = 2 * std::numbers::pi * u, b = std::numbers::pi * v;
        return glm::dvec3(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
    };
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        std::vector<Polygon> polygons;
        add_patch(polygons, sphere, {0, 0}, {1, 1}, 12, 8);
        const Mesh cracked = shaken(polygons, 0.001, seed);
        const auto whole = stitch_cracks(cracked, everywhere(0.05), 2);
        ASSERT_TRUE(whole) << seed;
        // Two short edges may have been joined before they could be taken out.
        EXPECT_LT(length_of_borders(*whole), 0.01) << seed;
        EXPECT_EQ(whole->polygon_count, cracked.polygon_count);
        EXPECT_NEAR(static_cast<double>(whole->triangles.size()),
                    static_cast<double>(cracked.triangles.size()) - 2 * 12, 4)
            << seed;
        EXPECT_EQ(whole->triangle_polygon.size(), whole->triangles.size());
    }
}

TEST(StitchCracks, ThinStripsAndSlatsStay) {
    std::vector<Polygon> hairs, slats;
    for (int i = 0; i < 40; ++i) {
        const glm::dvec3 at(0, i, 0), slat(0, 0.7 * i, 0);
        hairs.push_back({at, at + glm::dvec3(20, 0.3, 0), at + glm::dvec3(20, 0.4, 0), at + glm::dvec3(0, 0.1, 0)});
        hairs.push_back({at + glm::dvec3(0, 0, 5), at + glm::dvec3(20, 0.1, 5), at + glm::dvec3(0, 0.1, 5)});
        // These are as far apart as they are high.
        slats.push_back(
            {slat, slat + glm::dvec3(30, 0, 0), slat + glm::dvec3(30, 0.35, 0.5), slat + glm::dvec3(0, 0.35, 0.5)});
    }
    EXPECT_FALSE(stitch_cracks(shaken(hairs, 0, 0), everywhere(1), 2));
    EXPECT_FALSE(stitch_cracks(shaken(slats, 0, 0), everywhere(1), 2));
    // Cones and tubes that are open and thinner than what a needle's end is.
    const Surface cone = [](double u, double v) {
        const double a = 2 * std::numbers::pi * u;
        return glm::dvec3(0.05 * v * std::cos(a), 0.05 * v * std::sin(a), 20 * v);
    };
    const Surface tube = [](double u, double v) {
        const double a = 2 * std::numbers::pi * u;
        return glm::dvec3(0.05 * std::cos(a), 0.05 * std::sin(a), 20 * v);
    };
    for (const Surface& surface : {cone, tube}) {
        std::vector<Polygon> polygons;
        add_patch(polygons, surface, {0, 0}, {1, 1}, 8, 1);
        const Mesh thin = shaken(polygons, 0, 0);
        const auto whole = stitch_cracks(thin, everywhere(1), 2);
        EXPECT_EQ((whole ? *whole : thin).triangles.size(), thin.triangles.size());
    }
}

/// Blades with a midrib, flat and folded: their two borders are no crack, though hardly anything is between them.
TEST(StitchCracks, ThinBladesOfSeveralColumnsStay) {
    for (const double width : {0.04, 0.1, 0.12, 0.2}) {
        for (const double fold : {0.0, 0.2, 1.0, 2.0, 8.0}) {
            for (const int columns : {2, 3, 4}) {
                if (columns > 2 && fold > 0.2) continue;  // a zigzag that is folded sharply is no blade
                const Surface blade = [&](double u, double v) {
                    const double off = std::abs(std::remainder(columns * v, 2.0));  // 0 at one border, 1 at the midrib
                    return glm::dvec3(width * v, 20 * u, fold * width * off);
                };
                for (const int rows : {1, 4}) {
                    std::vector<Polygon> polygons;
                    add_patch(polygons, blade, {0, 0}, {1, 1}, rows, columns);
                    const Mesh thin = shaken(polygons, 0, 0);
                    const auto whole = stitch_cracks(thin, everywhere(1), 2);
                    const double before = length_of_borders(thin), after = length_of_borders(whole ? *whole : thin);
                    EXPECT_NEAR(after, before, 0.1 * before) << width << " " << fold << " " << columns << " " << rows;
                }
            }
        }
    }
}

TEST(StitchCracks, SmallPolygonsAreNoNeedles) {
    std::vector<Polygon> specks;
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 at(i, 0, 0);
        specks.push_back(
            {at, at + glm::dvec3(0.01, 0, 0), at + glm::dvec3(0.01, 0.01, 0), at + glm::dvec3(0, 0.01, 0)});
        specks.push_back({at + glm::dvec3(0, 0.5, 0), at + glm::dvec3(0.01, 0.5, 0), at + glm::dvec3(0.005, 0.51, 0)});
    }
    EXPECT_FALSE(stitch_cracks(shaken(specks, 0, 0), everywhere(1), 2));
}

TEST(StitchCracks, MarksGoOnOverBothSides) {
    PolygonSoup soup = soup_of({{0, 0, 0},
                                {2, 0, 0},
                                {2, 1, 0},
                                {0, 1, 0},
                                {0, -1, 0},
                                {1, -1, 0},
                                {1, -0.01, 0},
                                {0, -0.01, 0},
                                {1, -0.01, 0},
                                {1, -1, 0},
                                {2, -1, 0},
                                {2, -0.01, 0}},
                               {{0, 1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10, 11}});
    soup.marked_edges = {{0, 1}};
    const auto whole = stitch_cracks(build_meshes(soup, {}).at(0), everywhere(0.02), 2);
    ASSERT_TRUE(whole);
    int marked = 0;
    for (HalfEdge h = 0; h < whole->next_on_edge.size(); ++h) {
        if (!whole->is_marked(h)) continue;
        ++marked;
        EXPECT_NE(whole->next_on_edge[h], h);
    }
    EXPECT_EQ(marked, 4);  // cut in two, on both sides
}

/// Where the ends of hundreds lie beside each border, none is cut: that would take time that grows with their square.
/// As many triangles that lie apart are cut as ever.
TEST(StitchCracks, BordersInPilesAreNotCut) {
    constexpr std::uint32_t kTriangles = 12000, kCorners = 400;
    Random random(7);
    PolygonSoup pile = soup_of({}, {});
    for (std::uint32_t i = 0; i < kCorners; ++i) pile.positions.push_back({random.real(0, 1), random.real(0, 1), 0});
    for (std::uint32_t i = 0; i < kTriangles; ++i) {
        std::array<std::uint32_t, 3> t{};
        for (std::uint32_t& corner : t) corner = static_cast<std::uint32_t>(random.integer(0, kCorners - 1));
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) pile.add_polygon(t);
    }
    EXPECT_FALSE(split_borders(build_meshes(pile, {}).at(0), everywhere(0.02), 1).has_value());

    PolygonSoup apart = soup_of({}, {});
    for (std::uint32_t i = 0; i < kTriangles / 4; ++i) {
        const double x = 3.0 * (i % 32), y = 3.0 * (i / 32);
        const auto add = [&](std::initializer_list<glm::dvec3> corners) {
            std::vector<std::uint32_t> polygon;
            for (const glm::dvec3& corner : corners) {
                polygon.push_back(static_cast<std::uint32_t>(apart.positions.size()));
                apart.positions.push_back(corner);
            }
            apart.add_polygon(polygon);
        };
        add({{x, y, 0}, {x + 2, y, 0}, {x + 1, y - 1, 0}});  // its upper side is cut by the corner of the next two
        add({{x, y, 0}, {x + 1, y, 0}, {x, y + 1, 0}});
        add({{x + 1, y, 0}, {x + 2, y, 0}, {x + 2, y + 1, 0}});
    }
    const Mesh mesh = build_meshes(apart, {}).at(0);
    const auto cut = split_borders(mesh, everywhere(0.02), 1);
    ASSERT_TRUE(cut.has_value());
    EXPECT_EQ(cut->triangles.size(), mesh.triangles.size() + kTriangles / 4);
}

}  // namespace
}  // namespace burin
