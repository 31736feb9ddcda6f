#include "compare/metrics_flip.h"

#include <gtest/gtest.h>

namespace burin {
namespace {

ColorPlanes constant(float r, float g, float b) { return {Plane(40, 30, r), Plane(40, 30, g), Plane(40, 30, b)}; }

TEST(Flip, EqualPicturesDoNotDiffer) {
    ColorPlanes picture = constant(0.2f, 0.7f, 0.4f);
    for (int x = 0; x < 40; ++x) picture[1].at(x, 12) = 0;
    const FlipError error = flip_error(picture, picture, 1);
    EXPECT_EQ(error.mean, 0);
    EXPECT_EQ(error.p95, 0);
}

// Values of the authors' implementation.
TEST(Flip, WhiteAgainstBlackHasTheKnownColourDifference) {
    const Plane difference = flip_color_difference(constant(1, 1, 1), constant(0, 0, 0), 1);
    for (const float d : difference.values) EXPECT_NEAR(d, 0.96738f, 1e-5f);
}

TEST(Flip, GreenAgainstBlueIsTheLargestDifferenceThereIs) {
    const Plane difference = flip_color_difference(constant(0, 1, 0), constant(0, 0, 1), 1);
    for (const float d : difference.values) EXPECT_NEAR(d, 1.0f, 1e-4f);
}

TEST(Flip, AMovedLineCountsMoreThanAFainterOne) {
    const auto with_line = [](int x, float value) {
        ColorPlanes p = constant(1, 1, 1);
        for (Plane& channel : p) {
            for (int y = 0; y < 30; ++y) channel.at(x, y) = value;
        }
        return p;
    };
    const ColorPlanes truth = with_line(20, 0);
    const double fainter = flip_error(with_line(20, 0.3f), truth, 1).mean;
    const double moved = flip_error(with_line(24, 0), truth, 1).mean;
    EXPECT_GT(fainter, 0);
    EXPECT_GT(moved, 2 * fainter);
    EXPECT_LE(moved, 1);
}

TEST(Flip, DoesNotDependOnThreads) {
    ColorPlanes a = constant(1, 1, 1);
    for (int i = 0; i < 30; ++i) a[0].at(i, i) = 0;
    const FlipError one = flip_error(a, constant(1, 1, 1), 1), many = flip_error(a, constant(1, 1, 1), 3);
    EXPECT_EQ(one.map.values, many.map.values);
}

}  // namespace
}  // namespace burin
