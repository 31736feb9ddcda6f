#include "mesh/spatial_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "mesh/build_meshes.h"
#include "mesh/input_order.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

std::vector<std::uint32_t> order_of(const std::vector<std::uint32_t>& corners,
                                    const std::vector<glm::vec3>& positions) {
    const auto order = SpatialOrder(positions, corners).of_triangles(corners);
    return {order.begin(), order.end()};
}

void expect_each_once(std::vector<std::uint32_t> order, std::size_t count) {
    ASSERT_EQ(order.size(), count);
    std::sort(order.begin(), order.end());
    for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(order[i], i);
}

/// A wavy sheet of 2 n^2 triangles in random order, each with vertices of its own if `apart`.
PolygonSoup shuffled_sheet(int n, bool apart, Random& random) {
    PolygonSoup soup;
    soup.object_names = {"sheet"};
    soup.materials = {Material{}};
    const auto number = [n](int x, int y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x)
            soup.positions.push_back({0.01 * x, 0.01 * y, 0.2 * std::sin(0.05 * x) * std::cos(0.03 * y)});
    }
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            triangles.push_back({number(x, y), number(x + 1, y), number(x, y + 1)});
            triangles.push_back({number(x + 1, y), number(x + 1, y + 1), number(x, y + 1)});
        }
    }
    for (int i = 0; i < 50; ++i) {
        auto& t = triangles[static_cast<std::size_t>(random.integer(0, static_cast<int>(triangles.size()) - 1))];
        triangles.push_back(i % 2 == 0 ? std::array{t[1], t[2], t[0]}
                                       : std::array{t[0], t[1], t[1]});  // twice, or without area
    }
    for (std::size_t i = triangles.size() - 1; i > 0; --i)
        std::swap(triangles[i], triangles[static_cast<std::size_t>(random.integer(0, static_cast<int>(i)))]);
    const std::vector<glm::dvec3> places = soup.positions;
    if (apart) soup.positions.clear();
    for (const auto& t : triangles) {
        for (const std::uint32_t v : t) {
            soup.corners.push_back(apart ? static_cast<std::uint32_t>(soup.positions.size()) : v);
            if (apart) soup.positions.push_back(places[v]);
        }
    }
    return soup;
}

TEST(SpatialOrder, HasEachTriangleOnceAndThoseOfOnePlaceInOrder) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        const float size = std::array{1.0f, 1e-44f, 1e38f, 0.0f}[static_cast<std::size_t>(random.integer(0, 3))];
        std::vector<glm::vec3> positions(static_cast<std::size_t>(random.integer(1, 50)));
        for (glm::vec3& p : positions) p = size * glm::vec3(random.real(-3, 3), random.real(-3, 3), random.real(-3, 3));
        std::vector<std::uint32_t> corners(static_cast<std::size_t>(3 * random.integer(0, 200)));
        for (std::uint32_t& v : corners)
            v = static_cast<std::uint32_t>(random.integer(0, static_cast<int>(positions.size()) - 1));
        const std::vector<std::uint32_t> order = order_of(corners, positions);
        expect_each_once(order, corners.size() / 3);
        std::vector<std::size_t> place(order.size());
        for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = i;
        const auto sorted = [&](std::size_t t) {
            std::array c{corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]};
            std::sort(c.begin(), c.end());
            return c;
        };
        for (std::size_t t = 0; t < order.size(); ++t) {
            for (std::size_t u = t + 1; u < order.size(); ++u) {
                if (sorted(t) != sorted(u)) continue;
                ASSERT_LT(place[t], place[u]) << "seed " << seed;
            }
        }
    }
}

/// Four triangles per cell along an axis, from the far end on; one vertex that is no corner lies far away.
TEST(SpatialOrder, Has16CellsAlongTheLargestSide) {
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<glm::vec3> positions{glm::vec3(1e6f)};
        std::vector<std::uint32_t> corners;
        for (int i = 64; i >= 0; --i) {  // the last one, at 0, makes the first cell full size
            glm::vec3 p(5.0f);
            p[axis] = i == 0 ? 0.0f : i == 64 ? 64.0f : static_cast<float>(i) + 0.5f;
            corners.insert(corners.end(), 3, static_cast<std::uint32_t>(positions.size()));
            positions.push_back(p);
        }
        std::vector<std::uint32_t> expected;
        for (std::uint32_t first = 61; first > 1; first -= 4)
            expected.insert(expected.end(), {first, first + 1, first + 2, first + 3});
        expected.insert(expected.end(), {0, 1, 2, 3, 4});
        EXPECT_EQ(order_of(corners, positions), expected) << "axis " << axis;
    }
}

