// Creases that fade in over an interval of angles, as they open in an animation.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "methods/abuffer.h"
#include "tests/support/drawing.h"

namespace burin::crease_fade_test {
namespace {

using namespace test;

constexpr int kSize = 96;

/// Two leaves about an upright axis, that turn from each other by this angle; as one mesh, or as two
/// that touch.
PolygonSoup hinge(double angle_deg, bool is_stitched) {
    const double half = 0.5 * angle_deg * std::numbers::pi / 180, x = std::cos(half), z = -std::sin(half);
    // The axis leans, so that no sample lies on it.
    const glm::dvec3 low(-0.03, -1, 0), high(0.04, 1, 0), right(x, 0, z), left(-x, 0, z);
    std::vector<glm::dvec3> p{low, high, high + right, low + right, high + left, low + left};
    if (is_stitched) return soup_of(p, {{0, 3, 2, 1}, {0, 1, 4, 5}});
    // Apart by less than a welder could see, and along the axis half a step on.
    p.push_back(low - glm::dvec3(0, 0.5, 0));
    p.push_back(high + glm::dvec3(0, 0.5, 0));
    return soup_of(p, {{0, 3, 2, 1}, {6, 7, 4, 5}});
}

struct Ink {
    double crease, all, hidden;
};

Ink ink_of(double angle_deg, bool is_stitched, std::array<double, 2> interval_deg, bool from_behind = false) {
    Scene scene = scene_of({hinge(angle_deg, is_stitched)});
    scene.lines.classes = LineClass::crease;
    scene.lines.crease_angle_deg = 0.5 * (interval_deg[0] + interval_deg[1]);
    scene.lines.crease_fade_deg = interval_deg[1] - interval_deg[0];
    scene.lines.style.width_px = 2;
    scene.abuffer.samples = 4;  // where surfaces touch, ends are as exact as samples
    if (from_behind) {          // a wall between the hinge and the eye
        PolygonSoup wall = soup_of({{-2, -2, 1}, {2, -2, 1}, {2, 2, 1}, {-2, 2, 1}}, {{0, 1, 2, 3}});
        Scene walled = scene_of({hinge(angle_deg, is_stitched), wall});
        walled.lines = scene.lines;
        walled.abuffer = scene.abuffer;
        walled.lines.style.hidden.style = HiddenStyle::solid;
        scene = std::move(walled);
    }
    const Camera camera = perspective_camera({0, 0, 6}, {0, 0, 0});
    const Drawing drawing(scene, camera, kSize, kSize, {0, 0, kSize, kSize}, 2, render_abuffer);
    return {drawing.sum(LineClass::crease), drawing.sum("lines.A"), from_behind ? drawing.sum("lines_hidden.A") : 0};
}

void expect_linear(bool is_stitched, bool from_behind) {
    const std::array<double, 2> interval{35, 45};
    const auto measure = [&](double angle_deg) {
        const Ink ink = ink_of(angle_deg, is_stitched, interval, from_behind);
        return from_behind ? ink.hidden : ink.crease;
    };
    const double full = measure(46);
    EXPECT_GT(full, 60);
    const double limit =
        from_behind ? ink_of(46, is_stitched, {40, 40}, true).hidden : ink_of(46, is_stitched, {40, 40}).crease;
    EXPECT_EQ(full, limit) << "a full stroke is a plain one";
    double last = 0;
    for (double angle_deg = 34; angle_deg < 46.5; angle_deg += 0.25) {
        const double ink = measure(angle_deg);
        const double expected = full * std::clamp((angle_deg - 35) / 10, 0.0, 1.0);
        EXPECT_NEAR(ink, expected, 0.02 * full) << angle_deg;
        EXPECT_GE(ink, last - 0.005 * full) << angle_deg;
        last = ink;
    }
    EXPECT_EQ(measure(34.9), 0);
}

TEST(CreaseFade, AHingeOpensWithoutAPop) { expect_linear(true, false); }
TEST(CreaseFade, SoDoSurfacesThatTouch) { expect_linear(false, false); }
TEST(CreaseFade, AndHiddenLines) { expect_linear(true, true); }

TEST(CreaseFade, AnIntervalWithoutLengthIsAnAngle) {
    EXPECT_EQ(ink_of(39.9, true, {40, 40}).crease, 0);
    EXPECT_EQ(ink_of(40.1, true, {40, 40}).crease, ink_of(40.1, true, {30, 35}).crease);
}

TEST(CreaseFade, LiesBelowOtherLinesWithoutCountingTwice) {
    for (const double angle_deg : {36.0, 40.0, 44.0}) {
        const Ink ink = ink_of(angle_deg, true, {35, 45});
        EXPECT_NEAR(ink.all, ink.crease, 0.01 * ink.all);
    }
    // With polygon lines, the edge is there anyway.
    Scene scene = scene_of({hinge(36, true)});
    scene.lines.classes = LineClass::crease | LineClass::polygon;
    scene.lines.crease_fade_deg = 10;
    const Camera camera = perspective_camera({0, 0, 6}, {0, 0, 0});
    const Drawing soft(scene, camera, kSize, kSize, {0, 0, kSize, kSize}, 1, render_abuffer);
    scene.lines.crease_fade_deg = 0;
    const Drawing hard(scene, camera, kSize, kSize, {0, 0, kSize, kSize}, 1, render_abuffer);
    EXPECT_NEAR(soft.sum("lines.A"), hard.sum("lines.A"), 1e-3);
}

}  // namespace
}  // namespace burin::crease_fade_test
