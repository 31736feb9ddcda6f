#include "mesh/triangulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Outline = std::vector<glm::dvec2>;

constexpr double kTurn = 2 * std::numbers::pi;

glm::dvec2 polar(double angle, double radius) { return radius * glm::dvec2(std::cos(angle), std::sin(angle)); }

double area_of(const Outline& outline) {
    double twice = 0;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
        twice += outline[j].x * outline[i].y - outline[i].x * outline[j].y;
    }
    return twice / 2;
}

/// Corners at growing angles, at any distance: simple, usually with many reflex corners.
Outline star(Random& random, int corners, double low, double high) {
    Outline outline;
    for (int i = 0; i < corners; ++i) {
        outline.push_back(polar(kTurn * (i + random.real(0, 0.8)) / corners, random.real(low, high)));
    }
    return outline;
}

/// A band that winds around the origin.
Outline spiral(int corners, double turns) {
    Outline outline;
    const int half = corners / 2;
    for (int i = 0; i < half; ++i) {
        const double t = turns * i / (half - 1);
        outline.push_back(polar(kTurn * t, 1 + t));
    }
    for (int i = half; i-- > 0;) {
        const double t = turns * i / (half - 1);
        outline.push_back(polar(kTurn * t, 0.5 + t));
    }
    return outline[0].x == outline.back().x ? outline : Outline(outline.rbegin(), outline.rend());
}

Outline comb(Random& random, int teeth) {
    Outline outline{{2.0 * teeth, 0}, {2.0 * teeth, -1}, {0, -1}, {0, 0}};
    for (int i = 0; i < teeth; ++i) {
        outline.emplace_back(2 * i + 0.5, random.real(1, 5));
        outline.emplace_back(2 * i + 1.0, random.real(0, 0.9));
    }
    return Outline(outline.rbegin(), outline.rend());
}

/// Steps along a grid: runs of corners on exactly one line, also reflex ones.
Outline stairs(Random& random, int steps) {
    Outline outline;
    int x = 0, y = 0;
    for (int i = 0; i < steps; ++i) {
        for (int k = random.integer(1, 4); k > 0; --k) outline.emplace_back(x++, y);
        for (int k = random.integer(1, 4); k > 0; --k) outline.emplace_back(x, y++);
    }
    for (; y > -2; --y) {
        if (random.integer(0, 1) == 1 || y == -1) outline.emplace_back(x + 3, y);
    }
    outline.emplace_back(x + 3, -2);
    for (; x > -1; --x) {
        if (random.integer(0, 1) == 1) outline.emplace_back(x, -2);
    }
    outline.emplace_back(-1, -2);
    outline.emplace_back(-1, -1);
    outline.emplace_back(-1, 0);
    return Outline(outline.rbegin(), outline.rend());
}

/// A ring: an outer and an inner outline, joined by a cut.
Outline ring(Random& random, int outer_corners, int inner_corners) {
    // Enough corners that no outer side comes nearer to the centre than 1.5.
    Outline outer = star(random, outer_corners, 2, 5), inner = star(random, inner_corners, 0.2, 1.5);
    outer[0] = {3, 0};
    inner[0] = {1, 0};
    Outline outline = outer;
    outline.push_back(outer[0]);
    outline.push_back(inner[0]);
    outline.insert(outline.end(), inner.rbegin(), inner.rend());
    return outline;
}

/// A strip with several holes, each joined to the lower side by a cut.
Outline perforated(Random& random, int holes) {
    Outline outline{{0, 0}};
    for (int i = 0; i < holes; ++i) {
        const glm::dvec2 foot(4 * i + 2, 0);
        Outline hole = star(random, random.integer(4, 8), 0.3, 1.5);
        hole[0] = {0, -1};  // the foot of the cut; the others follow anticlockwise
        const int corners = static_cast<int>(hole.size());
        for (int k = 1; k < corners; ++k) {
            const double angle = kTurn * (k + random.real(-0.3, 0.3)) / corners - kTurn / 4;
            hole[static_cast<std::size_t>(k)] = polar(angle, random.real(0.3, 1.5));
        }
        outline.push_back(foot);
        outline.push_back(foot + glm::dvec2(0, 2) + hole[0]);
        for (std::size_t k = hole.size(); k-- > 0;) outline.push_back(foot + glm::dvec2(0, 2) + hole[k]);
        outline.push_back(foot);
    }
    outline.emplace_back(4 * holes, 0);
    outline.emplace_back(4 * holes, 4);
    outline.emplace_back(0, 4);
    return outline;
}

/// A right-handed frame in any direction.
glm::dmat3 random_axes(Random& random) {
    const glm::dvec3 z = random.direction();
    const glm::dvec3 x = glm::normalize(glm::cross(random.direction(), z));
    return {x, glm::cross(z, x), z};
}

