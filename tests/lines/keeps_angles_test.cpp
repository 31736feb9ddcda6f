#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "lines/sharp_edges.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

glm::dmat4 rotation(Random& random, double scale) {
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), random.real(-4, 4), random.direction());
    return glm::scale(turned, glm::dvec3(scale));
}
glm::dmat4 in_single_precision(const glm::dmat4& m) { return glm::dmat4(glm::mat4(m)); }

/// The matrix that takes normals along.
glm::dmat3 cofactors(const glm::dmat4& m) {
    const glm::dvec3 a(m[0]), b(m[1]), c(m[2]);
    return {glm::cross(b, c), glm::cross(c, a), glm::cross(a, b)};
}

TEST(KeepsAngles, OfMatricesThatWereRoundedToSinglePrecision) {
    for (int trial = 0; trial < 2000; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const double scale = std::exp(random.real(-20, 20));
        const glm::dmat4 one = in_single_precision(rotation(random, scale));
        EXPECT_TRUE(keeps_angles(one)) << trial;
        const glm::dmat4 two = in_single_precision(one * in_single_precision(rotation(random, 1)));
        EXPECT_TRUE(keeps_angles(two)) << trial;
        glm::dmat4 stretched = rotation(random, scale);
        stretched[random.integer(0, 2)] *= 1.00001;
        EXPECT_FALSE(keeps_angles(stretched)) << trial;
        glm::dmat4 skewed = rotation(random, scale);
        skewed[0] += 1e-5 * skewed[1];
        EXPECT_FALSE(keeps_angles(skewed)) << trial;
    }
    EXPECT_FALSE(keeps_angles(glm::dmat4(0.0)));
    EXPECT_FALSE(keeps_angles(glm::dmat4(std::nan(""))));
}

TEST(KeepsAngles, SoThatASmoothEdgeStaysOne) {
    // As far off as it may be, in any direction: cosines change by less than what edges are looked at for.
    double most = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        glm::dmat4 off(1.0);
        for (int i = 0; i < 3; ++i) {
            for (int k = 0; k < 3; ++k) off[i][k] += random.real(-1e-6, 1e-6);
        }
        const glm::dmat4 transform = off * rotation(random, std::exp(random.real(-5, 5)));
        if (!keeps_angles(transform)) continue;
        const glm::dvec3 a = random.direction(), b = glm::normalize(a + random.real(0, 2) * random.direction());
        const glm::dmat3 take = cofactors(transform);
        most = std::max(most, std::abs(glm::dot(glm::normalize(take * a), glm::normalize(take * b)) - glm::dot(a, b)));
    }
    EXPECT_GT(most, 1e-7);  // some were off
    EXPECT_LT(most, 0.7 * double{kCreaseSlack});
}

}  // namespace
}  // namespace burin
