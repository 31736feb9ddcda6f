// What finds the triangles of a block that may hide a line.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "kernels/screen_triangles.h"
#include "tests/kernels/random_triangles.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

CrossedTriangle triangle_of(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, float highest) {
    const auto real = [](double v) { return static_cast<float>(v); };
    return {{real(a.x), real(b.x), real(c.x)}, {real(a.y), real(b.y), real(c.y)}, highest, 0};
}

TEST(HidingKernels, TrianglesThatReachInFrontOfABoxAreFound) {
    std::size_t found_count = 0, tried = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        const auto number = [&](int most) { return static_cast<float>(random.integer(0, most)); };
        std::vector<CrossedTriangle> triangles(seed % 70);
        for (CrossedTriangle& t : triangles) {
            t.highest = number(4);
            const float x = number(12), y = number(12);
            for (int k = 0; k < 3; ++k) {
                t.x[k] = x + number(5);
                t.y[k] = y + number(5);
            }
        }
        ScreenBox box{number(12), number(12), 0, 0, number(4), 0};
        box.x1 = box.x0 + number(4);
        box.y1 = box.y0 + number(4);
        std::vector<std::uint32_t> listed;
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
            if (random.integer(0, 1) == 0) listed.push_back(i);
        }
        const auto is_in_front = [&](const CrossedTriangle& t) {
            const auto [x0, x1] = std::minmax({t.x[0], t.x[1], t.x[2]});
            const auto [y0, y1] = std::minmax({t.y[0], t.y[1], t.y[2]});
            return x0 <= box.x1 && x1 >= box.x0 && y0 <= box.y1 && y1 >= box.y0 && t.highest > box.low;
        };
        for (const TileKernels* kernels : all_kernels()) {
            TriangleBoxes boxes, some;
            boxes.set_all(*kernels, triangles);
            some.set_listed(boxes, listed);
            const auto find = [&](const TriangleBoxes& of, std::size_t begin, std::size_t end) {
                std::vector<std::uint32_t> found(end + TriangleBoxes::kPadding);
                found.resize(kernels->fine.find_in_front(of.view(), begin, end, box, found.data()));
                return found;
            };
            for (std::size_t begin = 0; begin <= triangles.size(); begin += 9) {
                std::vector<std::uint32_t> expected;
                for (std::size_t i = begin; i < triangles.size(); ++i) {
                    if (is_in_front(triangles[i])) expected.push_back(static_cast<std::uint32_t>(i));
                }
                EXPECT_EQ(find(boxes, begin, triangles.size()), expected) << kernels->name << " seed " << seed;
                found_count += expected.size();
                tried += triangles.size() - begin;
            }
            std::vector<std::uint32_t> expected;
            for (std::uint32_t i = 0; i < listed.size(); ++i) {
                if (is_in_front(triangles[listed[i]])) expected.push_back(i);
            }
            EXPECT_EQ(find(some, 0, listed.size()), expected) << kernels->name << " seed " << seed;
        }
    }
    EXPECT_GT(found_count, tried / 20);
    EXPECT_LT(found_count, tried / 2);
}

