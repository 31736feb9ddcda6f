#include "compare/metrics_structure.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace burin {
namespace {

Plane noise(int width, int height, unsigned seed) {
    test::Random random(seed);
    Plane p(width, height);
    for (float& v : p.values) v = static_cast<float>(random.real(0, 1));
    return p;
}

TEST(Ssim, EqualPicturesAreExactlyOne) {
    const Plane p = noise(200, 190, 1);
    EXPECT_DOUBLE_EQ(*ssim(p, p, 2), 1);
    EXPECT_DOUBLE_EQ(*ms_ssim(p, p, 2), 1);
}

// For constant pictures only the luminance term is left: (2ab + c1) / (a^2 + b^2 + c1).
TEST(Ssim, ConstantPicturesFollowTheFormula) {
    const Plane a(32, 32, 0.5f), b(32, 32, 0.25f);
    const double c1 = 0.0001;
    EXPECT_NEAR(*ssim(a, b, 1), (2 * 0.5 * 0.25 + c1) / (0.25 + 0.0625 + c1), 1e-3);
}

TEST(Ssim, IndependentNoiseIsUnlike) { EXPECT_LT(std::abs(*ssim(noise(200, 190, 1), noise(200, 190, 2), 1)), 0.1); }

TEST(Ssim, NeedsAWindowAndFiveScales) {
    EXPECT_FALSE(ssim(Plane(10, 40), Plane(10, 40), 1));
    EXPECT_TRUE(ssim(Plane(11, 11), Plane(11, 11), 1));
    EXPECT_FALSE(ms_ssim(Plane(175, 400), Plane(175, 400), 1));
    EXPECT_TRUE(ms_ssim(Plane(176, 176), Plane(176, 176), 1));
}

}  // namespace
}  // namespace burin
