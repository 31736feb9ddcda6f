// Cracks are found where borders lie in piles: thousands over each other, or through one point.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>
#include <vector>

#include "mesh/build_meshes.h"
#include "mesh/crack_sides.h"
#include "mesh/point_tree.h"
#include "mesh/stitch_cracks.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/support/random.h"

namespace burin::border_piles_test {
namespace {

using test::Random;
using test::soup_of;
using Polygon = std::vector<glm::dvec3>;

Mesh mesh_of(const std::vector<Polygon>& polygons) {
    PolygonSoup soup = soup_of({}, {});
    for (const Polygon& polygon : polygons) {
        std::vector<std::uint32_t> corners;
        for (const glm::dvec3& p : polygon) {
            corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
            soup.positions.push_back(p);
        }
        soup.add_polygon(corners);
    }
    return build_meshes(soup, {}).at(0);
}

/// The quadrilaterals of a torus, each moved by itself.
std::vector<Polygon> torus_in_pieces(std::uint64_t seed) {
    Random random(seed);
    const auto corner = [](int i, int j) {
        const double a = 2 * std::numbers::pi * i / 24, b = 2 * std::numbers::pi * j / 12, r = 1 + 0.4 * std::cos(b);
        return glm::dvec3(r * std::cos(a), 0.4 * std::sin(b), r * std::sin(a));
    };
    std::vector<Polygon> polygons;
    for (int i = 0; i < 24; ++i) {
        for (int j = 0; j < 12; ++j) {
            Polygon p{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
            for (glm::dvec3& c : p) c += random.in_box(0.001);
            polygons.push_back(p);
        }
    }
    return polygons;
}

/// Sheets over each other, or needles through a point, beside the torus.
std::vector<Polygon> pile(std::uint64_t seed) {
    Random random(seed);
    std::vector<Polygon> polygons;
    const glm::dvec3 middle(0, 4, 0);
    for (int i = 0; i < 1500; ++i) {
        if (seed % 2 == 0) {
            const glm::dvec3 off = middle + glm::dvec3(0.02, 0.02, 0.2) * random.in_box(1), tilt(0.1, 0.1, 0.2);
            polygons.push_back({off + glm::dvec3(-1, -1, 0) - tilt, off + glm::dvec3(1, -1, 0) + tilt,
                                off + glm::dvec3(0, 1, 0) + tilt});
        } else {
            const glm::dvec3 d = random.direction(), e = random.in_box(0.01);
            polygons.push_back({middle + d, middle - d + e, middle - d - e});
        }
    }
    return polygons;
}

using Corners = std::array<float, 9>;
std::vector<Corners> triangles_of(const Mesh& mesh) {
    std::vector<Corners> all;
    for (const auto& t : mesh.triangles) {
        std::array<glm::dvec3, 3> c{mesh.origin + mesh.local_position(t[0]), mesh.origin + mesh.local_position(t[1]),
                                    mesh.origin + mesh.local_position(t[2])};
        std::sort(c.begin(), c.end(), [](const glm::dvec3& p, const glm::dvec3& q) {
            return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
        });
        Corners numbers;
        for (std::size_t k = 0; k < 9; ++k)
            numbers[k] = static_cast<float>(c[k / 3][static_cast<glm::length_t>(k % 3)]);
        all.push_back(numbers);
    }
    return all;
}
std::vector<Corners> stitched(const std::vector<Polygon>& polygons) {
    const Mesh mesh = mesh_of(polygons);
    const auto whole = stitch_cracks(
        mesh, [](const glm::dvec3&) { return 0.014; }, 2);
    return triangles_of(whole ? *whole : mesh);
}

/// Borders in a pile are searched in another way than others.
TEST(BorderPiles, CracksBesideAPileAreClosedAsWithoutIt) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        const std::vector<Polygon> torus = torus_in_pieces(seed), heap = pile(seed);
        std::vector<Polygon> both = torus;
        both.insert(both.end(), heap.begin(), heap.end());
        ASSERT_FALSE(mesh_of(torus).borders.has_crowds());
        ASSERT_TRUE(mesh_of(both).borders.has_crowds());
        const std::vector<Corners> of_torus = stitched(torus);
        ASSERT_NE(of_torus, triangles_of(mesh_of(torus)));
        std::vector<Corners> expected = of_torus, found = stitched(both);
        const std::vector<Corners> of_heap = stitched(heap);
        expected.insert(expected.end(), of_heap.begin(), of_heap.end());
        std::sort(expected.begin(), expected.end());
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, expected) << seed;
    }
}

TEST(BorderPiles, DirectionsInABoxFoldBackOnlyIfEachDoes) {
    int all = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        const glm::dvec3 inward = random.direction(), near = glm::normalize(inward + random.in_box(0.3));
        const glm::dvec3 size = random.real(0, 0.1) * glm::dvec3(1), low = near - size, high = near + size;
        bool each = true;
        for (int i = 0; i < 64; ++i) {
            const glm::dvec3 corner((i & 1) != 0 ? low.x : high.x, (i & 2) != 0 ? low.y : high.y,
                                    (i & 4) != 0 ? low.z : high.z);
            each = each && glm::dot(inward, corner) > 0.94;
        }
        ASSERT_EQ(CrackSides::all_fold_back(inward, low, high), each) << seed;
        all += each;
    }
    EXPECT_GT(all, 200);
    EXPECT_LT(all, 1800);
}

/// All points in a box are visited, and few others: so many needles through one point are told apart.
TEST(BorderPiles, PointTreesVisitWhatIsInABox) {
    using Tree = PointTree<6>;
    Random random(7);
    std::vector<Tree::Point> points;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const glm::dvec3 middle = random.in_box(0.001), half = random.direction();
        points.push_back({{middle.x, middle.y, middle.z, half.x, half.y, half.z}, i});
    }
    const Tree tree(points);
    std::size_t visited = 0, inside = 0;
    for (std::size_t i = 0; i < points.size(); i += 50) {
        const Tree::Coordinates& at = points[i].at;
        const auto is_near = [&](const Tree::Coordinates& low, const Tree::Coordinates& high) {
            for (std::size_t k = 0; k < 6; ++k) {
                if (low[k] > at[k] + 0.01 || high[k] < at[k] - 0.01) return false;
            }
            return true;
        };
        std::vector<bool> was_visited(points.size());
        tree.visit(is_near, [&](std::uint32_t k) {
            EXPECT_FALSE(was_visited[k]);
            was_visited[k] = true;
            ++visited;
            return true;
        });
        for (const Tree::Point& p : points) {
            if (!is_near(p.at, p.at)) continue;
            ++inside;
            ASSERT_TRUE(was_visited[p.number]);
        }
    }
    EXPECT_GE(inside, 400u);
    EXPECT_LT(visited, 40 * inside);  // of 20,000 points each
}

}  // namespace
}  // namespace burin::border_piles_test