std::vector<glm::dvec3> in_space(const Outline& outline, const glm::dmat3& axes, const glm::dvec3& origin) {
    std::vector<glm::dvec3> corners;
    for (const glm::dvec2& p : outline) corners.push_back(origin + axes * glm::dvec3(p, 0));
    return corners;
}

/// All that a triangulation of a simple polygon must be. Positive triangles whose edges cancel, but
/// for the outline, and whose areas add up to the outline's, cover it exactly once.
void expect_covers(const std::vector<glm::dvec3>& corners, double area, const glm::dvec3& normal) {
    Triangles triangles;
    triangulate_polygon(corners, triangles);
    const auto n = static_cast<std::uint32_t>(corners.size());
    ASSERT_EQ(triangles.size(), n - 2);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    double sum = 0;
    for (const auto& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_LT(t[k], n);
            ++edges[{t[k], t[(k + 1) % 3]}];
        }
        const glm::dvec3 a = corners[t[0]];
        const double twice = glm::dot(glm::cross(corners[t[1]] - a, corners[t[2]] - a), normal);
        ASSERT_GT(twice, -1e-12 * area) << "triangle " << t[0] << ' ' << t[1] << ' ' << t[2];
        sum += twice / 2;
    }
    ASSERT_NEAR(sum, area, 1e-9 * area);
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1) << edge.first << ' ' << edge.second;
        const bool is_outline = edge.second == (edge.first + 1) % n;
        const bool is_reverse_outline = edge.first == (edge.second + 1) % n;
        ASSERT_FALSE(is_reverse_outline) << edge.first << ' ' << edge.second;
        ASSERT_NE(edges.contains({edge.second, edge.first}), is_outline) << edge.first << ' ' << edge.second;
    }
    for (std::uint32_t i = 0; i < n; ++i) ASSERT_TRUE(edges.contains({i, (i + 1) % n})) << i;
}

void expect_covers_anyhow(const Outline& outline, std::uint64_t seed) {
    const double area = area_of(outline);
    ASSERT_GT(area, 0);
    Random random(seed);
    const glm::dmat3 axes = random_axes(random);
    // In its own plane, from the back, in any plane, and from another first corner.
    ASSERT_NO_FATAL_FAILURE(expect_covers(in_space(outline, glm::dmat3(1.0), {}), area, {0, 0, 1}));
    const glm::dmat3 flipped(glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1));
    ASSERT_NO_FATAL_FAILURE(expect_covers(in_space(outline, flipped, {}), area, {0, 0, -1}));
    ASSERT_NO_FATAL_FAILURE(expect_covers(in_space(outline, axes, random.in_box(10)), area, axes[2]));
    for (int i = 0; i < 3; ++i) {
        Outline turned = outline;
        std::rotate(turned.begin(), turned.begin() + random.integer(0, static_cast<int>(outline.size()) - 1),
                    turned.end());
        ASSERT_NO_FATAL_FAILURE(expect_covers(in_space(turned, glm::dmat3(1.0), {}), area, {0, 0, 1}));
    }
}

TEST(TriangulatePolygon, CoversStarsOnce) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        const Outline outline = star(random, random.integer(5, 40), 0.1, 1);
        ASSERT_NO_FATAL_FAILURE(expect_covers_anyhow(outline, seed)) << "seed " << seed;
    }
}

TEST(TriangulatePolygon, CoversQuadrilateralsOnce) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        ASSERT_NO_FATAL_FAILURE(expect_covers_anyhow(star(random, 4, 0.1, 1), seed)) << "seed " << seed;
    }
}

TEST(TriangulatePolygon, CoversSpiralsAndCombsOnce) {
    for (int corners : {8, 9, 20, 64, 301}) {
        for (const double turns : {0.7, 2.0, 6.5}) {
            if (corners < 20 * turns) continue;  // the sides would cross
            const Outline outline = spiral(corners, turns);
            const Outline reverse(outline.rbegin(), outline.rend());
            ASSERT_NO_FATAL_FAILURE(expect_covers_anyhow(area_of(outline) > 0 ? outline : reverse, 1))
                << corners << ' ' << turns;
        }
    }
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        ASSERT_NO_FATAL_FAILURE(expect_covers_anyhow(comb(random, random.integer(1, 30)), seed)) << "seed " << seed;
    }
}

