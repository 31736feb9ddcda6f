// What finds boxes that touch, and triangles by their boxes or their edges.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "abuffer/screen_boxes.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

TEST(BoxKernels, BoxesThatTouchAreFound) {
    Random random(5);
    const auto box = [&] {
        const auto number = [&](int low, int high) { return static_cast<float>(random.integer(low, high)); };
        ScreenBox b{number(0, 12), number(0, 12), 0, 0, number(0, 4), 0};
        b.x1 = b.x0 + number(0, 6);
        b.y1 = b.y0 + number(0, 6);
        b.high = b.low + number(0, 3);
        return b;
    };
    std::size_t touching = 0;
    for (std::size_t count = 0; count < 40; ++count) {
        ScreenBoxes boxes;
        boxes.resize(count + 7);  // those behind the end are read, but not listed
        for (std::size_t i = 0; i < boxes.size(); ++i) boxes.set(i, box());
        boxes.resize(count);
        const ScreenBox own = box();
        const auto least_x0 = static_cast<float>(random.integer(-5, 6)), least_y0 = static_cast<float>(random.integer(-5, 6));
        for (std::size_t begin = 0; begin <= count; begin += 3) {
            std::vector<std::uint32_t> expected;
            for (std::size_t i = begin; i < count; ++i) {
                const ScreenBox b = boxes[i];
                const bool is_beside = b.x0 > own.x1 || b.x1 < own.x0 || b.y0 > own.y1 || b.y1 < own.y0;
                const bool has_common = b.low < own.high && b.high > own.low;
                if (!is_beside && has_common && b.x0 >= least_x0 && b.y0 >= least_y0) {
                    expected.push_back(static_cast<std::uint32_t>(i));
                }
            }
            touching += expected.size();
            for (const TileKernels* kernels : all_kernels()) {
                std::vector<std::uint32_t> found(count);
                found.resize(kernels->find_touching(boxes.view(), begin, count, own, least_x0, least_y0, found.data()));
                EXPECT_EQ(found, expected) << kernels->name << ' ' << begin << " of " << count;
            }
        }
    }
    EXPECT_GT(touching, 100u);
}

TEST(BoxKernels, OverlapsOfEightAndEightAreFound) {
    Random random(6);
    int overlapping = 0, unconnected = 0;
    for (int round = 0; round < 300; ++round) {
        ScreenBoxes boxes;
        boxes.resize(16);
        std::vector<std::uint32_t> corners[3];
        for (std::size_t i = 0; i < 16; ++i) {
            const auto range = [&](float& low, float& high) {
                low = static_cast<float>(random.integer(0, 6));
                high = low + static_cast<float>(random.integer(0, 6));
            };
            ScreenBox b{};
            range(b.x0, b.x1);
            range(b.y0, b.y1);
            range(b.low, b.high);
            boxes.set(i, b);
            for (auto& list : corners) list.push_back(static_cast<std::uint32_t>(random.integer(0, 20)));
        }
        const std::uint32_t* const corner_lists[3] = {corners[0].data(), corners[1].data(), corners[2].data()};
        const auto a_count = static_cast<std::size_t>(random.integer(1, 8)), b_count = static_cast<std::size_t>(random.integer(1, 8));
        std::uint64_t expected = 0, expected_unconnected = 0;
        for (std::size_t i = 0; i < a_count; ++i) {
            for (std::size_t k = 0; k < b_count; ++k) {
                const ScreenBox a = boxes[i], b = boxes[8 + k];
                const bool overlap = a.x0 <= b.x1 && b.x0 <= a.x1 && a.y0 <= b.y1 && b.y0 <= a.y1 && a.low < b.high && b.low < a.high;
                bool are_connected = false;
                for (const auto& p : corners) {
                    for (const auto& q : corners) are_connected = are_connected || p[i] == q[8 + k];
                }
                expected |= std::uint64_t{overlap} << (8 * i + k);
                expected_unconnected |= std::uint64_t{overlap && !are_connected} << (8 * i + k);
                overlapping += overlap;
                unconnected += overlap && !are_connected;
            }
        }
        for (const TileKernels* kernels : all_kernels()) {
            EXPECT_EQ(kernels->find_overlaps(boxes.view(), 0, a_count, 8, b_count), expected) << kernels->name;
            EXPECT_EQ(kernels->find_unconnected(corner_lists, 0, 8, expected), expected_unconnected) << kernels->name;
        }
    }
    EXPECT_GT(unconnected, 500);
    EXPECT_GT(overlapping, unconnected + 300);
}

