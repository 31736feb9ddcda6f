#include "compare/metrics_temporal.h"

#include <gtest/gtest.h>

namespace burin {
namespace {

std::vector<Plane> frames(std::initializer_list<float> middle) {
    std::vector<Plane> result;
    for (const float v : middle) {
        result.emplace_back(9, 9);
        result.back().at(4, 4) = v;
    }
    return result;
}

TEST(Flicker, TheTruthDoesNotFlicker) {
    const auto truth = frames({0.2f, 0.8f, 0.4f});
    const auto f = flicker(truth, truth);
    EXPECT_EQ(f->flicker_sd, 0);
    EXPECT_EQ(f->pop, 0);
    EXPECT_GT(*f->energy_sd, 0);
}

TEST(Flicker, AConstantErrorIsNoFlicker) {
    EXPECT_NEAR(flicker(frames({0.5f, 0.5f}), frames({1, 1}))->flicker_sd, 0, 1e-7);
}

TEST(Flicker, ABlinkingPixelIsSeenInAllThreeNumbers) {
    const auto f = flicker(frames({0, 1, 0, 1}), frames({1, 1, 1, 1}));
    EXPECT_NEAR(f->flicker_sd, 0.5 / 9, 1e-9);  // one of the nine pixels near the line
    EXPECT_NEAR(*f->energy_sd, 1, 1e-9);
    EXPECT_NEAR(f->pop, 1, 1e-9);
}

TEST(Flicker, NeedsTwoFramesAndALine) {
    EXPECT_FALSE(flicker(frames({1}), frames({1})));
    EXPECT_FALSE(flicker(frames({1, 1}), frames({0, 0})));
    EXPECT_FALSE(flicker(frames({0, 0}), frames({1, 1}))->energy_sd);
}

}  // namespace
}  // namespace burin