TEST(TriangulatePolygon, CornersOnStraightLinesAreNoTrouble) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Random random(seed);
        ASSERT_NO_FATAL_FAILURE(expect_covers_anyhow(stairs(random, random.integer(1, 10)), seed)) << "seed " << seed;
    }
    // A triangle with corners along its sides: any start must find a way.
    for (int per_side = 1; per_side < 6; ++per_side) {
        Outline outline;
        const glm::dvec2 corners[3] = {{0, 0}, {60, 0}, {0, 60}};
        for (std::size_t k = 0; k < 3; ++k) {
            for (int i = 0; i < per_side; ++i)
                outline.push_back(corners[k] + (corners[(k + 1) % 3] - corners[k]) * static_cast<double>(i) /
                                                   static_cast<double>(per_side));
        }
        for (std::size_t first = 0; first < outline.size(); ++first) {
            Outline turned = outline;
            std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first), turned.end());
            Triangles triangles;
            const auto in_plane = in_space(turned, glm::dmat3(1.0), {});
            ASSERT_NO_FATAL_FAILURE(expect_covers(in_plane, 1800, {0, 0, 1}));
            triangulate_polygon(in_plane, triangles);
            for (const auto& [a, b, c] : triangles) {
                ASSERT_GT(area_of({turned[a], turned[b], turned[c]}), 0) << "a triangle without area";
            }
        }
    }
}

/// What each triangle is, wherever the polygon begins: its corners counted from the polygon's corner `first`.
std::set<std::array<std::uint32_t, 3>> triangles_from(const Outline& outline, std::uint32_t first) {
    const auto n = static_cast<std::uint32_t>(outline.size());
    Outline turned = outline;
    std::rotate(turned.begin(), turned.begin() + first, turned.end());
    Triangles triangles;
    triangulate_polygon(in_space(turned, glm::dmat3(1.0), {}), triangles);
    std::set<std::array<std::uint32_t, 3>> found;
    for (auto t : triangles) {
        for (std::uint32_t& corner : t) corner = (corner + first) % n;
        std::sort(t.begin(), t.end());
        found.insert(t);
    }
    return found;
}

// Delaunay's is one only, where no four corners lie on a circle.
TEST(TriangulatePolygon, HangsOnNoFirstCorner) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        const Outline outline = star(random, random.integer(5, 40), 0.1, 1);
        const auto expected = triangles_from(outline, 0);
        for (int i = 0; i < 4; ++i) {
            const auto first = static_cast<std::uint32_t>(random.integer(0, static_cast<int>(outline.size()) - 1));
            ASSERT_EQ(triangles_from(outline, first), expected) << "seed " << seed << ", from " << first;
        }
    }
}

// The inner corners of a staircase lie in one line but for rounding. Each could be an ear of no height.
TEST(TriangulatePolygon, WhatIsALineButForRoundingMakesNoNeedles) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        const int steps = random.integer(3, 30);
        const double rise = random.real(0.1, 1);
        Outline outline{{0, 0}, {static_cast<double>(steps), 0}};
        for (int i = steps; i-- > 0;) {
            outline.emplace_back(i + 1, rise * (i + 1));
            outline.emplace_back(i, rise * (i + 1));
        }
        std::vector<glm::dvec3> corners = in_space(outline, random_axes(random), random.in_box(10));
        for (glm::dvec3& c : corners) c = glm::dvec3(glm::vec3(c));
        Triangles triangles;
        triangulate_polygon(corners, triangles);
        for (const auto& [a, b, c] : triangles) {
            const double longest =
                std::max({glm::distance(corners[a], corners[b]), glm::distance(corners[b], corners[c]),
                          glm::distance(corners[c], corners[a])});
            const double height = glm::length(glm::cross(corners[b] - corners[a], corners[c] - corners[a])) / longest;
            ASSERT_GT(height, 0.05) << "seed " << seed << ": " << a << ' ' << b << ' ' << c;
        }
    }
}

TEST(TriangulatePolygon, BeginsWithASide) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        const Outline outline = star(random, random.integer(3, 20), 0.1, 1);
        Triangles triangles;
        triangulate_polygon(in_space(outline, random_axes(random), {}), triangles);
        const std::uint32_t a = triangles[0][0], b = triangles[0][1], n = static_cast<std::uint32_t>(outline.size());
        EXPECT_TRUE(b == (a + 1) % n || a == (b + 1) % n) << "seed " << seed;
    }
}

TEST(TriangulatePolygon, HolesJoinedByACutStayOpen) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Random random(seed);
        const Outline one = ring(random, random.integer(12, 25), random.integer(5, 15));
        ASSERT_NO_FATAL_FAILURE(expect_covers_anyhow(one, seed)) << "seed " << seed;
        const Outline several = perforated(random, random.integer(1, 8));
        ASSERT_NO_FATAL_FAILURE(expect_covers_anyhow(several, seed)) << "seed " << seed;
    }
}