TEST(HidingKernels, TrianglesThatMayHideALineAreFound) {
    Random random(8);
    int crossing = 0, beside = 0, found_count = 0;
    for (int round = 0; round < 400; ++round) {
        constexpr std::size_t kCount = 61;
        const double size = std::pow(2.0, random.integer(4, 13));
        // Within 4096 pixels, or beyond.
        const bool is_near = round % 2 == 0;
        const double sign = random.integer(0, 1) == 0 ? -1 : 1;
        const glm::dvec2 origin(sign * random.integer(is_near ? 0 : 1 << 21, is_near ? 1000000 : 1 << 23),
                                random.integer(0, 1000000));
        std::vector<CrossedTriangle> triangles;
        std::vector<glm::dvec2> corners[kCount];
        for (std::size_t i = 0; i < kCount; ++i) {
            glm::dvec2 p[3];
            const glm::dvec2 center = origin + glm::dvec2(random.integer(0, 8192), random.integer(0, 8192));
            for (glm::dvec2& at : p)
                at = glm::floor(center + size * glm::dvec2(random.real(-1, 1), random.real(-1, 1)));
            const glm::dvec2 u = p[1] - p[0], v = p[2] - p[0];
            if (u.x * v.y - u.y * v.x < 0) std::swap(p[1], p[2]);
            triangles.push_back(triangle_of(p[0], p[1], p[2], 0.125f * static_cast<float>(random.integer(0, 8))));
            corners[i] = {p[0], p[1], p[2]};
        }
        const glm::dvec2 a = origin + glm::dvec2(random.real(0, 8192), random.real(0, 8192));
        const double length = random.integer(0, 9) == 0 ? 0 : std::pow(2.0, random.integer(2, 12));
        const glm::dvec2 b = a + length * glm::dvec2(random.real(-1, 1), random.real(-1, 1));
        const ScreenLine line{static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(b.x),
                              static_cast<float>(b.y), 0.25f};
        std::vector<std::uint32_t> listed;
        for (std::uint32_t i = 0; i < kCount; ++i) {
            if (random.integer(0, 4) != 0) listed.push_back(i);
        }
        std::vector<std::vector<std::uint32_t>> found;
        for (const TileKernels* kernels : all_kernels()) {
            found.push_back(listed);  // one list after the other
            found.back().resize(kernels->fine.find_hiding(triangles.data(), found.back().data(), listed.size(), line,
                                                          found.back().data()));
            EXPECT_EQ(found.back(), found[0]) << kernels->name;
        }
        found_count += static_cast<int>(found[0].size());
        EXPECT_TRUE(std::includes(listed.begin(), listed.end(), found[0].begin(), found[0].end())) << "round " << round;
        for (const std::uint32_t i : listed) {
            // Points of the line in the triangle, or how far the best axis keeps them apart.
            bool has_point_inside = false;
            double gap = -1e30;
            const auto cross = [](glm::dvec2 u, glm::dvec2 v) { return u.x * v.y - u.y * v.x; };
            for (int step = 0; step <= 200; ++step) {
                const glm::dvec2 p = glm::mix(a, b, step / 200.0);
                bool is_inside = true;
                for (std::size_t k = 0; k < 3; ++k)
                    is_inside = is_inside && cross(corners[i][(k + 1) % 3] - corners[i][k], p - corners[i][k]) > 0;
                has_point_inside = has_point_inside || is_inside;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec2 edge = corners[i][(k + 1) % 3] - corners[i][k];
                if (edge == glm::dvec2(0.0)) continue;
                gap = std::max(
                    gap, -std::max(cross(edge, a - corners[i][k]), cross(edge, b - corners[i][k])) / glm::length(edge));
            }
            if (length > 0) {
                double low = 1e30, high = -1e30;
                for (const glm::dvec2& p : corners[i]) {
                    low = std::min(low, cross(b - a, p - a) / glm::distance(a, b));
                    high = std::max(high, cross(b - a, p - a) / glm::distance(a, b));
                }
                gap = std::max({gap, low, -high});
            }
            const bool is_found = std::binary_search(found[0].begin(), found[0].end(), i);
            const bool is_nearer = triangles[i].highest > line.low;
            if (has_point_inside && is_nearer) {
                ++crossing;
                EXPECT_TRUE(is_found) << "round " << round << ' ' << i;
            }
            if (!is_nearer || gap > (is_near ? 2 : 24)) {  // a margin of 1 or 16 along either axis, and rounding
                ++beside;
                EXPECT_FALSE(is_found) << "round " << round << ' ' << i << ' ' << gap;
            }
        }
    }
    EXPECT_GT(crossing, 300);
    EXPECT_GT(beside, 3000);
    EXPECT_GT(found_count, crossing);
}

