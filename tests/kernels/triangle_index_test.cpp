// Which triangles a line may cross: by their boxes, and by their edges.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kernels/triangle_index.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

constexpr int kTile = 8192;  // 32 pixels

double cross(glm::dvec2 u, glm::dvec2 v) { return u.x * v.y - u.y * v.x; }

struct Corners {
    glm::dvec2 p[3];

    /// Clockwise as seen.
    void turn() {
        if (cross(p[1] - p[0], p[2] - p[0]) < 0) std::swap(p[1], p[2]);
    }
    CrossedTriangle as_seen(float highest, std::uint32_t number) const {
        CrossedTriangle t{};
        for (std::size_t k = 0; k < 3; ++k) {
            t.x[k] = static_cast<float>(p[k].x);
            t.y[k] = static_cast<float>(p[k].y);
        }
        t.highest = highest;
        t.number = number;
        return t;
    }
    double longest() const {
        double longest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec2 edge = glm::abs(p[(k + 1) % 3] - p[k]);
            longest = std::max(longest, edge.x + edge.y);
        }
        return longest;
    }
};

Corners random_corners(Random& random, double size) {
    Corners c;
    const glm::dvec2 center(random.integer(-500, kTile + 500), random.integer(-500, kTile + 500));
    for (glm::dvec2& at : c.p) at = glm::floor(center + size * glm::dvec2(random.real(-1, 1), random.real(-1, 1)));
    c.turn();
    return c;
}

TEST(TriangleIndex, TrianglesThatTouchABoxAreFound) {
    Random random(15);
    int touching = 0, beside = 0, found_count = 0;
    for (int round = 0; round < 300; ++round) {
        const std::size_t count = static_cast<std::size_t>(round < 50          ? round
                                                           : round % 100 == 99 ? random.integer(4097, 9000)
                                                                               : random.integer(1, 700));
        std::vector<CrossedTriangle> triangles;
        std::vector<std::uint32_t> listed;
        for (std::uint32_t i = 0; i < 2 * count; ++i) {
            const double size = std::pow(2.0, random.integer(4, random.integer(0, 9) == 0 ? 24 : 12));
            triangles.push_back(
                random_corners(random, size).as_seen(0.125f * static_cast<float>(random.integer(0, 80)), i));
        }
        for (std::uint32_t i = 0; listed.size() < count; i += static_cast<std::uint32_t>(random.integer(1, 2)))
            listed.push_back(i);
        const auto place = [&] { return static_cast<float>(random.integer(0, kTile)); };
        ScreenBox bounds{0, 0, kTile, kTile, 1, 9};
        if (random.integer(0, 3) == 0) bounds.high = bounds.low;  // all at one depth
        std::vector<ScreenBox> boxes(static_cast<std::size_t>(random.integer(0, 2) == 0 ? random.integer(2, 9) : 1));
        for (ScreenBox& box : boxes) {
            box = {place(), place(), 0, 0, 0.125f * static_cast<float>(random.integer(0, 80)), 1e30f};
            box.x1 = box.x0 + static_cast<float>(random.integer(0, 1000));
            box.y1 = box.y0 + static_cast<float>(random.integer(0, 1000));
        }
        // An index is used again, after fewer triangles or more.
        const std::size_t count_before =
            std::array{std::size_t{0}, count / 2, 2 * count}[static_cast<std::size_t>(random.integer(0, 2))];
        std::vector<std::uint32_t> listed_before(2 * count);
        std::iota(listed_before.begin(), listed_before.end(), 0u);
        std::optional<std::vector<std::uint32_t>> expected;
        for (const TileKernels* kernels : all_kernels()) {
            TriangleIndex index;
            index.make(*kernels, triangles.data(), listed_before.data(), count_before, bounds);
            index.make(*kernels, triangles.data(), listed.data(), count, bounds);
            std::vector<StepBox> in_steps;
            for (const ScreenBox& box : boxes) in_steps.push_back(index.in_steps(box));
            std::vector<std::uint32_t> found(count);
            found.resize(index.find(in_steps.data(), in_steps.size(), listed.data(), found.data()));
            if (!expected) expected = found;
            EXPECT_EQ(found, *expected) << kernels->name << " round " << round;
        }
        EXPECT_TRUE(std::is_sorted(expected->begin(), expected->end()));
        constexpr float kStep = kTile / 256.0f, kDepthStep = 8.0f / 256;
        for (std::size_t i = 0; i < count; ++i) {
            const bool is_found = std::binary_search(expected->begin(), expected->end(), listed[i]);
            const CrossedTriangle& t = triangles[listed[i]];
            const auto [x0, x1] = std::minmax({t.x[0], t.x[1], t.x[2]});
            const auto [y0, y1] = std::minmax({t.y[0], t.y[1], t.y[2]});
            const auto touches = [&, x0 = x0, x1 = x1, y0 = y0, y1 = y1](const ScreenBox& box, float by) {
                return x0 <= box.x1 + by && x1 >= box.x0 - by && y0 <= box.y1 + by && y1 >= box.y0 - by;
            };
            // What is beyond the bounds is at their border.
            const auto may_touch = [&](const ScreenBox& box) {
                const bool is_near_border =
                    std::max(box.x1, box.y1) + 2 * kStep > kTile || std::min(box.x0, box.y0) < 2 * kStep;
                const bool may_be_level = bounds.high == bounds.low || box.low < 1.25f ||
                                          t.highest > std::min(box.low, 9.0f) - 2 * kDepthStep;
                return is_near_border || (touches(box, kStep) && may_be_level);
            };
            found_count += is_found;
            if (std::any_of(boxes.begin(), boxes.end(),
                            [&](const ScreenBox& box) { return touches(box, 0) && t.highest > box.low; })) {
                ++touching;
                EXPECT_TRUE(is_found) << "round " << round << ' ' << i;
            }
            if (std::none_of(boxes.begin(), boxes.end(), may_touch)) {
                ++beside;
                EXPECT_FALSE(is_found) << "round " << round << ' ' << i;
            }
        }
    }
    EXPECT_GT(touching, 2000);
    EXPECT_GT(beside, 20000);
    EXPECT_GT(found_count, touching);
}

