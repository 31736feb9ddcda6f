// The image operators of method gbuffer on images whose answer is known in closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "methods/gbuffer/contours.h"
#include "methods/gbuffer/differentials.h"
#include "methods/gbuffer/filters.h"
#include "methods/gbuffer/gradients.h"
#include "methods/gbuffer/id_edges.h"
#include "methods/gbuffer/profile.h"
#include "methods/gbuffer/roberts.h"

namespace burin::gbuffer_operators_test {
namespace {

constexpr PixelRect kRect{-8, -8, 8, 8};

/// Calls check(x, y, value) for every sample.
template <typename T, typename Check>
void for_each(const Raster<T>& image, const Check& check) {
    for (int y = image.rect().y0; y < image.rect().y1; ++y) {
        for (int x = image.rect().x0; x < image.rect().x1; ++x) check(x, y, image.at(x, y));
    }
}

template <typename T>
Raster<T> transposed(const Raster<T>& image) {
    return raster_of(image.rect(), [&](int x, int y) { return image.at(y, x); });
}

/// Height 0 up to column -1, h from column 0 on.
Raster<double> step(double h) {
    return raster_of(kRect, [&](int x, int) { return x < 0 ? 0.0 : h; });
}

TEST(Differentials, AffineDepthGivesItsSlopesAndNoBend) {
    for (const auto& [a, b] : {std::pair{0.0, 0.0}, {1.5, 0.0}, {0.0, -2.0}, {3.0, -0.25}, {-28.6, 7.1}}) {
        const auto depth = raster_of(kRect, [&](int x, int y) { return a * x + b * y + 17.0; });
        for_each(first_order(depth), [&](int, int, double g) { EXPECT_NEAR(g, std::abs(a) + std::abs(b), 1e-12); });
        for_each(second_order(depth), [&](int, int, double l) { EXPECT_NEAR(l, 0, 1e-12); });
        for_each(profile_image(first_order(depth), {}), [&](int, int, float p) { EXPECT_NEAR(p, 0, 1e-12); });
    }
}

TEST(Differentials, StepGivesHalfItsHeightInBothColumns) {
    for (const double h : {1.0, 7.0, -3.0}) {
        for (const bool turned : {false, true}) {
            const auto depth = turned ? transposed(step(h)) : step(h);
            for_each(first_order(depth), [&](int x, int y, double g) {
                const int across = turned ? y : x;
                EXPECT_EQ(g, across == -1 || across == 0 ? std::abs(h) / 2 : 0);
            });
            for_each(second_order(depth), [&](int x, int y, double l) {
                const int across = turned ? y : x;
                EXPECT_EQ(l, across == -1 ? -h : across == 0 ? h : 0);
            });
        }
    }
}

TEST(Differentials, CreaseOnAndBetweenSamples) {
    constexpr double kSlope = 0.5;
    const auto on = raster_of(kRect, [&](int x, int) { return kSlope * std::abs(x); });
    for_each(second_order(on), [&](int x, int, double l) { EXPECT_EQ(l, x == 0 ? -2 * kSlope : 0); });
    const auto between = raster_of(kRect, [&](int x, int) { return kSlope * std::abs(x + 0.5); });
    for_each(second_order(between),
             [&](int x, int, double l) { EXPECT_NEAR(l, x == -1 || x == 0 ? -kSlope : 0, 1e-12); });
}

TEST(Profile, AnswersInFourColumnsAndGatedInTwo) {
    const Raster<double> g = first_order(step(20));
    for_each(profile_image(g, {2, 1, false}), [](int x, int, float p) { EXPECT_EQ(p, x >= -2 && x <= 1 ? 1 : 0); });
    for_each(profile_image(g, {2, 1, true}), [](int x, int, float p) { EXPECT_EQ(p, x == -1 || x == 0 ? 1 : 0); });
}

TEST(Profile, IsTheVariationOverTheLimitToItsPower) {
    const Raster<double> g = first_order(step(1));  // varies by 1/2
    EXPECT_EQ(profile_image(g, {2, 1, true}).at(0, 0), 0.25f);
    EXPECT_EQ(profile_image(g, {2, 2, true}).at(0, 0), 0.0625f);  // Decaudin's
    EXPECT_EQ(profile_image(g, {0.1, 1, true}).at(0, 0), 1.0f);
}

TEST(JumpBeyondSlopes, IsTheHeightOfStepsAndNothingOnCreases) {
    for_each(jump_beyond_slopes(step(20)), [](int x, int, double j) { EXPECT_EQ(j, x == -1 || x == 0 ? 20 : 0); });
    const auto crease = raster_of(kRect, [](int x, int y) { return 3 * std::abs(x + 0.3 * y + 0.4); });
    for_each(jump_beyond_slopes(crease), [](int, int, double j) { EXPECT_NEAR(j, 0, 1e-12); });
    const auto bend = raster_of(kRect, [](int x, int y) { return 0.1 * x * x + 0.2 * y * y; });
    for_each(jump_beyond_slopes(bend), [](int, int, double j) { EXPECT_NEAR(j, 0, 1e-12); });
}

TEST(Profile, LeavesCreasesToTheInternalEdges) {
    const ProfileParameters parameters;
    const auto ridge = raster_of(kRect, [](int x, int) { return std::abs(x + 0.4); });
    const Raster<float> with_crease = profile_image(first_order(ridge), parameters);
    EXPECT_GT(with_crease.at(-2, 0), 0.1f);
    for_each(without_creases(with_crease, ridge, parameters), [](int, int, float p) { EXPECT_NEAR(p, 0, 1e-6); });
    const Raster<double> jump = step(1);
    const Raster<float> of_jump = profile_image(first_order(jump), parameters);
    EXPECT_EQ(without_creases(of_jump, jump, parameters).at(0, 0), of_jump.at(0, 0));
}

TEST(InternalEdges, AreWhatTheProfileIsNot) {
    const auto image = [](const Raster<double>& depth) {
        return internal_edge_image(first_order(depth), second_order(depth), 4, 0.5);
    };
    EXPECT_EQ(image(step(20)).at(0, 0), 0);            // g = 10 is a jump
    EXPECT_FLOAT_EQ(image(step(0.2)).at(0, 0), 0.4f);  // g = 0.1 is none: |l| / k_e
    const auto ridge = raster_of(kRect, [&](int x, int) { return 0.1 * std::abs(x); });
    const auto valley = raster_of(kRect, [&](int x, int) { return -0.1 * std::abs(x); });
    EXPECT_FLOAT_EQ(image(ridge).at(0, 0), 0.4f);
    EXPECT_FLOAT_EQ(image(valley).at(0, 0), 0.4f);
    EXPECT_LT(second_order(ridge).at(0, 0), 0);  // the sign tells them apart
    EXPECT_GT(second_order(valley).at(0, 0), 0);
}

TEST(Sobel, GivesSlopesAndHalfSteps) {
    const auto slope = raster_of(kRect, [](int x, int y) { return 3.0 * x - 4.0 * y; });
    for_each(sobel_magnitude(slope), [](int, int, double v) { EXPECT_NEAR(v, 5, 1e-12); });
    for_each(sobel_magnitude(step(6)), [](int x, int, double v) { EXPECT_EQ(v, x == -1 || x == 0 ? 3 : 0); });
}

Raster<glm::dvec3> two_normals(double angle_deg) {
    const double t = angle_deg * std::numbers::pi / 180;
    return raster_of(kRect,
                     [&](int x, int) { return x < 0 ? glm::dvec3(0, 0, 1) : glm::dvec3(std::sin(t), 0, std::cos(t)); });
}

TEST(NormalOperators, MeasureTheAngleBetweenFaces) {
    for (const double angle_deg : {10.0, 40.0, 90.0, 150.0}) {
        const double t = angle_deg * std::numbers::pi / 180;
        const Raster<glm::dvec3> normals = two_normals(angle_deg);
        for_each(normal_difference(normals),
                 [&](int x, int, double v) { EXPECT_NEAR(v, x == -1 || x == 0 ? 2 - 2 * std::cos(t) : 0, 1e-12); });
        for_each(sobel_magnitude(normals),
                 [&](int x, int, double v) { EXPECT_NEAR(v, x == -1 || x == 0 ? std::sin(t / 2) : 0, 1e-12); });
        for_each(roberts_normal(normals, 1 - std::cos(t * 0.99)), [](int x, int, float v) { EXPECT_EQ(v, x == -1); });
        for_each(roberts_normal(normals, 1 - std::cos(t * 1.01)), [](int, int, float v) { EXPECT_EQ(v, 0); });
    }
}

TEST(Roberts, FindsNothingWithinTheBackground) {
    for_each(roberts_normal(Raster<glm::dvec3>(kRect, glm::dvec3(0.0)), 0.01),
             [](int, int, float v) { EXPECT_EQ(v, 0); });
}

TEST(Roberts, DrawsOneColumnBetweenTwoDepths) {
    const auto distance = raster_of(kRect, [](int x, int) { return x < 0 ? 10.0 : 10.6; });
    const Raster<double> facing(kRect, 1.0);
    // sqrt(2) * 0.6 is more than 0.02 * 10 * (1 + 1), and less than 0.05 * 10 * (1 + 1).
    for_each(roberts_depth(distance, facing, {0.02, 1, 0}), [](int x, int, float v) { EXPECT_EQ(v, x == -1); });
    for_each(roberts_depth(distance, facing, {0.05, 1, 0}), [](int, int, float v) { EXPECT_EQ(v, 0); });
    // Faces seen at a grazing angle may differ more.
    for_each(roberts_depth(distance, Raster<double>(kRect, 0.1), {0.02, 10, 0}),
             [](int, int, float v) { EXPECT_EQ(v, 0); });
}

TEST(IdEdges, DifferOnBothSidesAreLessOnOne) {
    const auto ids = raster_of(kRect, [](int x, int) -> std::uint32_t { return x < 0 ? 3 : 5; });
    for (const int neighbours : {4, 8}) {
        for_each(id_edges(ids, IdComparison::differs, neighbours),
                 [](int x, int, float v) { EXPECT_EQ(v, x == -1 || x == 0); });
        for_each(id_edges(ids, IdComparison::less, neighbours), [](int x, int, float v) { EXPECT_EQ(v, x == -1); });
        for_each(id_edges(ids, IdComparison::greater, neighbours), [](int x, int, float v) { EXPECT_EQ(v, x == 0); });
    }
    for_each(roberts_id(ids), [](int x, int, float v) { EXPECT_EQ(v, x == -1); });
    // Only eight neighbours see a corner.
    const auto corner = raster_of(kRect, [](int x, int y) -> std::uint32_t { return x < 0 && y < 0 ? 3 : 5; });
    EXPECT_EQ(id_edges(corner, IdComparison::differs, 4).at(0, 0), 0);
    EXPECT_EQ(id_edges(corner, IdComparison::differs, 8).at(0, 0), 1);
}

TEST(Decaudin, TakesTheStrongestComponentOfTheNormal) {
    const auto normals = raster_of(kRect, [](int x, int) { return x < 0 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0); });
    for_each(normal_profile_image(normals, {1, 2, true}), [](int x, int, float v) {
        EXPECT_EQ(v, x == -1 || x == 0 ? 0.25f : 0.0f);  // g = 1/2, squared
    });
}

TEST(Filters, DilationWidensALineByItsRadiusOnBothSides) {
    const auto line = raster_of(kRect, [](int x, int) { return x == -1 || x == 0 ? 0.5f : 0.0f; });
    for (const double radius : {0.0, 0.9, 1.0, 2.5, 3.0}) {
        const int reach = static_cast<int>(radius);
        const Raster<float> wide = dilate(line, radius);
        EXPECT_EQ(wide.rect(), grown(kRect, -reach));
        for_each(wide, [&](int x, int, float v) { EXPECT_EQ(v, x >= -1 - reach && x <= reach ? 0.5f : 0.0f); });
    }
    const auto dot = raster_of(kRect, [](int x, int y) { return x == 0 && y == 0 ? 1.0f : 0.0f; });
    for_each(dilate(dot, 2.5), [](int x, int y, float v) { EXPECT_EQ(v, x * x + y * y <= 6.25 ? 1.0f : 0.0f); });
}

TEST(Filters, SmoothingLeavesPlainAndStraightAloneAndSoftensStairs) {
    for_each(smooth_along_lines(Raster<float>({0, 0, 16, 16}, 0.5f)),
             [](int, int, float v) { EXPECT_FLOAT_EQ(v, 0.5f); });
    const auto straight = raster_of({0, 0, 32, 32}, [](int x, int) { return x == 15 || x == 16 ? 1.0f : 0.0f; });
    for_each(smooth_along_lines(straight), [&](int x, int y, float v) { EXPECT_NEAR(v, straight.at(x, y), 1e-6); });
    const auto stairs =
        raster_of({0, 0, 32, 32}, [](int x, int y) { return x / 4 == y || x / 4 == y - 1 ? 1.0f : 0.0f; });
    int soft = 0;
    for_each(smooth_along_lines(stairs), [&](int, int, float v) {
        EXPECT_GE(v, 0);
        EXPECT_LE(v, 1);
        soft += v > 0.05f && v < 0.95f;
    });
    EXPECT_GT(soft, 30);
}

TEST(Contours, CoverTheirWidthOnceAStep) {
    for (const double width : {0.2, 0.7, 1.0, 3.0}) {
        for (const double slope : {0.01, 0.025, -0.04}) {  // 100, 40, 25 samples between lines
            const auto field = raster_of({-1, -1, 401, 2}, [&](int x, int) { return 5.3 + slope * x; });
            double sum = 0;
            for (int x = 0; x < 400; ++x) sum += contour_coverage(field, x, 0, 1, width);
            EXPECT_NEAR(sum, width * 400 * std::abs(slope), 0.002 * width * 400 * std::abs(slope));
        }
    }
    EXPECT_EQ(contour_coverage(Raster<double>({-1, -1, 2, 2}, 3.0), 0, 0, 1, 1),
              0);  // no direction
}

TEST(Contours, OverlapIsTheAreaOfTheStrokeInTheSample) {
    EXPECT_EQ(stroke_overlap(0, 1), 1);
    EXPECT_EQ(stroke_overlap(0, 0.25), 0.25);
    EXPECT_EQ(stroke_overlap(0.5, 1), 0.5);
    EXPECT_EQ(stroke_overlap(1, 1), 0);
    EXPECT_EQ(stroke_overlap(-0.75, 2), 0.75);
}

}  // namespace
}  // namespace burin::gbuffer_operators_test