/// On whole numbers: what only touches a line does not hide it, what has a part of it within or along an edge may.
TEST(HidingKernels, TrianglesThatOnlyTouchAnExactLineAreNotFound) {
    Random random(10);
    int hiding = 0, touching = 0;
    for (int round = 0; round < 4000; ++round) {
        constexpr std::size_t kCount = 40;
        const double origin = random.integer(0, 1) == 0 ? 0 : random.integer(0, 1 << 19);
        const auto place = [&] { return glm::dvec2(origin + random.integer(0, 8), origin + random.integer(0, 8)); };
        const auto cross = [](glm::dvec2 u, glm::dvec2 v) { return u.x * v.y - u.y * v.x; };
        std::vector<CrossedTriangle> triangles;
        std::vector<std::uint32_t> listed;
        std::vector<glm::dvec2> corners[kCount];
        for (auto& own : corners) {
            own = {place(), place(), place()};
            if (cross(own[1] - own[0], own[2] - own[0]) < 0) std::swap(own[1], own[2]);
            listed.push_back(static_cast<std::uint32_t>(triangles.size()));
            triangles.push_back(triangle_of(own[0], own[1], own[2], 1));
        }
        const glm::dvec2 a = place(), b = place();
        ScreenLine line{static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(b.x),
                        static_cast<float>(b.y), 0.5f};
        line.is_exact = true;
        for (const TileKernels* kernels : all_kernels()) {
            std::vector<std::uint32_t> found(kCount);
            found.resize(kernels->fine.find_hiding(triangles.data(), listed.data(), kCount, line, found.data()));
            for (std::uint32_t i = 0; i < kCount; ++i) {
                const std::vector<glm::dvec2>& own = corners[i];
                if (a == b || cross(own[1] - own[0], own[2] - own[0]) == 0) continue;
                // Two of 129 places within, edges included: a length of it.
                constexpr double kSteps = 128;
                int inside = 0;
                for (double step = 0; step <= kSteps; ++step) {
                    const glm::dvec2 p = kSteps * a + step * (b - a);
                    bool is_inside = true;
                    for (std::size_t k = 0; k < 3; ++k)
                        is_inside = is_inside && cross(own[(k + 1) % 3] - own[k], p - kSteps * own[k]) >= 0;
                    inside += is_inside;
                }
                // Whether an edge has the line beyond it, but for an end.
                bool only_touches = false;
                for (std::size_t k = 0; k < 3; ++k) {
                    const glm::dvec2 edge = own[(k + 1) % 3] - own[k];
                    const double at_a = cross(edge, a - own[k]), at_b = cross(edge, b - own[k]);
                    only_touches = only_touches || (std::max(at_a, at_b) <= 0 && std::min(at_a, at_b) < 0);
                }
                const bool is_found = std::binary_search(found.begin(), found.end(), i);
                if (inside > 1) {
                    ++hiding;
                    EXPECT_TRUE(is_found) << kernels->name << " round " << round << ' ' << i;
                }
                if (only_touches) {
                    ++touching;
                    EXPECT_FALSE(is_found) << kernels->name << " round " << round << ' ' << i;
                }
            }
        }
    }
    EXPECT_GT(hiding, 30000);
    EXPECT_GT(touching, 30000);
}

