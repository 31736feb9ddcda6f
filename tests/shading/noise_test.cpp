#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/shading/test_symbols.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

double noise_at(double x, double seed = 0) {
    return value_of("noise(s, t)", {{"s", static_cast<float>(x)}, {"t", static_cast<float>(seed)}});
}
double noise3_at(const glm::dvec3& p, const std::string& text = "noise3(P)") {
    return value_of(
        text, {{"P.0", static_cast<float>(p.x)}, {"P.1", static_cast<float>(p.y)}, {"P.2", static_cast<float>(p.z)}});
}

/// The same numbers on every machine and in every version: pictures depend on them.
TEST(Noise, HasTheValuesThatItAlwaysHad) {
    EXPECT_EQ(static_cast<float>(noise_at(0.5)), -0.768750072f);
    EXPECT_EQ(static_cast<float>(noise_at(-7.25, 3)), 0.300183713f);
    EXPECT_EQ(static_cast<float>(noise3_at({0.5, 0.25, -3.75})), -0.425269216f);
    EXPECT_EQ(static_cast<float>(noise3_at({0.5, 0.25, -3.75}, "fbm(P, 4)")), -0.28619194f);
    EXPECT_EQ(value_of("noise(s)", {{"s", 2.6f}}), noise_at(2.6f, 0));
}

TEST(Noise, IsSmoothVariesAndStaysInItsRange) {
    double sum = 0, squares = 0, sum3 = 0, squares3 = 0, largest = 0, largest3 = 0, largest_fbm = 0;
    constexpr int kTrials = 20000;
    for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
        Random random(trial);
        const double x = random.real(-1000, 1000), here = noise_at(x, 5);
        const double there = noise_at(x + 0.01, 5);
        ASSERT_LE(std::abs(here), 1);
        ASSERT_LT(std::abs(there - here), 0.08) << x;
        const glm::dvec3 p = random.in_box(50), q = p + 0.01 * random.direction();
        const double here3 = noise3_at(p);
        ASSERT_LE(std::abs(here3), 1);
        ASSERT_LT(std::abs(noise3_at(q) - here3), 0.08);
        const double fbm = noise3_at(p, "fbm(P, 5)");
        ASSERT_LE(std::abs(fbm), 1);
        sum += here, squares += here * here, sum3 += here3, squares3 += here3 * here3;
        largest = std::max(largest, std::abs(here));
        largest3 = std::max(largest3, std::abs(here3));
        largest_fbm = std::max(largest_fbm, std::abs(fbm));
    }
    EXPECT_NEAR(sum / kTrials, 0, 0.02);
    EXPECT_NEAR(sum3 / kTrials, 0, 0.02);
    EXPECT_GT(std::sqrt(squares / kTrials), 0.2);
    EXPECT_GT(std::sqrt(squares3 / kTrials), 0.2);
    EXPECT_GT(largest, 0.8);
    EXPECT_GT(largest3, 0.8);
    EXPECT_GT(largest_fbm, 0.5);
}

TEST(Noise, IsNoughtAtWholeNumbers) {
    for (int i = -300; i < 300; ++i) {
        EXPECT_EQ(noise_at(i, 2), 0);
        EXPECT_EQ(noise3_at({i, 7 - i, 2 * i}), 0);
    }
}

/// Seeds give curves that have nothing to do with each other; -0 is 0.
TEST(Noise, DependsOnItsSeed) {
    double products = 0, squares = 0;
    for (int i = 0; i < 5000; ++i) {
        const double x = 0.5 + i, a = noise_at(x, 0.25), b = noise_at(x, 0.250001);
        products += a * b;
        squares += a * a;
    }
    EXPECT_LT(std::abs(products), 0.06 * squares);
    EXPECT_EQ(noise_at(0.5, -0.0), noise_at(0.5, 0.0));
}

TEST(Noise, OctavesAreHalfAsLargeAndHalfAsStrong) {
    const glm::dvec3 p{1.3, -2.4, 0.7};
    EXPECT_NEAR(noise3_at(p, "fbm(P, 1)"), noise3_at(p), 1e-7);
    const double second = noise3_at(p, "noise3(P * 2 + 31.7)");
    EXPECT_NEAR(noise3_at(p, "fbm(P, 2)"), (noise3_at(p) + second / 2) / 1.5, 1e-6);
}

}  // namespace
}  // namespace burin