/// In whole numbers: an end beyond an edge and the other one on it do not count.
bool is_crossed(const Corners& c, glm::dvec2 a, glm::dvec2 b) {
    bool is_left = true, is_right = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 edge = c.p[(k + 1) % 3] - c.p[k];
        const double at_a = cross(edge, a - c.p[k]), at_b = cross(edge, b - c.p[k]);
        if (std::max(at_a, at_b) <= 0 && std::min(at_a, at_b) < 0) return false;
        const double side = cross(b - a, c.p[k] - a);
        is_left = is_left && side > 0;
        is_right = is_right && side < 0;
    }
    return !is_left && !is_right;
}

std::vector<std::uint32_t> find_crossed(const TileKernels& kernels, std::span<const CrossedTriangle> triangles,
                                        std::vector<std::uint32_t> listed, const ScreenLine& line) {
    constexpr std::size_t kMore = 15;
    constexpr std::uint32_t kNoTriangle = 1u << 30;  // is not to be looked at
    const std::size_t count = listed.size();
    listed.resize(count + kMore, kNoTriangle);
    std::vector<std::uint32_t> found(count + kMore);
    found.resize(kernels.hide.find_crossed(triangles.data(), listed.data(), count, line, found.data()));
    return found;
}

TEST(TriangleIndex, TrianglesCrossedByALineAreFound) {
    Random random(16);
    int exact = 0, exact_at_corner = 0, inside = 0, beside = 0;
    for (int round = 0; round < 5000; ++round) {
        constexpr std::uint32_t kCount = 29;
        const double size = std::pow(2.0, random.integer(4, 12));
        std::vector<Corners> corners;
        std::vector<CrossedTriangle> triangles;
        for (std::uint32_t i = 0; i < kCount; ++i) {
            corners.push_back(random_corners(random, size));
            triangles.push_back(corners[i].as_seen(0.125f * static_cast<float>(random.integer(0, 8)), i));
        }
        std::vector<std::uint32_t> listed;
        for (std::uint32_t i = 0; i < kCount; ++i) {
            if (random.integer(0, 4) != 0) listed.push_back(i);
        }
        // Often from a corner, often with whole ends, sometimes along an edge.
        const Corners& own = corners[static_cast<std::size_t>(random.integer(0, kCount - 1))];
        const bool is_whole = random.integer(0, 2) != 0;
        glm::dvec2 a(random.real(0, kTile), random.real(0, kTile));
        if (random.integer(0, 1) == 0) a = own.p[0];
        glm::dvec2 b = a + std::pow(2.0, random.integer(2, 12)) * glm::dvec2(random.real(-1, 1), random.real(-1, 1));
        if (random.integer(0, 7) == 0) b = a + 2.0 * (own.p[1] - a);
        if (is_whole) {
            a = glm::floor(a);
            b = glm::floor(b);
        }
        const double length = std::abs(b.x - a.x) + std::abs(b.y - a.y);
        const float reach = random.integer(0, 2) == 0 ? static_cast<float>(random.integer(1, 40)) : 0;
        const bool is_exact = reach == 0 && is_whole && length <= double{kLongestExact};
        const double direction = random.real(0, 6.3);
        const glm::dvec2 shift = static_cast<double>(reach) * glm::dvec2(std::cos(direction), std::sin(direction));
        const ScreenLine line{static_cast<float>(a.x),
                              static_cast<float>(a.y),
                              static_cast<float>(b.x),
                              static_cast<float>(b.y),
                              0.25f,
                              is_exact,
                              reach};
        std::vector<std::uint32_t> found;
        for (const TileKernels* kernels : all_kernels()) {
            const std::vector<std::uint32_t> own_found = find_crossed(*kernels, triangles, listed, line);
            if (kernels == all_kernels()[0]) found = own_found;
            EXPECT_EQ(own_found, found) << kernels->name << " round " << round;
        }
        EXPECT_TRUE(std::includes(listed.begin(), listed.end(), found.begin(), found.end()));
        for (const std::uint32_t i : listed) {
            const bool is_found = std::binary_search(found.begin(), found.end(), i);
            const Corners& c = corners[i];
            const bool is_nearer = triangles[i].highest > line.low;
            if (is_exact && c.longest() <= double{kLongestExact}) {
                // What is farther away than products are exact is not asked.
                const bool is_far = glm::distance(c.p[0], a) > 8000;
                if (is_far) continue;
                ++exact;
                exact_at_corner += is_nearer && (c.p[0] == a || c.p[1] == a || c.p[2] == a);
                EXPECT_EQ(is_found, is_nearer && is_crossed(c, a, b)) << "round " << round << ' ' << i;
                continue;
            }
            bool has_point_inside = false;
            for (int step = 0; step <= 100; ++step) {
                const glm::dvec2 p = glm::mix(a, b, step / 100.0) + shift;
                bool is_inside = true;
                for (std::size_t k = 0; k < 3; ++k)
                    is_inside = is_inside && cross(c.p[(k + 1) % 3] - c.p[k], p - c.p[k]) > 0;
                has_point_inside = has_point_inside || is_inside;
            }
            double gap = -1e30;  // along the best axis
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec2 edge = c.p[(k + 1) % 3] - c.p[k];
                if (edge == glm::dvec2(0.0)) continue;
                gap = std::max(gap, -std::max(cross(edge, a - c.p[k]), cross(edge, b - c.p[k])) / glm::length(edge));
            }
            if (has_point_inside && is_nearer) {
                ++inside;
                EXPECT_TRUE(is_found) << "round " << round << ' ' << i;
            }
            if (!is_nearer || gap > 0.25 + 1.5 * static_cast<double>(reach)) {
                ++beside;
                EXPECT_FALSE(is_found) << "round " << round << ' ' << i << ' ' << gap;
            }
        }
    }
    EXPECT_GT(exact, 20000);
    EXPECT_GT(exact_at_corner, 300);
    EXPECT_GT(inside, 300);
    EXPECT_GT(beside, 10000);
}

