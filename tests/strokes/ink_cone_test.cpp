// Cones: strokes of a pen whose radius changes.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "strokes/stroke_mask.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"

namespace burin::ink_cone_test {
namespace {

using namespace test;

constexpr double kSamples = StrokeMask::kRows * StrokeMask::kColumns;

int samples_of(const StrokeCanvas& canvas) {
    int count = 0;
    canvas.for_touched([&](int column, int row) {
        for (const std::uint32_t bits : canvas.at(column, row).rows) count += std::popcount(bits);
    });
    return count;
}

PenCone some_cone(Random& random, glm::dvec2 low, glm::dvec2 size) {
    const auto place = [&] { return low + size * glm::dvec2(random.real(-0.2, 1.2), random.real(-0.2, 1.2)); };
    glm::dvec2 from = place(), to = place();
    switch (random.integer(0, 7)) {
        case 0:
            to = from;
            break;
        case 1:
            to.y = from.y;
            break;
        case 2:
            to.x = from.x;
            break;
        case 3:
            to = from + glm::dvec2(random.real(-2, 2), random.real(-2, 2));
            break;
        case 4:
            to.y = from.y + random.real(-0.1, 0.1) * (to.x - from.x);
            break;
        default:
            break;
    }
    return {{from.x, from.y}, {to.x, to.y}, std::pow(10.0, random.real(-1, 1)), std::pow(10.0, random.real(-1, 1))};
}

/// How far a place is outside of the convex hull of two discs.
double distance_to(const PenCone& cone, glm::dvec2 p) {
    const glm::dvec2 a(cone.from[0], cone.from[1]), b(cone.to[0], cone.to[1]), along = b - a;
    const double r0 = cone.radius_from, r1 = cone.radius_to, length = glm::length(along);
    const double discs = std::min(glm::distance(p, a) - r0, glm::distance(p, b) - r1);
    if (std::abs(r0 - r1) >= length) return discs;
    const glm::dvec2 u = along / length;
    const double k = (r0 - r1) / length, c = std::sqrt(1 - k * k), x = glm::dot(p - a, u),
                 y = std::abs(glm::dot(p - a, glm::dvec2(-u.y, u.x)));
    // Along the normal of the side.
    const double side = k * x + c * y - r0, way = c * x - k * y;
    return way >= 0 && way <= c * length ? std::min(side, discs) : discs;
}

bool are_equal(const StrokeCanvas& a, const StrokeCanvas& b) {
    for (int row = 0; row < a.height(); ++row) {
        for (int column = 0; column < a.width(); ++column) {
            if (a.at(column, row).rows != b.at(column, row).rows ||
                a.is_touched(column, row) != b.is_touched(column, row))
                return false;
        }
    }
    return true;
}

TEST(InkCones, WithEqualRadiiAreTheStrokesOfADisc) {
    for (const TileKernels* kernels : all_kernels()) {
        StrokeCanvas disc(*kernels), cone(*kernels), nearly(*kernels);
        for (std::uint64_t seed = 0; seed < 1000; ++seed) {
            Random random(seed);
            const glm::ivec2 corner(random.integer(-3000, 3000), random.integer(-3000, 3000));
            for (StrokeCanvas* c : {&disc, &cone, &nearly}) c->reset(corner.x, corner.y, 34, 20);
            PenCone drawn = some_cone(random, corner, {34, 20});
            drawn.radius_to = drawn.radius_from;
            disc.draw({drawn.from[0], drawn.from[1]}, {drawn.to[0], drawn.to[1]}, drawn.radius_from);
            cone.draw(drawn);
            ASSERT_TRUE(are_equal(disc, cone)) << seed;
            // The body adds nothing to it.
            PenCone body = drawn;
            body.body_only = true;
            cone.draw(body);
            ASSERT_TRUE(are_equal(disc, cone)) << seed;
            // Through the loops for cones: samples within rounding of the boundary aside.
            drawn.radius_to *= 1 + 1e-9;
            nearly.draw(drawn);
            ASSERT_NEAR(samples_of(disc), samples_of(nearly), 3) << seed;
        }
    }
}

TEST(InkCones, HaveTheSamplesOfTheConvexHull) {
    for (const TileKernels* kernels : all_kernels()) {
        StrokeCanvas canvas(*kernels);
        for (std::uint64_t seed = 0; seed < 60; ++seed) {
            Random random(seed);
            const glm::ivec2 corner(random.integer(-100, 100), random.integer(-100, 100));
            canvas.reset(corner.x, corner.y, 20, 12);
            const PenCone cone = some_cone(random, corner, {20, 12});
            canvas.draw(cone);
            const bool is_level = std::abs(cone.to[1] - cone.from[1]) * 16 <= std::abs(cone.to[0] - cone.from[0]);
            for (int row = 0; row < 12 * 16; ++row) {
                const double shift = stroke_row_shift(corner.y * 16 + row);
                for (int column = 0; column < 20 * 32; ++column) {
                    const double down = is_level ? kStrokeColumnShifts[static_cast<std::size_t>(column % 8)] / 16 : 0;
                    const glm::dvec2 sample =
                        glm::dvec2(corner) + glm::dvec2((column + 0.5 + shift) / 32, (row + 0.5) / 16 + down);
                    const double outside = distance_to(cone, sample);
                    if (std::abs(outside) < 2e-5) continue;
                    const std::uint32_t bits =
                        canvas.at(column / 32, row / 16).rows[static_cast<std::size_t>(row % 16)];
                    ASSERT_EQ(bits >> column % 32 & 1, outside < 0 ? 1u : 0u)
                        << seed << " " << column << "," << row << " " << outside;
                }
            }
        }
    }
}

/// Also with parts left out, and in any canvas around a piece.
TEST(InkCones, HaveEqualBitsAtEveryInstructionSetAndInEveryCanvas) {
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        Random random(seed);
        const glm::ivec2 corner(random.integer(-3000, 3000), random.integer(-3000, 3000));
        PenCone cone = some_cone(random, corner, {40, 24});
        cone.body_only = seed % 2 == 1;
        cone.cut_count = random.integer(0, 2);
        for (int i = 0; i < cone.cut_count; ++i) {
            const double angle = random.integer(0, 3) == 0 ? 0 : random.real(0, 6);
            const glm::dvec2 n(std::cos(angle), std::sin(angle)), at = glm::dvec2(corner) + glm::dvec2(20, 12);
            cone.cuts[i] = {{n.x, n.y}, glm::dot(n, at) + random.real(-5, 10)};
        }
        StrokeCanvas whole(baseline_kernels());
        whole.reset(corner.x, corner.y, 40, 24);
        whole.draw(cone);
        for (const TileKernels* kernels : all_kernels()) {
            StrokeCanvas other(*kernels);
            other.reset(corner.x, corner.y, 40, 24);
            other.draw(cone);
            ASSERT_TRUE(are_equal(whole, other)) << seed << " " << kernels->name;
            StrokeCanvas part(*kernels);
            const glm::ivec2 inset(random.integer(0, 30), random.integer(0, 20)),
                size(random.integer(1, 40 - inset.x), random.integer(1, 24 - inset.y));
            part.reset(corner.x + inset.x, corner.y + inset.y, size.x, size.y);
            part.draw(cone);
            for (int row = 0; row < size.y; ++row) {
                for (int column = 0; column < size.x; ++column)
                    ASSERT_EQ(part.at(column, row).rows, whole.at(column + inset.x, row + inset.y).rows) << seed;
            }
        }
    }
}

TEST(InkCones, AreAsLargeAsTheFormulaSays) {
    StrokeCanvas canvas;
    double sum = 0;
    int count = 0;
    for (int degree = 0; degree < 360; degree += 3) {
        for (const double width : {1.0, 4.0, 9.0}) {
            Random random(static_cast<std::uint64_t>(degree));
            const double angle = glm::radians(static_cast<double>(degree)), length = 30, r0 = width / 2,
                         r1 = random.real(0.1, 1.0) * r0;
            const glm::dvec2 u(std::cos(angle), std::sin(angle)),
                from = glm::dvec2(40.3, 40.1) + glm::dvec2(random.real(0, 1), random.real(0, 1)),
                to = from + length * u;
            canvas.reset(0, 0, 80, 80);
            canvas.draw(PenCone{{from.x, from.y}, {to.x, to.y}, r0, r1});
            const double theta = std::asin((r0 - r1) / length), pi = 3.14159265358979;
            const double area =
                (r0 + r1) * length * std::cos(theta) + r0 * r0 * (pi / 2 + theta) + r1 * r1 * (pi / 2 - theta);
            const double off = samples_of(canvas) / kSamples / area - 1;
            EXPECT_LT(std::abs(off), 0.01) << degree << " deg, " << width << " px";
            sum += off;
            ++count;
        }
    }
    EXPECT_LT(std::abs(sum / count), 0.0005);
}

TEST(InkCones, CutsLeaveWhatLiesBeforeThem) {
    StrokeCanvas canvas;
    for (int degree = 0; degree < 360; degree += 5) {
        const double angle = glm::radians(static_cast<double>(degree)), length = 20, width = 6;
        const glm::dvec2 u(std::cos(angle), std::sin(angle)), from(40.2, 39.7), to = from + length * u;
        PenCone cone{{from.x, from.y}, {to.x, to.y}, width / 2, width / 2};
        cone.cut_count = 2;
        cone.cuts[0] = {{-u.x, -u.y}, -glm::dot(u, from)};
        cone.cuts[1] = {{u.x, u.y}, glm::dot(u, to)};
        canvas.reset(0, 0, 80, 80);
        canvas.draw(cone);
        EXPECT_NEAR(samples_of(canvas) / kSamples, length * width, 0.003 * length * width) << degree;
    }
}

}  // namespace
}  // namespace burin::ink_cone_test
