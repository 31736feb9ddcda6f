#include "mesh/gltf_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace burin::gltf_sampler_test {
namespace {

using enum GltfInterpolation;

std::vector<double> sampled(const GltfSampler& sampler, double time_s) {
    std::vector<double> numbers(sampler.width);
    sampler.sample(time_s, numbers);
    return numbers;
}

glm::dvec4 turned(double degrees, const glm::dvec3& axis = {0, 0, 1}) {
    const double half = 0.5 * glm::radians(degrees);
    return {std::sin(half) * glm::normalize(axis), std::cos(half)};
}

TEST(GltfSampler, LinearValuesAreHeldBeforeTheFirstKeyAndAfterTheLast) {
    const GltfSampler s{linear, 2, {1, 2, 4}, {10, -1, 20, -2, 0, 6}};
    EXPECT_EQ(sampled(s, -5), (std::vector<double>{10, -1}));
    EXPECT_EQ(sampled(s, 1), (std::vector<double>{10, -1}));
    EXPECT_EQ(sampled(s, 1.5), (std::vector<double>{15, -1.5}));
    EXPECT_EQ(sampled(s, 2), (std::vector<double>{20, -2}));
    EXPECT_EQ(sampled(s, 2.5), (std::vector<double>{15, 0}));
    EXPECT_EQ(sampled(s, 4), (std::vector<double>{0, 6}));
    EXPECT_EQ(sampled(s, 400), (std::vector<double>{0, 6}));
}

TEST(GltfSampler, StepsTakeTheKeyAtOrBefore) {
    const GltfSampler s{step, 1, {1, 2, 4}, {10, 20, 30}};
    EXPECT_EQ(sampled(s, 0)[0], 10);
    EXPECT_EQ(sampled(s, 1.999)[0], 10);
    EXPECT_EQ(sampled(s, 2)[0], 20);
    EXPECT_EQ(sampled(s, 3.999)[0], 20);
    EXPECT_EQ(sampled(s, 4)[0], 30);
}

TEST(GltfSampler, ASplineWithoutTangentsPassesTheMeanHalfWay) {
    const GltfSampler s{cubic_spline, 1, {3, 7}, {0, 2, 0, 0, 10, 0}};
    EXPECT_DOUBLE_EQ(sampled(s, 5)[0], 6);
    EXPECT_DOUBLE_EQ(sampled(s, 4)[0], 2 + 8 * (3.0 / 16 - 2.0 / 64)) << "3u² - 2u³";
    EXPECT_EQ(sampled(s, 3)[0], 2);
    EXPECT_EQ(sampled(s, 7)[0], 10);
    EXPECT_EQ(sampled(s, 99)[0], 10) << "the value, not a tangent";
}

TEST(GltfSampler, TangentsArePerSecond) {
    // t³ at 1, 3 and 4 seconds, whose slope is 3t²; the tangents that lead to the first key and from the last do not
    // count.
    const GltfSampler s{cubic_spline, 1, {1, 3, 4}, {99, 1, 3, 27, 27, 27, 48, 64, 99}};
    for (double t = 1; t <= 4; t += 0.125) EXPECT_NEAR(sampled(s, t)[0], t * t * t, 1e-12) << t;
}

TEST(GltfSampler, OneKeyIsTheValueAtAllTimes) {
    EXPECT_EQ(sampled({linear, 1, {2}, {5}}, 0)[0], 5);
    EXPECT_EQ(sampled({cubic_spline, 1, {2}, {1, 5, 2}}, 9)[0], 5);
    EXPECT_EQ(GltfSampler({linear, 4, {2}, {0, 0, 0, 2}}).sample_rotation(1), glm::dvec4(0, 0, 0, 1));
}

TEST(GltfSampler, RotationsTurnEvenly) {
    EXPECT_LT(glm::distance(slerp(turned(0), turned(90), 0.5), turned(45)), 1e-15);
    const glm::dvec3 axis(1, -2, 3);
    for (const double degrees : {1e-9, 0.001, 1.0, 89.0, 90.0, 179.0}) {
        for (const double part : {0.0, 1e-7, 0.1, 0.25, 1.0 / 3, 0.5, 0.9999, 1.0}) {
            EXPECT_LT(glm::distance(slerp(turned(0), turned(degrees, axis), part), turned(part * degrees, axis)), 1e-14)
                << degrees << ' ' << part;
        }
    }
}

TEST(GltfSampler, RotationsTakeTheShorterWay) {
    EXPECT_LT(glm::distance(slerp(turned(0), -turned(90), 0.5), turned(45)), 1e-15);
    EXPECT_LT(glm::distance(slerp(turned(0), turned(270), 0.5), turned(-45)), 1e-15);
    const GltfSampler s{linear, 4, {0, 1}, {0, 0, 0, 1, 0, 0, -std::sqrt(0.5), -std::sqrt(0.5)}};
    EXPECT_LT(glm::distance(s.sample_rotation(0.5), turned(45)), 1e-15);
}

TEST(GltfSampler, RotationsHaveUnitLength) {
    const GltfSampler spline{cubic_spline, 4, {0, 1}, {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0,  //
                                                       0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0}};
    EXPECT_LT(glm::distance(spline.sample_rotation(0.5), turned(90)), 1e-15);
    const GltfSampler linear_keys{linear, 4, {0, 1}, {0, 0, 0, 5, 0, 0, 7, 7}};
    EXPECT_LT(glm::distance(linear_keys.sample_rotation(0.5), turned(45)), 1e-15);
    EXPECT_LT(glm::distance(linear_keys.sample_rotation(9), turned(90)), 1e-15);
    const GltfSampler through_0{cubic_spline, 4, {0, 1}, {0, 0, 0, 0, 0, 0, 0, 1,  0, 0, 0, 0,  //
                                                          0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0}};
    EXPECT_EQ(through_0.sample_rotation(0.5), glm::dvec4(0, 0, 0, 1)) << "that of the key before";
}

}  // namespace
}  // namespace burin::gltf_sampler_test