/// Single precision rounds corners far beside the picture, but no line out of a triangle.
TEST(TriangleIndex, LinesJustInsideLargeTrianglesAreFound) {
    constexpr double kSize = 1 << 21, kGuardBand = 1 << 24;
    Random random(17);
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
        const glm::dvec2 tile = double{kTile} * glm::floor(middle / double{kTile});
        const auto corner = [&](glm::dvec2 towards) {
            const glm::dvec2 room = (kGuardBand - glm::sign(towards) * (middle - 0.5 * kSize)) / glm::abs(towards);
            return glm::floor(middle + std::min({room.x, room.y, std::pow(2.0, random.real(10, 30))}) * towards) - tile;
        };
        const Corners c{{corner(-along), corner(along), corner(inwards)}};
        // A line that touches it from outside, or crosses it at its end.
        const glm::dvec2 edge = glm::normalize(c.p[1] - c.p[0]), normal(-edge.y, edge.x), near = middle - tile;
        const glm::dvec2 a = near + (0.01 - cross(edge, near - c.p[0])) * normal;
        glm::dvec2 b = a + random.real(0, 2048) * (random.integer(0, 1) == 0 ? direction() : edge);
        if (cross(edge, b - c.p[0]) > 0.01) b = a - (b - a);
        bool is_inside = true;
        for (std::size_t k = 0; k < 3; ++k) is_inside = is_inside && cross(c.p[(k + 1) % 3] - c.p[k], a - c.p[k]) > 0;
        if (!is_inside) continue;
        ++inside;
        const CrossedTriangle triangle = c.as_seen(1.0f, 0);
        const ScreenLine line{static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(b.x),
                              static_cast<float>(b.y), 0.5f};
        for (const TileKernels* kernels : all_kernels()) {
            ASSERT_EQ(find_crossed(*kernels, {&triangle, 1}, {0}, line).size(), 1u)
                << kernels->name << " round " << round;
        }
    }
    EXPECT_GT(inside, 30000);
}

}  // namespace
}  // namespace burin
