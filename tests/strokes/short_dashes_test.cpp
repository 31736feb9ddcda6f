// Dashes too short to be seen are drawn as a solid line of less strength, in bounded time.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "shading/dash_style.h"
#include "tests/support/drawing.h"

namespace burin::short_dashes_test {
namespace {

using namespace test;

constexpr int kSize = 100;

/// Ink of the lines of a body, a box unless another is given, visible or hidden.
double ink(std::array<double, 2> dash_px, double width_px, bool is_hidden, bool is_solid = false,
           const PolygonSoup& body = make_box({1, 1, 1})) {
    Scene scene = scene_of({body});
    LineStyle& style = scene.lines.style;
    style.width_px = width_px;
    if (is_hidden) {
        style.hidden.style = is_solid ? HiddenStyle::solid : HiddenStyle::dashed;
        style.hidden.dash_px = dash_px;
    } else if (!is_solid) {
        style.dash_px = dash_px;
    }
    const Drawing drawing(scene, perspective_camera({1.7, 1.3, 2.5}, {0, 0, 0}), kSize, kSize, {0, 0, kSize, kSize}, 1,
                          render_abuffer);
    return drawing.sum(is_hidden ? "lines_hidden.A" : "lines.A");
}

// None of these may take longer than a solid line, or more memory.
TEST(ShortDashes, HaveTheirShareOfTheSolidLine) {
    constexpr double kLeast = std::numeric_limits<double>::denorm_min();
    for (const bool is_hidden : {false, true}) {
        for (const double width_px : {0.3, 1.0, 4.0}) {
            const double solid = ink({}, width_px, is_hidden, true);
            for (const auto [on, off] : {std::array{1e-6, 1e-6},
                                         {1e-300, 1e-300},
                                         {kLeast, kLeast},
                                         {1e-6, 3e-6},
                                         {3e-9, 1e-9},
                                         {1e-9, 0.01},
                                         {0.007, 0.007}}) {
                EXPECT_NEAR(ink({on, off}, width_px, is_hidden) / solid, on / (on + off), 0.01)
                    << on << ' ' << off << ' ' << width_px << is_hidden;
            }
        }
    }
}

// From a period to one a little longer, the ink changes by a little: from dashes that are drawn to those that are not,
// and in between.
TEST(ShortDashes, AreContinuousWithLongerOnes) {
    for (const bool is_hidden : {false, true}) {
        for (const double width_px : {0.3, 1.0, 4.0}) {
            const double solid = ink({}, width_px, is_hidden, true);
            for (const double share : {0.2, 0.5, 0.9}) {
                double before = -1;
                for (double period_px = 0.6; period_px > 0.01; period_px *= 0.97) {
                    const double here = ink({share * period_px, (1 - share) * period_px}, width_px, is_hidden) / solid;
                    if (before >= 0) {
                        EXPECT_NEAR(here, before, 0.025) << period_px << ' ' << width_px << ' ' << share << is_hidden;
                    }
                    before = here;
                }
            }
        }
    }
}

TEST(ShortDashes, InkOfThoseThatAreDrawn) {
    for (const double width_px : {1.0, 2.0}) {
        const double solid = ink({}, width_px, false, true);
        for (const std::array<double, 2> dash_px : {std::array{8.0, 6.0}, {1.0, 2.0}, {0.5, 0.5}, {3.0, 0.5}}) {
            EXPECT_NEAR(ink(dash_px, width_px, false) / solid, ink_of_dashes(dash_px, width_px), 0.05)
                << dash_px[0] << ' ' << dash_px[1];
        }
    }
}

// Where dashes are stretched so that a whole number fits on a loop, too: a dash no longer than the pen is wide is a
// dot.
TEST(ShortDashes, OnARimHiddenOnesHaveAsMuchInkAsVisibleOnes) {
    const PolygonSoup drum = make_cylinder(0.6, 0.6, 0.8, 64);
    constexpr double kWidthPx = 3;
    for (const bool is_hidden : {false, true}) {
        const double solid = ink({}, kWidthPx, is_hidden, true, drum);
        EXPECT_GT(solid, 100);
        for (const std::array<double, 2> dash_px :
             {std::array{3.0, 4.0}, {2.0, 2.0}, {3.0, 1.0}, {1.5, 1.5}, {4.0, 6.0}}) {
            EXPECT_NEAR(ink(dash_px, kWidthPx, is_hidden, false, drum) / solid, ink_of_dashes(dash_px, kWidthPx), 0.08)
                << dash_px[0] << ' ' << dash_px[1] << is_hidden;
        }
    }
}

TEST(ShortDashes, OnlyThoseThatCanBeSeenAreLaidOut) {
    LineStyle style;
    EXPECT_FALSE(visible_dashes(style).dash_px);
    style.dash_px = {0.25, 0.25};
    EXPECT_TRUE(visible_dashes(style).dash_px);
    EXPECT_EQ(visible_dashes(style).opacity, 1);
    style.dash_px = {0.25, 0.2499};
    EXPECT_FALSE(visible_dashes(style).dash_px);
    style.dash_px = {1e-9, 65535};  // a dot here and there
    EXPECT_TRUE(visible_dashes(style).dash_px);
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                     kInfinite = std::numeric_limits<double>::infinity();
    for (const double bad : {kNan, kInfinite, -1.0, 0.0}) {
        style.dash_px = {bad, 4};
        EXPECT_FALSE(visible_dashes(style).dash_px) << bad;
        EXPECT_EQ(visible_dashes(style).opacity, 1) << bad;
    }
    style.hidden.dash_px = {1e-6, 1e-6};
    EXPECT_EQ(hidden_dashes(style).opacity, 1) << "hidden lines are not dashed";
    style.hidden.style = HiddenStyle::dashed;
    EXPECT_EQ(hidden_dashes(style).opacity, 0.5);
}

}  // namespace
}  // namespace burin::short_dashes_test
