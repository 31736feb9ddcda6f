// Cameras whose lens is shifted, or whose pixels are not square, and views from points of a lens.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "scene/camera.h"
#include "tests/support/random.h"

namespace burin::camera_shift_test {
namespace {

using test::Random;

constexpr int kWidth = 1200, kHeight = 800;
constexpr double kAspect = 1.5;

std::vector<glm::dvec3> random_points(Random& random) {
    std::vector<glm::dvec3> points;
    const glm::dvec3 center = random.in_box(20);
    for (int i = 0; i < 30; ++i) points.push_back(center + random.in_box(3));
    return points;
}

PointSource source(const std::vector<glm::dvec3>& points) {
    return [&points](const PointVisitor& visit) { visit(points); };
}

CameraSettings random_settings(Random& random, bool orthographic) {
    CameraSettings settings;
    settings.orthographic = orthographic;
    settings.fov_deg = random.real(10, 70);
    settings.fit = random.real(0.5, 1);
    settings.direction = random.direction();
    settings.up = random.direction();
    settings.shift = {random.real(-1.5, 1.5), random.real(-1.5, 1.5)};
    return settings;
}

glm::dvec2 pixel_of(const Camera& camera, const glm::dvec3& world) {
    return camera.projection(kWidth, kHeight, 0).to_pixel(glm::dvec3(camera.to_view() * glm::dvec4(world, 1)));
}

/// Where points are, 1 being the edges of the picture.
struct Extent {
    glm::dvec2 low{1e300}, high{-1e300};
};
Extent extent_of(const Camera& camera, const std::vector<glm::dvec3>& points) {
    Extent extent;
    for (const glm::dvec3& p : points) {
        const glm::dvec2 at = pixel_of(camera, p) / glm::dvec2(kWidth, kHeight) * 2.0 - 1.0;
        extent.low = glm::min(extent.low, at);
        extent.high = glm::max(extent.high, at);
    }
    return extent;
}

TEST(CameraShift, ThePictureMovesAndTheViewStays) {
    CameraSettings settings;
    settings.eye = glm::dvec3(0, 0, 5);
    settings.target = glm::dvec3(0);
    settings.fov_deg = 90;
    const Camera plain = resolve_camera(
        settings, [](const auto&) {}, kAspect);
    settings.shift = {0.25, 0.5};
    for (const bool orthographic : {false, true}) {
        settings.orthographic = orthographic;
        settings.height = 10;
        const Camera shifted = resolve_camera(
            settings, [](const auto&) {}, kAspect);
        EXPECT_EQ(shifted.to_world, plain.to_world);
        // The picture shows what is to the right and up, so all in it is farther to the left and down.
        EXPECT_EQ(pixel_of(shifted, glm::dvec3(0)), glm::dvec2(600 - 200, 400 + 400));
        const glm::dvec2 way = pixel_of(shifted, {1, 2, 3}) - glm::dvec2(-200, 400);
        settings.shift = {};
        EXPECT_NEAR(glm::distance(way, pixel_of(resolve_camera(
                                                    settings, [](const auto&) {}, kAspect),
                                                {1, 2, 3})),
                    0, 1e-9);
        settings.shift = {0.25, 0.5};
    }
}

TEST(CameraShift, AFittedSceneFillsThePictureAllTheSame) {
    for (int trial = 0; trial < 400; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const auto points = random_points(random);
        const CameraSettings settings = random_settings(random, trial % 2 == 1);
        const Camera camera = resolve_camera(settings, source(points), kAspect);
        const Extent e = extent_of(camera, points);
        const double most = std::max({e.high.x, e.high.y, -e.low.x, -e.low.y});
        ASSERT_LE(most, settings.fit + 1e-6) << trial;
        if (settings.fov_deg < 40) {
            ASSERT_NEAR(most, settings.fit, 1e-6) << trial;
            const bool is_wide = e.high.x - e.low.x > e.high.y - e.low.y;
            ASSERT_NEAR(is_wide ? e.low.x + e.high.x : e.low.y + e.high.y, 0, 1e-6) << trial;
        }
    }
}

TEST(CameraShift, ATargetStaysOnTheAxis) {
    int refused = 0;
    for (int trial = 0; trial < 400; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const auto points = random_points(random);
        CameraSettings settings = random_settings(random, trial % 2 == 1);
        settings.target = points[0];
        settings.shift *= 0.4;
        const bool shows_target = std::abs(settings.shift.x) < 0.5 * settings.fit * kAspect &&
                                  std::abs(settings.shift.y) < 0.5 * settings.fit;
        try {
            const Camera camera = resolve_camera(settings, source(points), kAspect);
            ASSERT_TRUE(shows_target) << trial;
            const glm::dvec2 axis(kWidth * 0.5 - settings.shift.x * kHeight, kHeight * (0.5 + settings.shift.y));
            ASSERT_NEAR(glm::distance(pixel_of(camera, points[0]), axis), 0, 1e-6) << trial;
            const Extent e = extent_of(camera, points);
            const double most = std::max({e.high.x, e.high.y, -e.low.x, -e.low.y});
            ASSERT_LE(most, settings.fit + 1e-6) << trial;
        } catch (const InputError& error) {
            ASSERT_FALSE(shows_target) << trial << error.what();
            ++refused;
        }
    }
    EXPECT_GT(refused, 10);
    EXPECT_LT(refused, 300);
}

TEST(PixelAspect, WiderPixelsShowMoreToTheSides) {
    CameraSettings settings;
    settings.eye = glm::dvec3(0, 0, 5);
    settings.target = glm::dvec3(0);
    settings.fov_deg = 90;
    settings.height = 10;
    settings.shift = {0.25, 0};
    settings.pixel_aspect = 2;
    for (const bool orthographic : {false, true}) {
        settings.orthographic = orthographic;
        const Camera camera = resolve_camera(
            settings, [](const auto&) {}, kAspect);
        // A shift by a quarter of the height, 200 rows, is 100 columns.
        EXPECT_NEAR(glm::distance(pixel_of(camera, {0, 0, 0}), {500, 400}), 0, 1e-9);
        EXPECT_NEAR(glm::distance(pixel_of(camera, {1, 1, 0}), {540, 320}), 0, 1e-9);
        const Projection p = camera.projection(kWidth, kHeight, 0);
        glm::dvec3 origin, ray;
        p.view_ray({540, 320}, origin, ray);
        EXPECT_NEAR(glm::distance(origin + 5.0 * ray, {1, 1, -5}), 0, 1e-9);
        const glm::dvec3 place = p.homogeneous({1, 1, -5});
        EXPECT_NEAR(glm::distance(glm::dvec2(place) / place.z, {540, 320}), 0, 1e-9);
    }
}

TEST(PixelAspect, AFittedSceneFillsThePictureAllTheSame) {
    for (int trial = 0; trial < 200; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const auto points = random_points(random);
        CameraSettings settings = random_settings(random, trial % 2 == 1);
        settings.fov_deg = random.real(10, 40);
        settings.pixel_aspect = std::exp2(random.real(-2, 2));
        const Extent e = extent_of(resolve_camera(settings, source(points), kAspect), points);
        ASSERT_NEAR(std::max({e.high.x, e.high.y, -e.low.x, -e.low.y}), settings.fit, 1e-6) << trial;
        settings.shift = {};
        settings.target = points[0];
        const Extent around = extent_of(resolve_camera(settings, source(points), kAspect), points);
        ASSERT_LE(std::max({around.high.x, around.high.y, -around.low.x, -around.low.y}), settings.fit + 1e-6) << trial;
    }
}

TEST(PixelAspect, MustBeReasonable) {
    CameraSettings settings;
    settings.eye = glm::dvec3(0, 0, 5);
    for (const double bad : {0.0, -1.0, 0.09, 10.5, std::numeric_limits<double>::infinity(), std::nan("")}) {
        settings.pixel_aspect = bad;
        EXPECT_THROW(resolve_camera(
                         settings, [](const auto&) {}, kAspect),
                     InputError)
            << bad;
    }
}

TEST(CameraLens, ThePlaneInFocusStandsStill) {
    for (int trial = 0; trial < 300; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        CameraSettings settings;
        settings.eye = random.in_box(10);
        settings.target = random.in_box(10);
        settings.up = random.direction();
        settings.fov_deg = random.real(5, 100);
        settings.shift = {random.real(-0.5, 0.5), random.real(-0.5, 0.5)};
        settings.lens_radius = random.real(0.01, 0.5);
        const Camera camera = resolve_camera(
            settings, [](const auto&) {}, kAspect);
        ASSERT_NEAR(camera.focus, glm::distance(*settings.eye, *settings.target), 1e-9);
        const glm::dvec2 point(random.real(-0.7, 0.7), random.real(-0.7, 0.7));
        const Camera moved = from_lens_point(camera, point);
        ASSERT_NEAR(glm::distance(moved.eye(), camera.eye()), settings.lens_radius * glm::length(point), 1e-9);
        const double depth = trial % 2 == 0 ? camera.focus : random.real(0.2, 40);
        const glm::dvec3 place(camera.to_world *
                               glm::dvec4(random.real(-1, 1) * depth, random.real(-1, 1) * depth, -depth, 1));
        const double focal_px = camera.projection(kWidth, kHeight, 0).focal_px;
        const double way = settings.lens_radius * focal_px * (1 / depth - 1 / camera.focus);
        const glm::dvec2 expected = pixel_of(camera, place) + way * glm::dvec2(-point.x, point.y);
        ASSERT_NEAR(glm::distance(pixel_of(moved, place), expected), 0, 1e-7 * (1 + std::abs(way))) << trial;
    }
}

TEST(CameraLens, WithoutATargetTheMiddleOfTheSceneIsInFocus) {
    const std::vector<glm::dvec3> points = {{-1, -1, -3}, {1, 1, -5}};
    CameraSettings settings;
    settings.to_world = glm::dmat4(1.0);
    settings.lens_radius = 0.1;
    EXPECT_EQ(resolve_camera(settings, source(points), 1).focus, 4);
    settings.focus = 2.5;
    EXPECT_EQ(resolve_camera(settings, source(points), 1).focus, 2.5);
}

TEST(CameraLens, WhatIsNoLensIsRefused) {
    const std::vector<glm::dvec3> points = {{-1, -1, 3}, {1, 1, 5}};
    const auto error_of = [&](const CameraSettings& settings) -> std::string {
        try {
            resolve_camera(settings, source(points), 1);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    CameraSettings behind;
    behind.to_world = glm::dmat4(1.0);
    behind.lens_radius = 1;
    EXPECT_NE(error_of(behind).find("nothing in front of it"), std::string::npos);
    CameraSettings flat;
    flat.orthographic = true;
    EXPECT_EQ(error_of(flat), "");
    flat.lens_radius = 1;
    EXPECT_EQ(error_of(flat), "an orthographic camera has no lens");
    for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        CameraSettings settings;
        settings.lens_radius = bad;
        EXPECT_NE(error_of(settings), "") << bad;
        settings = {};
        settings.focus = bad;
        EXPECT_NE(error_of(settings), "") << bad;
        settings = {};
        settings.shift.y = 100 * bad + (bad < 0 ? bad : 0);
        EXPECT_NE(error_of(settings), "") << bad;
    }
}

}  // namespace
}  // namespace burin::camera_shift_test