TEST(TriangulatePolygon, ConcaveQuadrilateralsAreCutAlongTheInnerDiagonal) {
    const Outline arrow{{0, 0}, {2, -1}, {0, 3}, {-2, -1}};  // reflex at its first corner
    for (std::size_t first = 0; first < 4; ++first) {
        Outline turned = arrow;
        std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first), turned.end());
        for (const double sign : {1.0, -1.0}) {  // seen from both sides
            std::vector<glm::dvec3> corners;
            for (const glm::dvec2& p : turned) corners.emplace_back(sign * p.x, p.y, 7);
            Triangles triangles;
            triangulate_polygon(corners, triangles);
            ASSERT_EQ(triangles.size(), 2u);
            const auto reflex = static_cast<std::uint32_t>((4 - first) % 4);
            for (const auto& t : triangles) {
                EXPECT_NE(std::find(t.begin(), t.end(), reflex), t.end()) << "first " << first;
                EXPECT_NE(std::find(t.begin(), t.end(), (reflex + 2) % 4), t.end()) << "first " << first;
            }
        }
    }
}

TEST(TriangulatePolygon, ConvexQuadrilateralsAreCutAlongTheShorterDiagonal) {
    Triangles triangles;
    triangulate_polygon(std::vector<glm::dvec3>{{-3, 0, 0}, {0, -1, 0}, {3, 0, 0}, {0, 1, 0}}, triangles);
    EXPECT_EQ(triangles, (Triangles{{1, 2, 3}, {1, 3, 0}}));
    triangles.clear();
    triangulate_polygon(std::vector<glm::dvec3>{{-1, 0, 0}, {0, -3, 0}, {1, 0, 0}, {0, 3, 0}}, triangles);
    EXPECT_EQ(triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(TriangulatePolygon, TrianglesStayAsTheyAre) {
    Triangles triangles{{7, 8, 9}};
    triangulate_polygon(std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, triangles);
    EXPECT_EQ(triangles, (Triangles{{7, 8, 9}, {0, 1, 2}})) << "appended";
}

TEST(TriangulatePolygon, AnythingGivesTwoTrianglesLessThanCorners) {
    const auto expect_count = [](const std::vector<glm::dvec3>& corners, const std::string& what) {
        Triangles triangles;
        triangulate_polygon(corners, triangles);
        ASSERT_EQ(triangles.size(), corners.size() - 2) << what;
        for (const auto& [a, b, c] : triangles) {
            ASSERT_TRUE(a < corners.size() && b < corners.size() && c < corners.size()) << what;
            ASSERT_TRUE(a != b && b != c && c != a) << what;
        }
    };
    expect_count({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, "a figure of eight of four corners");
    expect_count({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {2, 0, 0}, {1, 1, 0}, {0, 2, 0}},
                 "a figure of eight of six corners");
    expect_count(std::vector<glm::dvec3>(10, glm::dvec3(1, 2, 3)), "one point");
    expect_count({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {1, 1, 1}}, "a line");
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        Random random(seed);
        std::vector<glm::dvec3> corners;
        // Coarse coordinates give repeated corners and corners on edges.
        const double size = seed % 2 == 0 ? 1 : std::pow(10.0, random.real(-40, 30));
        for (int i = random.integer(4, 30); i > 0; --i) {
            corners.push_back(seed % 2 == 0 ? glm::floor(random.in_box(3)) : random.in_box(size));
        }
        expect_count(corners, "seed " + std::to_string(seed));
    }
}

TEST(TriangulatePolygon, LargePolygonsComeToAnEnd) {
    Random random(1);
    for (const Outline& outline :
         {star(random, 20000, 0.5, 1), spiral(20000, 100), spiral(20000, 3), comb(random, 10000),
          ring(random, 10000, 10000), perforated(random, 2000), stairs(random, 4000)}) {
        Triangles triangles;
        triangulate_polygon(in_space(outline, glm::dmat3(1.0), {}), triangles);
        EXPECT_EQ(triangles.size(), outline.size() - 2);
    }
}

TEST(AreaVector, IsTwiceTheAreaAlongTheNormal) {
    EXPECT_EQ(area_vector(std::vector<glm::dvec3>{{0, 0, 5}, {2, 0, 5}, {2, 3, 5}, {0, 3, 5}}), glm::dvec3(0, 0, 12));
    EXPECT_EQ(area_vector(std::vector<glm::dvec3>{{0, 3, 5}, {2, 3, 5}, {2, 0, 5}, {0, 0, 5}}), glm::dvec3(0, 0, -12));
    EXPECT_EQ(area_vector(std::vector<glm::dvec3>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}), glm::dvec3(0, 0, 0));
}

}  // namespace
}  // namespace burin
