// What varies a line along its edge and with depth: dashes, dots, squeeze, dual strokes, thinning.

#include "methods/wire/wire_stroke.h"

#include <gtest/gtest.h>

#include "tests/methods/wire_checks.h"

namespace burin::wire_stroke_test {
namespace {

using namespace test;

constexpr RenderFunction kMethods[] = {render_single_pass, render_solid_wireframe, render_id_buffer};

WireEdge level_edge(double length) {
    WireEdge e;
    e.to = {length, 0};
    e.from_nearness = e.to_nearness = 1;
    e.line = {0, 1, 0};
    return e;
}

TEST(WireStroke, DashesAreTheirAveragesOverAPixel) {
    for (const double duty : {0.2, 0.5, 0.9}) {
        double sum = 0;
        for (int i = 0; i < 1200; ++i) {
            const double x = i / 300.0, spread = 1 / 12.0;
            int on = 0;
            for (int k = 0; k < 1000; ++k) {
                const double at = x + ((k + 0.5) / 1000 - 0.5) * spread;
                on += at - std::floor(at) < duty;
            }
            EXPECT_NEAR(dash_coverage(x, spread, duty), on / 1000.0, 2e-3);
            sum += dash_coverage(x, spread, duty);
        }
        EXPECT_NEAR(sum / 1200, duty, 1e-3);
    }
    EXPECT_EQ(dash_coverage(0.3, 1e-15, 0.5), 1);
    EXPECT_EQ(dash_coverage(0.7, 1e-15, 0.5), 0);
}

TEST(WireStroke, ThinningEndsAtTheFarPlane) {
    EXPECT_EQ(thinning_factor(WireThinning::none, 1), 1);
    EXPECT_DOUBLE_EQ(thinning_factor(WireThinning::linear, 0.25), 0.75);
    EXPECT_EQ(thinning_factor(WireThinning::hermite, 0.75), 1);
    EXPECT_DOUBLE_EQ(thinning_factor(WireThinning::hermite, 0.875), 0.5);
    EXPECT_EQ(thinning_factor(WireThinning::hermite, 1), 0);
}

TEST(WireStroke, DashesInSpaceGetShorterWithDistance) {
    WireEdge e = level_edge(100);
    e.to_nearness = 0.25;  // four times as far
    WireSettings settings;
    settings.pattern = WirePattern::dash;
    settings.repeats = 4;
    const WireStroke stroke(settings, 1, WireProfileKind::gauss, 0);
    // The first of four dashes, half of 1/4 of the edge in space, ends where s / 4 / (100 - s + s /
    // 4) = 1/8.
    const double end = 400.0 / 11;
    EXPECT_NEAR(stroke.intensity(e, 0, end - 2, 0), 1, 1e-9);
    EXPECT_NEAR(stroke.intensity(e, 0, end, 0), 0.5, 0.02);
    EXPECT_NEAR(stroke.intensity(e, 0, end + 2, 0), 0, 1e-9);
}

TEST(WireStroke, DashesHaveNoJumpAcrossASharedEdge) {
    for (const RenderFunction render : kMethods) {
        MinimalScene s = with_classes(scene_slope(1e-3), LineClass::polygon);
        s.scene.wire.pattern = WirePattern::dash;
        s.scene.wire.profile = WireProfileKind::gauss;
        s.scene.lines.style.width_px = 3;
        const Drawing d = draw(s, render);
        // What both halves of the stroke must show, from whichever end the dashes are counted.
        const WireProfile profile = matched_profile(WireProfileKind::gauss, 3);
        const glm::dvec2 a = s.lines[0].a, b = s.lines[0].b;
        const double length = glm::distance(a, b);
        double jump[2] = {0, 0};
        for (int y = 0; y < 256; ++y) {
            for (int x = 0; x < 256; ++x) {
                const auto [distance, along] = segment_distance(a, b, {x + 0.5, y + 0.5});
                if (along < 2 || along > length - 2 || distance > 1.5) continue;
                for (const int from_b : {0, 1}) {
                    const double dash = dash_coverage((from_b ? length - along : along) / 12, 1.0 / 12, 0.5);
                    jump[from_b] = std::max(jump[from_b], std::abs(d.line(x, y) - dash * profile.intensity(distance)));
                }
            }
        }
        EXPECT_LT(std::min(jump[0], jump[1]), 0.02);
    }
}

TEST(WireStroke, InkOfDashesIsDutyTimesWidth) {
    for (const RenderFunction render : kMethods) {
        for (const double duty : {0.25, 0.5}) {
            MinimalScene s = with_classes(scene_slope(0), LineClass::polygon);
            s.scene.wire.pattern = WirePattern::dash;
            s.scene.wire.duty = duty;
            // Eight tenths of the line are a whole number of periods.
            const glm::dvec2 a = s.lines[0].a, b = s.lines[0].b;
            s.scene.wire.period_px = 0.8 * glm::distance(a, b) / 12;
            s.scene.lines.style.width_px = 2;
            EXPECT_NEAR(integrated_width(draw(s, render), a, b), 2 * duty, 0.02);
        }
    }
}

TEST(WireStroke, DualStrokesAreHollow) {
    for (const RenderFunction render : kMethods) {
        MinimalScene s = with_classes(scene_slope(0), LineClass::polygon);
        s.scene.lines.style.width_px = 8;
        s.scene.wire.dual = 0.5;
        const Drawing d = draw(s, render);
        const ScreenSegment line = s.lines[0];
        const auto between = [&](double low, double high) {
            return darkest(d, [&](glm::dvec2 p) {
                const auto [distance, along] = segment_distance(line.a, line.b, p);
                return along > 20 && along < glm::distance(line.a, line.b) - 20 && distance >= low && distance <= high;
            });
        };
        EXPECT_EQ(between(0, 0.5), 0);
        EXPECT_GT(between(2.5, 3.5), 0.8);
        EXPECT_NEAR(integrated_width(d, line.a, line.b), 4, 0.1);
    }
}

TEST(WireStroke, SqueezedLinesAreThinInTheMiddle) {
    for (const RenderFunction render : kMethods) {
        MinimalScene s = with_classes(scene_slope(0), LineClass::polygon);
        s.scene.lines.style.width_px = 6;
        s.scene.wire.squeeze_min = 0.25;
        const Drawing d = draw(s, render);
        const glm::dvec2 a = s.lines[0].a, b = s.lines[0].b;
        EXPECT_NEAR(integrated_width(d, glm::mix(a, b, 0.45), glm::mix(a, b, 0.55)), 1.5, 0.08);
        EXPECT_GT(integrated_width(d, glm::mix(a, b, 0.02), glm::mix(a, b, 0.06)), 5);
    }
}

TEST(WireStroke, LinesGetThinnerWithDepth) {
    for (const RenderFunction render : kMethods) {
        MinimalScene s = with_classes(scene_slope(4e-3), LineClass::polygon);
        s.scene.lines.style.width_px = 6;
        s.scene.wire.thinning = WireThinning::linear;
        const Drawing d = draw(s, render);
        // z runs over the square from top to bottom; the line from (1 - .37) / 2 to (1 + .37) / 2
        // of it.
        const glm::dvec2 a = s.lines[0].a, b = s.lines[0].b;
        EXPECT_NEAR(integrated_width(d, glm::mix(a, b, 0.0), glm::mix(a, b, 0.2)), 6 * (1 - 0.352), 0.15);
        EXPECT_NEAR(integrated_width(d, glm::mix(a, b, 0.8), glm::mix(a, b, 1.0)), 6 * (1 - 0.648), 0.15);
    }
}

TEST(WireStroke, DotsAreDiscs) {
    WireSettings settings;
    settings.pattern = WirePattern::dots;
    const WireStroke stroke(settings, 2, WireProfileKind::step, 0);
    const WireEdge e = level_edge(60);
    // Every 2 x 1.5 x 2 px a disc of radius 2, the first one's middle 3 px from the start.
    EXPECT_EQ(stroke.intensity(e, 1.9, 3, 0), 1);
    EXPECT_EQ(stroke.intensity(e, 0, 4.9, 0), 1);
    EXPECT_EQ(stroke.intensity(e, 0, 5.1, 0), 0);
    EXPECT_EQ(stroke.intensity(e, 1.5, 4.9, 0), 0);
    EXPECT_EQ(stroke.intensity(e, 0, 9, 0), 1);
    EXPECT_GE(stroke.reach_px(), 2);
}

}  // namespace
}  // namespace burin::wire_stroke_test