/// Single precision rounds corners far beside the picture, but no line out of a triangle.
TEST(HidingKernels, LinesJustInsideLargeTrianglesAreFound) {
    constexpr double kSize = 1 << 21, kGuardBand = 1 << 24;
    Random random(9);
    const auto cross = [](glm::dvec2 u, glm::dvec2 v) { return u.x * v.y - u.y * v.x; };
    const auto direction = [&] {
        const double angle =
            random.integer(0, 1) == 0 ? random.real(0, 6.3) : 1.5708 * random.integer(0, 3) + random.real(-0.03, 0.03);
        return glm::dvec2(std::cos(angle), std::sin(angle));
    };
    int inside = 0;
    for (int round = 0; round < 60000; ++round) {
        // An edge through the picture, to the end of the guard band or not so far.
        const glm::dvec2 middle(random.real(0, kSize), random.real(0, kSize)), along = direction(),
                                                                               inwards(-along.y, along.x);
        const auto corner = [&](glm::dvec2 towards) {
            const glm::dvec2 room = (kGuardBand - glm::sign(towards) * (middle - 0.5 * kSize)) / glm::abs(towards);
            return glm::floor(middle + std::min({room.x, room.y, std::pow(2.0, random.real(10, 30))}) * towards);
        };
        const glm::dvec2 p[3] = {corner(-along), corner(along), corner(inwards)};
        const CrossedTriangle triangle = triangle_of(p[0], p[1], p[2], 1);
        // A line that touches it from outside, or crosses it at its end.
        const glm::dvec2 edge = glm::normalize(p[1] - p[0]), normal(-edge.y, edge.x);
        const glm::dvec2 a = middle + (0.01 - cross(edge, middle - p[0])) * normal;
        glm::dvec2 b = a + random.real(0, 4096) * (random.integer(0, 1) == 0 ? direction() : edge);
        if (cross(edge, b - p[0]) > 0.01) b = a - (b - a);
        bool is_inside = true;
        for (std::size_t k = 0; k < 3; ++k) is_inside = is_inside && cross(p[(k + 1) % 3] - p[k], a - p[k]) > 0;
        if (!is_inside) continue;
        ++inside;
        const ScreenLine line{static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(b.x),
                              static_cast<float>(b.y), 0.5f};
        for (const TileKernels* kernels : all_kernels()) {
            std::uint32_t number = 0;
            ASSERT_EQ(kernels->fine.find_hiding(&triangle, &number, 1, line, &number), 1u)
                << kernels->name << " round " << round;
        }
    }
    EXPECT_GT(inside, 30000);
}

TEST(HidingKernels, TrianglesArePutAsLinesCrossThem) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        Triangles triangles(seed, 2, 64, -128);
        triangles.facing.resize(triangles.count() + ScreenMesh::kPadding);
        triangles.mesh.facing = triangles.facing.data();
        for (std::uint32_t t = 0; t < triangles.count(); ++t) {
            const std::int64_t area = triangles.area(t);
            triangles.facing[t] = area == 0 ? edge_on : area > 0 ? clockwise : counterclockwise;
        }
        std::vector<std::uint32_t> numbers;
        for (std::uint32_t t = 0; t < triangles.count(); ++t) {
            if (random.integer(0, 3) != 0 && numbers.size() < seed) numbers.push_back(triangles.mesh.first_number + t);
        }
        if (seed == 39) numbers.push_back(triangles.mesh.first_number + triangles.count() - 1);
        const int x = random.integer(-5000, 50000), y = random.integer(-50000, 5000);
        for (const TileKernels* kernels : all_kernels()) {
            std::vector<CrossedTriangle> put(numbers.size() + 7);
            kernels->hide.put_crossed(triangles.mesh, numbers.data(), numbers.size(), x, y, put.data());
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                const std::uint32_t t = numbers[i] - triangles.mesh.first_number;
                const auto corner = [&](std::uint32_t k) {
                    ScreenVertex v = triangles.corner(t, k);
                    v.x -= x;
                    v.y -= y;
                    return v;
                };
                const CrossedTriangle expected = crossed_triangle(corner(0), corner(1), corner(2),
                                                                  static_cast<Facing>(triangles.facing[t]), numbers[i]);
                EXPECT_EQ(std::memcmp(&put[i], &expected, sizeof expected), 0)
                    << kernels->name << " seed " << seed << " place " << i;
            }
        }
    }
}

}  // namespace
}  // namespace burin
