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

TEST(InkJoints, InkThatChangesCoversWhatOpaqueInkCovers) {
    double covered = 0;
    int differing = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        Random random(seed);
        const std::vector<InkPoint> points = winding_stroke(random);
        // With one colour a stroke is drawn with all of its discs.
        InkPicture with_discs(kSize, kSize), changing(kSize, kSize);
        with_discs.only_lines = changing.only_lines = true;
        with_discs.add(points);
        std::vector<InkPoint> colored = points;
        for (std::size_t i = 0; i < colored.size(); ++i) colored[i].color.r = i % 2 == 0 ? 0.0f : 1.0f;
        changing.add(colored);
        const Image expected = with_discs.draw(), image = changing.draw();
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const double a = at(expected, "lines.A", x, y), b = at(image, "lines.A", x, y);
                // Sides that meet lie up to 1/128 px outside of the disc, on two of its sides at most; and a sample.
                ASSERT_NEAR(a, b, 2.0 / 128 + 1.0 / 512) << "seed " << seed << " at " << x << ',' << y;
                ASSERT_LE(a, b + 1.0 / 256) << "a gap: seed " << seed << " at " << x << ',' << y;
                differing += a != b;
            }
        }
        const double area = sum(expected, "lines.A");
        ASSERT_NEAR(sum(image, "lines.A"), area, 0.002 * area + 1.0 / 64) << "seed " << seed;
        covered += area;
    }
    EXPECT_GT(covered, 10000);
    EXPECT_GT(differing, 100) << "no joint was drawn without a disc";
}

}  // namespace
}  // namespace burin::ink_joints_test