TEST(BoxKernels, TrianglesThatMayHideALineAreFound) {
    Random random(8);
    int crossing = 0, beside = 0, found_count = 0;
    for (int round = 0; round < 400; ++round) {
        constexpr std::size_t kCount = 61;
        const double size = std::pow(2.0, random.integer(4, 13));
        // Within 4096 pixels, or beyond.
        const bool is_near = round % 2 == 0;
        const double sign = random.integer(0, 1) == 0 ? -1 : 1;
        const glm::dvec2 origin(sign * random.integer(is_near ? 0 : 1 << 21, is_near ? 1000000 : 1 << 23), random.integer(0, 1000000));
        std::vector<float> numbers[7];
        std::vector<glm::dvec2> corners[kCount];
        for (std::size_t i = 0; i < kCount + 15; ++i) {
            glm::dvec2 p[3];
            const glm::dvec2 center = origin + glm::dvec2(random.integer(0, 8192), random.integer(0, 8192));
            for (glm::dvec2& at : p) at = glm::floor(center + size * glm::dvec2(random.real(-1, 1), random.real(-1, 1)));
            const glm::dvec2 u = p[1] - p[0], v = p[2] - p[0];
            if (u.x * v.y - u.y * v.x < 0) std::swap(p[1], p[2]);
            for (std::size_t k = 0; k < 3; ++k) {
                numbers[k].push_back(static_cast<float>(p[k].x));
                numbers[3 + k].push_back(static_cast<float>(p[k].y));
            }
            numbers[6].push_back(0.125f * static_cast<float>(random.integer(0, 8)));
            if (i < kCount) corners[i] = {p[0], p[1], p[2]};
        }
        const TriangleView view{{numbers[0].data(), numbers[1].data(), numbers[2].data()},
                                {numbers[3].data(), numbers[4].data(), numbers[5].data()},
                                numbers[6].data()};
        const glm::dvec2 a = origin + glm::dvec2(random.real(0, 8192), random.real(0, 8192));
        const double length = random.integer(0, 9) == 0 ? 0 : std::pow(2.0, random.integer(2, 12));
        const glm::dvec2 b = a + length * glm::dvec2(random.real(-1, 1), random.real(-1, 1));
        const ScreenLine line{static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(b.x), static_cast<float>(b.y), 0.25f};
        const auto begin = static_cast<std::size_t>(random.integer(0, 20));
        std::vector<std::vector<std::uint32_t>> found;
        for (const TileKernels* kernels : all_kernels()) {
            found.emplace_back(kCount);
            found.back().resize(kernels->find_hiding(view, begin, kCount, line, found.back().data()));
            EXPECT_EQ(found.back(), found[0]) << kernels->name;
        }
        EXPECT_TRUE(found[0].empty() || found[0].back() < kCount) << "round " << round;
        found_count += static_cast<int>(found[0].size());
        for (std::size_t i = begin; i < kCount; ++i) {
            // Points of the line in the triangle, or how far the best axis keeps them apart.
            bool has_point_inside = false;
            double gap = -1e30;
            const auto cross = [](glm::dvec2 u, glm::dvec2 v) { return u.x * v.y - u.y * v.x; };
            for (int step = 0; step <= 200; ++step) {
                const glm::dvec2 p = glm::mix(a, b, step / 200.0);
                bool is_inside = true;
                for (std::size_t k = 0; k < 3; ++k) is_inside = is_inside && cross(corners[i][(k + 1) % 3] - corners[i][k], p - corners[i][k]) > 0;
                has_point_inside = has_point_inside || is_inside;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec2 edge = corners[i][(k + 1) % 3] - corners[i][k];
                if (edge == glm::dvec2(0.0)) continue;
                gap = std::max(gap, -std::max(cross(edge, a - corners[i][k]), cross(edge, b - corners[i][k])) / glm::length(edge));
            }
            if (length > 0) {
                double low = 1e30, high = -1e30;
                for (const glm::dvec2& p : corners[i]) {
                    low = std::min(low, cross(b - a, p - a) / glm::distance(a, b));
                    high = std::max(high, cross(b - a, p - a) / glm::distance(a, b));
                }
                gap = std::max({gap, low, -high});
            }
            const bool is_found = std::binary_search(found[0].begin(), found[0].end(), static_cast<std::uint32_t>(i));
            const bool is_nearer = numbers[6][i] > line.low;
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
TEST(BoxKernels, TrianglesThatOnlyTouchAnExactLineAreNotFound) {
    Random random(10);
    int hiding = 0, touching = 0;
    for (int round = 0; round < 4000; ++round) {
        constexpr std::size_t kCount = 40, kRead = kCount + 15;
        const double origin = random.integer(0, 1) == 0 ? 0 : random.integer(0, 1 << 19);
        const auto place = [&] { return glm::dvec2(origin + random.integer(0, 8), origin + random.integer(0, 8)); };
        const auto cross = [](glm::dvec2 u, glm::dvec2 v) { return u.x * v.y - u.y * v.x; };
        std::vector<float> numbers[6];
        std::vector<glm::dvec2> corners[kRead];
        for (auto& own : corners) {
            own = {place(), place(), place()};
            if (cross(own[1] - own[0], own[2] - own[0]) < 0) std::swap(own[1], own[2]);
            for (std::size_t k = 0; k < 3; ++k) {
                numbers[k].push_back(static_cast<float>(own[k].x));
                numbers[3 + k].push_back(static_cast<float>(own[k].y));
            }
        }
        const std::vector<float> highest(kRead, 1.0f);
        const TriangleView view{{numbers[0].data(), numbers[1].data(), numbers[2].data()},
                                {numbers[3].data(), numbers[4].data(), numbers[5].data()},
                                highest.data()};
        const glm::dvec2 a = place(), b = place();
        ScreenLine line{static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(b.x), static_cast<float>(b.y), 0.5f};
        line.is_exact = true;
        for (const TileKernels* kernels : all_kernels()) {
            std::vector<std::uint32_t> found(kCount + 15);
            found.resize(kernels->find_hiding(view, 0, kCount, line, found.data()));
            for (std::uint32_t i = 0; i < kCount; ++i) {
                const std::vector<glm::dvec2>& own = corners[i];
                if (a == b || cross(own[1] - own[0], own[2] - own[0]) == 0) continue;
                // Two of 129 places within, edges included: a length of it.
                constexpr double kSteps = 128;
                int inside = 0;
                for (double step = 0; step <= kSteps; ++step) {
                    const glm::dvec2 p = kSteps * a + step * (b - a);
                    bool is_inside = true;
                    for (std::size_t k = 0; k < 3; ++k) is_inside = is_inside && cross(own[(k + 1) % 3] - own[k], p - kSteps * own[k]) >= 0;
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
TEST(BoxKernels, LinesJustInsideLargeTrianglesAreFound) {
    constexpr double kSize = 1 << 21, kGuardBand = 1 << 24;
    Random random(9);
    const auto cross = [](glm::dvec2 u, glm::dvec2 v) { return u.x * v.y - u.y * v.x; };
    const auto direction = [&] {
        const double angle = random.integer(0, 1) == 0 ? random.real(0, 6.3) : 1.5708 * random.integer(0, 3) + random.real(-0.03, 0.03);
        return glm::dvec2(std::cos(angle), std::sin(angle));
    };
    int inside = 0;
    for (int round = 0; round < 60000; ++round) {
        // An edge through the picture, to the end of the guard band or not so far.
        const glm::dvec2 middle(random.real(0, kSize), random.real(0, kSize)), along = direction(), inwards(-along.y, along.x);
        const auto corner = [&](glm::dvec2 towards) {
            const glm::dvec2 room = (kGuardBand - glm::sign(towards) * (middle - 0.5 * kSize)) / glm::abs(towards);
            return glm::floor(middle + std::min({room.x, room.y, std::pow(2.0, random.real(10, 30))}) * towards);
        };
        const glm::dvec2 p[3] = {corner(-along), corner(along), corner(inwards)};
        std::vector<float> numbers[6];
        for (std::size_t k = 0; k < 3; ++k) {
            numbers[k].assign(16, static_cast<float>(p[k].x));
            numbers[3 + k].assign(16, static_cast<float>(p[k].y));
        }
        // A line that touches it from outside, or crosses it at its end.
        const glm::dvec2 edge = glm::normalize(p[1] - p[0]), normal(-edge.y, edge.x);
        const glm::dvec2 a = middle + (0.01 - cross(edge, middle - p[0])) * normal;
        glm::dvec2 b = a + random.real(0, 4096) * (random.integer(0, 1) == 0 ? direction() : edge);
        if (cross(edge, b - p[0]) > 0.01) b = a - (b - a);
        bool is_inside = true;
        for (std::size_t k = 0; k < 3; ++k) is_inside = is_inside && cross(p[(k + 1) % 3] - p[k], a - p[k]) > 0;
        if (!is_inside) continue;
        ++inside;
        const std::vector<float> highest(16, 1.0f);
        const TriangleView view{{numbers[0].data(), numbers[1].data(), numbers[2].data()},
                                {numbers[3].data(), numbers[4].data(), numbers[5].data()},
                                highest.data()};
        const ScreenLine line{static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(b.x), static_cast<float>(b.y), 0.5f};
        for (const TileKernels* kernels : all_kernels()) {
            std::uint32_t found[8];
            ASSERT_EQ(kernels->find_hiding(view, 0, 1, line, found), 1u) << kernels->name << " round " << round;
        }
    }
    EXPECT_GT(inside, 30000);
}

}  // namespace
}  // namespace burin
