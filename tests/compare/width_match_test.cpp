#include "compare/width_match.h"

#include <gtest/gtest.h>

#include <cmath>

namespace burin {
namespace {

TEST(WidthMatch, AMethodThatDrawsWhatItIsAskedForIsLeftAlone) {
    int calls = 0;
    const WidthMatch m = match_width(1.5, [&](double asked) { return ++calls, asked; });
    EXPECT_TRUE(m.matches);
    EXPECT_EQ(m.asked_px, 1.5);
    EXPECT_EQ(calls, 1);
}

TEST(WidthMatch, FindsTheWidthToAskForWhenStrokesComeOutWider) {
    const WidthMatch m = match_width(2, [](double asked) { return asked + 0.5; });
    EXPECT_TRUE(m.matches);
    EXPECT_NEAR(m.asked_px, 1.5, 0.05);
    EXPECT_NEAR(m.measured_px, 2, 0.04);
}

TEST(WidthMatch, AMethodWithOneWidthStaysAsItIs) {
    int calls = 0;
    const WidthMatch m = match_width(1, [&](double) { return ++calls, 1.505; });
    EXPECT_FALSE(m.matches);
    EXPECT_EQ(m.asked_px, 1);
    EXPECT_EQ(m.measured_px, 1.505);
    EXPECT_EQ(calls, 2);
}

TEST(WidthMatch, AMethodWithWidthsInStepsStaysAsItIsUnlessAStepFits) {
    const WidthMatch between = match_width(1, [](double asked) { return 0.9 * std::round(asked); });
    EXPECT_FALSE(between.matches);
    EXPECT_EQ(between.asked_px, 1);
    EXPECT_DOUBLE_EQ(between.measured_px, 0.9);
}

TEST(WidthMatch, DrawingNothingIsNoMatch) {
    const WidthMatch m = match_width(1, [](double) { return 0.0; });
    EXPECT_FALSE(m.matches);
    EXPECT_EQ(m.measured_px, 0);
}

}  // namespace
}  // namespace burin
