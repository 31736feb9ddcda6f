// Bodies of a stroke's parts that meet without discs between them cover what they would cover with discs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/strokes/ink_picture.h"
#include "tests/support/random.h"

namespace burin::ink_joints_test {
namespace {

using namespace test;

constexpr int kSize = 96;

/// A stroke that winds, in pieces of many lengths, and becomes wider and narrower.
std::vector<InkPoint> winding_stroke(Random& random) {
    std::vector<InkPoint> points;
    const double sharpest = random.real(0, 0.6), most_slope = random.real(0, 0.6);
    double angle = random.real(0, 6.3), width = random.real(1, 9);
    if (random.integer(0, 3) == 0) angle = 1.5707963267948966 * random.integer(0, 3);
    glm::dvec2 place(random.real(20, kSize - 20), random.real(20, kSize - 20));
    const int count = random.integer(2, 40);
    for (int i = 0; i < count; ++i) {
        points.push_back(InkPicture::point(place, static_cast<float>(width)));
        const double length = std::pow(2.0, random.real(-2, 3));
        if (random.integer(0, 2) > 0) angle += random.real(-sharpest, sharpest);
        width = std::clamp(width + 2 * length * random.real(-most_slope, most_slope), 0.6, 12.0);
        place += length * glm::dvec2(std::cos(angle), std::sin(angle));
    }
    return points;
}

/// Boundaries of surfaces, most of them in front, near a stroke.
std::vector<InkBoundary> boundaries_near(const std::vector<InkPoint>& points, Random& random) {
    std::vector<InkBoundary> boundaries(static_cast<std::size_t>(random.integer(2, 8)));
    for (InkBoundary& b : boundaries) {
        const auto i = static_cast<std::size_t>(random.integer(0, static_cast<int>(points.size()) - 1));
        b.from = points[i].place + glm::dvec2(random.real(-5, 5), random.real(-5, 5));
        b.to = b.from + glm::dvec2(random.real(-30, 30), random.real(-30, 30));
        b.nearness_from = b.nearness_to = random.integer(0, 4) == 0 ? -110.0f : -50.0f;  // strokes have -100
        b.front_on_left = random.integer(0, 1) == 0;
    }
    return boundaries;
}

TEST(InkJoints, InkThatChangesCoversWhatOpaqueInkCovers) {
    double covered = 0;
    int differing = 0, cut = 0;
    for (std::uint64_t seed = 0; seed < 1200; ++seed) {
        Random random(seed);
        const std::vector<InkPoint> points = winding_stroke(random);
        // With one colour a stroke is drawn with all of its discs.
        InkPicture with_discs(kSize, kSize), changing(kSize, kSize);
        with_discs.only_lines = changing.only_lines = true;
        InkStroke& plain = with_discs.add(points);
        std::vector<InkPoint> colored = points;
        for (std::size_t i = 0; i < colored.size(); ++i) colored[i].color.r = i % 2 == 0 ? 0.0f : 1.0f;
        InkStroke& colorful = changing.add(colored);
        if (seed % 3 == 1) plain.caps = colorful.caps = StrokeCaps::butt;
        if (seed % 3 == 2) with_discs.lines.boundaries = changing.lines.boundaries = boundaries_near(points, random);
        const Image expected = with_discs.draw(), image = changing.draw();
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const double a = at(expected, "lines.A", x, y), b = at(image, "lines.A", x, y);
                // Corners lie up to 1/64 px outside of the disc, at one place of a pixel, or few; and some samples.
                ASSERT_NEAR(a, b, 1.0 / 128 + 1.0 / 512) << "seed " << seed << " at " << x << ',' << y;
                ASSERT_LE(a, b + 1.0 / 256) << "a gap: seed " << seed << " at " << x << ',' << y;
                differing += a != b;
            }
        }
        const double area = sum(expected, "lines.A");
        ASSERT_NEAR(sum(image, "lines.A"), area, 0.001 * area + 1.0 / 64) << "seed " << seed;
        covered += area;
        if (seed % 3 != 2) continue;
        with_discs.lines.boundaries.clear();
        cut += sum(with_discs.draw(), "lines.A") > area + 1;
    }
    EXPECT_GT(covered, 10000);
    EXPECT_GT(differing, 100) << "no joint was drawn without a disc";
    EXPECT_GT(cut, 100) << "no stroke was cut by a boundary";
}

}  // namespace
}  // namespace burin::ink_joints_test