TEST(SpatialOrder, PutsNeighboursTogether) {
    Random random(7);
    const PolygonSoup soup = shuffled_sheet(200, false, random);
    std::vector<glm::vec3> positions(soup.positions.begin(), soup.positions.end());
    const auto mean_step = [&](const std::vector<std::uint32_t>& order) {
        double sum = 0;
        for (std::size_t i = 1; i < order.size(); ++i) {
            sum +=
                double{glm::distance(positions[soup.corners[3 * order[i]]], positions[soup.corners[3 * order[i - 1]]])};
        }
        return sum / static_cast<double>(order.size() - 1);
    };
    std::vector<std::uint32_t> given(soup.polygon_count());
    std::iota(given.begin(), given.end(), 0u);
    const double cell = 200 * 0.01 / 16;
    EXPECT_LT(mean_step(order_of(soup.corners, positions)), 1.5 * cell);
    EXPECT_GT(mean_step(given), 7 * cell);
}

enum class Kind { triangles, polygons, two_objects };

/// With ends of polygons listed the general way is taken, which keeps the input's order where there are two materials:
/// that says what there is to be.
TEST(SpatialOrder, ChangesNothingButTheOrderOfLargeMeshes) {
    for (const Kind kind : {Kind::triangles, Kind::polygons, Kind::two_objects}) {
        for (const bool apart : {false, true}) {
            Random random(apart ? 1 : 2);
            PolygonSoup soup = shuffled_sheet(190, apart, random);
            ASSERT_GE(soup.polygon_count(), kWorthSpatialOrder);
            std::vector<std::uint32_t> ends;
            for (std::size_t end = 3; end <= soup.corners.size(); end += 3)
                ends.push_back(static_cast<std::uint32_t>(end));
            if (kind != Kind::triangles) soup.polygon_ends = ends;
            if (kind == Kind::two_objects) {
                soup.object_names = {"small", "large"};
                for (std::size_t i = 0; i < soup.polygon_count(); ++i)
                    soup.polygon_object.push_back(i % 100 == 1 ? 0 : 1);
            }
            PolygonSoup in_input_order = soup;
            in_input_order.polygon_ends = ends;
            in_input_order.materials.resize(2);
            for (std::uint32_t i = 0; i < soup.polygon_count(); ++i)
                in_input_order.polygon_material.push_back(i / 100 % 2);
            const std::vector<Mesh> meshes = build_meshes(soup, {}), expected_meshes = build_meshes(in_input_order, {});
            ASSERT_EQ(meshes.size(), kind == Kind::two_objects ? 2u : 1u);
            const Mesh &mesh = meshes.back(), &expected = expected_meshes.back();
            ASSERT_EQ(mesh.triangles.size(), expected.triangles.size());
            EXPECT_EQ(mesh.repairs.degenerate_polygons, expected.repairs.degenerate_polygons);
            EXPECT_GT(mesh.repairs.degenerate_polygons, 0u);
            EXPECT_EQ(mesh.repairs.duplicate_polygons, expected.repairs.duplicate_polygons);
            EXPECT_GT(mesh.repairs.duplicate_polygons, 0u);
            EXPECT_EQ(mesh.repairs.welded_vertices, expected.repairs.welded_vertices);
            EXPECT_EQ(count_edges(mesh).border, count_edges(expected).border);
            std::vector<std::uint32_t> places;
            std::size_t moved = 0;
            for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
                const std::uint32_t place = mesh.input_place_of(t);
                places.push_back(place);
                moved += place != t ? 1 : 0;
                ASSERT_LT(place, expected.triangles.size());
                for (std::size_t k = 0; k < 3; ++k) {
                    ASSERT_EQ(mesh.positions[mesh.triangles[t][k]], expected.positions[expected.triangles[place][k]])
                        << "triangle " << t;
                }
                ASSERT_EQ(expected.input_place_of(t), t);
            }
            expect_each_once(places, mesh.triangles.size());
            EXPECT_GT(moved, mesh.triangles.size() / 2);
        }
    }
}

TEST(InputOrder, CountsWhatWasLeftOut) {
    const InputOrder same;
    EXPECT_EQ(same.place_of(5), 5u);
    InputOrder order({7, 2, 9, 0, 4, 5, 6}, {1, 3, 8});
    EXPECT_EQ(order.place_of(0), 5u);
    EXPECT_EQ(order.place_of(2), 6u);
    order.drop({1, 3});  // numbers 2 and 0
    const std::array<std::uint32_t, 5> expected{3, 4, 0, 1, 2};
    for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(order.place_of(i), expected[i]) << i;
}

}  // namespace
}  // namespace burin
