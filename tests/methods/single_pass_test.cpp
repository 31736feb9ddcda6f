// What the single-pass method must show, and must not, on the minimal scenes.

#include "methods/wire/single_pass.h"

#include <gtest/gtest.h>

#include "methods/method_table.h"
#include "methods/wire/wire_profile.h"
#include "tests/methods/wire_checks.h"

namespace burin::single_pass_test {
namespace {

using namespace test;

constexpr double kGaussPx = 1.50538;  // integrated width of exp2(-2 d^2)

PolygonSoup two_rectangles(double x) {
    return soup_of({at_pixel(20, 20, 0.5), at_pixel(x, 20, 0.5), at_pixel(230, 20, 0.5), at_pixel(230, 230, 0.5),
                    at_pixel(x, 230, 0.5), at_pixel(20, 230, 0.5)},
                   {{5, 4, 1, 0}, {4, 3, 2, 1}});
}

double row_sum(const Drawing& d, int y, int x0, int x1) {
    double sum = 0;
    for (int x = x0; x < x1; ++x) sum += d.line(x, y);
    return sum;
}

TEST(SinglePass, SilhouettesHaveHalfTheWidthOfInnerLines) {
    const MinimalScene sil = scene_sil(), slope = scene_slope(0);
    const Drawing s = draw(as_published(sil), render_single_pass), i = draw(as_published(slope), render_single_pass);
    for (const ScreenSegment& line : sil.lines) EXPECT_NEAR(integrated_width(s, line.a, line.b), 0.7527, 0.01);
    EXPECT_NEAR(integrated_width(i, slope.lines[0].a, slope.lines[0].b), kGaussPx, 0.005);
    for (const double width : {0.5, 1.0, 3.0}) {
        MinimalScene narrow = sil, inner = slope;
        narrow.scene.lines.style.width_px = inner.scene.lines.style.width_px = width;
        const Drawing a = draw(narrow, render_single_pass), b = draw(inner, render_single_pass);
        for (const ScreenSegment& line : sil.lines)
            EXPECT_NEAR(integrated_width(a, line.a, line.b), width / 2, 0.015 * width);
        EXPECT_NEAR(integrated_width(b, slope.lines[0].a, slope.lines[0].b), width, 0.005 * width);
    }
}

TEST(SinglePass, WidthAtSilhouettesDependsOnPhase) {
    double lowest = 1e9, highest = 0, inner_low = 1e9, inner_high = 0;
    for (int phase = 0; phase < 256; phase += 17) {
        const double x = 100.5 + phase / 256.0;
        const MinimalScene s = scene_from({two_rectangles(x)});
        const Drawing d = draw(as_published(with_classes(s, LineClass::polygon)), render_single_pass);
        const double inner = row_sum(d, 128, 90, 112);
        inner_low = std::min(inner_low, inner);
        inner_high = std::max(inner_high, inner);
    }
    EXPECT_GT(inner_low, 1.5029 - 2e-3);
    EXPECT_LT(inner_high, 1.5079 + 2e-3);
    for (const int phase : {0, 1, 64, 128, 255}) {
        const double x = 100.5 + phase / 256.0;
        PolygonSoup soup =
            soup_of({at_pixel(x, 20, 0.5), at_pixel(230, 20, 0.5), at_pixel(230, 230, 0.5), at_pixel(x, 230, 0.5)},
                    {{3, 2, 1, 0}});
        const Drawing d = draw(as_published(scene_from({soup})), render_single_pass);
        const double sum = row_sum(d, 128, 90, 112);
        lowest = std::min(lowest, sum);
        highest = std::max(highest, sum);
    }
    EXPECT_NEAR(highest, 1.254, 2e-3);  // a row of centres on the edge
    EXPECT_NEAR(lowest, 0.254, 1e-2);   // the next centres almost a pixel inside
}

TEST(SinglePass, NothingIsDrawnBesideSurfaces) {
    const MinimalScene sphere = with_classes(scene_sphere(), LineClassSet::all());
    for (const MinimalScene& s : {scene_sil(), scene_concave(), sphere}) {
        const Drawing d = draw(s, render_single_pass);
        int lines = 0;
        for (int y = 0; y < 256; ++y) {
            for (int x = 0; x < 256; ++x) {
                lines += d.line(x, y) > 0;
                if (d.at("id.object", x, y) == 0) {
                    EXPECT_EQ(d.line(x, y), 0);
                }
            }
        }
        EXPECT_GT(lines, 100);
    }
}

TEST(SinglePass, PixelsDependOnTheirDistanceAlone) {
    // So there is neither stipple on steep surfaces nor an end that is not the surface's own.
    for (const double b : {0.0, 1e-4, -1e-3, 1e-2, -1e-2}) {
        const MinimalScene s = with_classes(scene_slope(b), LineClass::polygon);
        for (const WirePath path :
             {WirePath::linear, WirePath::premultiplied, WirePath::homogeneous, WirePath::cases}) {
            MinimalScene t = s;
            t.scene.wire.path = path;
            const Drawing d = draw(t, render_single_pass);
            const WireProfile profile = matched_profile(WireProfileKind::gauss, 1);
            for (int y = 0; y < 256; ++y) {
                for (int x = 0; x < 256; ++x) {
                    if (d.at("id.object", x, y) == 0) continue;
                    const double along = std::abs(cross(glm::normalize(s.lines[0].b - s.lines[0].a),
                                                        glm::dvec2(x + 0.5, y + 0.5) - s.lines[0].a));
                    // Corners are snapped to 1/256 pixel.
                    ASSERT_NEAR(d.line(x, y), profile.intensity(along), 0.02) << b << " at " << x << "," << y;
                }
            }
        }
    }
}

TEST(SinglePass, NothingLeaksThroughAnyGap) {
    for (const double gap : {1e-6, 1e-4, 1e-2, 1e-1}) {
        EXPECT_EQ(draw(with_classes(scene_gap(gap), LineClass::polygon | LineClass::border), render_single_pass)
                      .sum("lines.A"),
                  0)
            << gap;
    }
    EXPECT_EQ(draw(scene_sphere(), render_single_pass).sum("lines.A"), 0);
    const Drawing d = draw(scene_dilemma(), render_single_pass);
    const MinimalScene s = scene_dilemma();
    EXPECT_NEAR(integrated_width(d, s.lines[0].a, s.lines[0].b), 1, 0.01);
    EXPECT_LT(integrated_width(d, s.lines[1].a, s.lines[1].b), 1e-6);
}

TEST(SinglePass, DenseMeshesTurnSolid) {
    const Drawing d = draw(as_published(scene_dense()), render_single_pass);
    double sum = 0, least = 1;
    for (int y = 60; y < 190; ++y) {
        for (int x = 60; x < 190; ++x) {
            sum += d.line(x, y);
            least = std::min(least, d.line(x, y));
        }
    }
    EXPECT_GT(least, 0.45);
    EXPECT_GT(sum / (130 * 130), 0.75);
    // Fading is the cure.
    MinimalScene faded = as_published(scene_dense());
    faded.scene.wire.fade_distance = 100;  // of 1000
    const Drawing f = draw(faded, render_single_pass);
    EXPECT_NEAR(f.line(128, 128), 0.1 * d.line(128, 128), 2e-3);
}

TEST(SinglePass, IntersectionsHaveNoLine) {
    const MinimalScene s = scene_intersect();
    const Drawing d = draw(s, render_single_pass);
    EXPECT_EQ(darkest(d, [&](glm::dvec2 p) { return std::abs(p.x - 128) < 2 && p.y > 110 && p.y < 160; }), 0);
    const Method* const method = find_method("single-pass");
    ASSERT_NE(method, nullptr);
    EXPECT_FALSE(method->draws.has(LineClass::intersection));
    EXPECT_FALSE(method->draws.has(LineClass::object));
    EXPECT_TRUE(method->draws.has(LineClass::silhouette));
}

TEST(SinglePass, ConcavePolygonsNeedFlags) {
    const MinimalScene s = scene_concave();
    // Below the inner corner (120.7, 130.2), where an edge's line runs on.
    const auto runs_on = [](glm::dvec2 p) { return std::abs(p.x - 120.7) < 1 && p.y > 140 && p.y < 200; };
    EXPECT_NEAR(darkest(draw(s, render_single_pass), runs_on),
                matched_profile(WireProfileKind::gauss, 1).intensity(0.2), 0.02);
    for (const WireExclude exclude : {WireExclude::flags, WireExclude::q}) {
        MinimalScene t = s;
        t.scene.wire.exclude = exclude;
        EXPECT_EQ(darkest(draw(t, render_single_pass), runs_on), 0);
    }
}

TEST(SinglePass, FlagsLeaveAGapAtAReflexVertex) {
    MinimalScene s = as_published(scene_concave(), 4);
    s.scene.wire.exclude = WireExclude::flags;
    const Drawing flags = draw(s, render_single_pass);
    int gap = 0;
    for (int y = 120; y < 140; ++y) {
        for (int x = 110; x < 132; ++x) {
            const bool is_core = glm::distance(glm::dvec2(x + 0.5, y + 0.5), glm::dvec2(120.7, 130.2)) < 3.9;
            gap += is_core && flags.at("id.object", x, y) > 0 && flags.line(x, y) < 0.5;
        }
    }
    EXPECT_GT(gap, 3);
}

TEST(SinglePass, FlagsCutANotchWherePolygonsDoNot) {
    MinimalScene s = as_published(scene_notch(), 2);
    const Drawing polygon = draw(s, render_single_pass);
    s.scene.wire.exclude = WireExclude::flags;
    const Drawing flags = draw(s, render_single_pass);
    int notch = 0, farthest = 0;
    for (int y = 100; y < 160; ++y) {
        for (int x = 80; x < 170; ++x) {
            const glm::dvec2 at(x + 0.5, y + 0.5);
            const bool is_core = distance_to(s.lines, at) <= 2 && polygon.at("id.object", x, y) > 0;
            if (!is_core) continue;
            EXPECT_GT(polygon.line(x, y), 0.99) << x << "," << y;
            if (flags.line(x, y) > 0.05) continue;
            ++notch;
            farthest = std::max(farthest, static_cast<int>(std::min(at.x - 90.3, 154.3 - at.x)));
        }
    }
    EXPECT_GE(notch, 4);
    EXPECT_LE(farthest, 2 * 64 / 16);  // t * long side / short side
    EXPECT_GE(farthest, 4);
}

TEST(SinglePass, QLeavesSpotsOnSlivers) {
    // No edge of these triangles is to be drawn. Where corner k has all the weight, its height is
    // what is left of the distance, and slivers have none. With the published Q of 100 that is a
    // spot of a hundredth of a pixel; with a Q that is just larger than the line it is a third of
    // the sliver.
    MinimalScene s = as_published(with_classes(scene_sliver(), LineClass::mark));
    s.scene.wire.exclude = WireExclude::q;
    const double small = draw(s, render_single_pass).sum("lines.A");
    EXPECT_GT(small, 0);
    EXPECT_LT(small, 2);
    s.scene.wire.q_px = 4;
    const Drawing spots = draw(s, render_single_pass);
    EXPECT_GT(spots.sum("lines.A"), 20);
    EXPECT_GT(darkest(spots, [](glm::dvec2 p) { return glm::distance(p, {128.3, 127.6}) > 95; }), 0.2);
    for (const WireExclude cure : {WireExclude::flags, WireExclude::polygon}) {
        s.scene.wire.exclude = cure;
        EXPECT_EQ(draw(s, render_single_pass).sum("lines.A"), 0);
    }
}

TEST(SinglePass, AQLessThanTheLineIsABand) {
    MinimalScene s = as_published(scene_notch(), 4);
    s.scene.wire.exclude = WireExclude::q;
    const auto middle = [](glm::dvec2 p) { return glm::distance(p, {122.3, 128.6}) < 1.5; };
    EXPECT_LT(darkest(draw(s, render_single_pass), middle), 1e-3);
    s.scene.wire.q_px = 3;
    EXPECT_GT(darkest(draw(s, render_single_pass), middle), 0.99);
}

TEST(SinglePass, LinesEndWithTheSurfacesPixels) {
    // Under an occluder a line is there or not, pixel by pixel, where the truth has a ramp.
    for (const double angle : {5.0, 20.0, 40.0}) {
        const MinimalScene s = with_classes(scene_cut(angle), LineClass::polygon);
        const Drawing d = draw(s, render_single_pass);
        const WireProfile profile = matched_profile(WireProfileKind::gauss, 1);
        int cut = 0, drawn = 0;
        for (int x = 30; x < 220; ++x) {
            const double whole = profile.intensity(std::abs(128.5 - 128.37));
            const double line = d.line(x, 128);
            EXPECT_TRUE(line == 0 || std::abs(line - whole) < 0.02) << x;
            cut += line == 0;
            drawn += line != 0;
        }
        EXPECT_GT(cut, 50) << angle;
        EXPECT_GT(drawn, 50) << angle;
    }
}

TEST(SinglePass, AlphaTestSeesThroughSurfaces) {
    MinimalScene s = with_classes(scene_gap(0.1), LineClass::polygon);
    EXPECT_EQ(draw(s, render_single_pass).sum("lines.A"), 0);
    s.scene.wire.alpha_test = 0.1;
    const Drawing d = draw(s, render_single_pass);
    EXPECT_GT(d.sum("lines.A"), 2000);
    EXPECT_EQ(d.sum("surface.A"), 0);
}

TEST(SinglePass, ThreadsAndCropsChangeNothing) {
    for (const RenderFunction render : {render_single_pass, render_solid_wireframe, render_id_buffer}) {
        const MinimalScene s = with_classes(scene_sphere(), LineClassSet::all());
        const Drawing one = draw(s, render, 1), three = draw(s, render, 3);
        EXPECT_TRUE(same_bits(one.image(), three.image()));
        const Drawing part(s.scene, s.camera, 256, 256, {70, 41, 171, 190}, 2, render);
        for (int y = 41; y < 190; y += 3) {
            for (int x = 70; x < 171; x += 3) EXPECT_EQ(part.at("lines.A", x - 70, y - 41), one.line(x, y));
        }
    }
}

TEST(SinglePass, LayersFitTogether) {
    for (const RenderFunction render : {render_single_pass, render_solid_wireframe, render_id_buffer}) {
        const Drawing d = draw(with_classes(scene_sphere(), LineClassSet::all()), render);
        for (int y = 0; y < 256; y += 5) {
            for (int x = 0; x < 256; x += 5) {
                double sum = 0;
                for (int c = 0; c < kLineClassCount; ++c) sum += d.line(static_cast<LineClass>(c), x, y);
                EXPECT_NEAR(sum, d.line(x, y), 1e-3);
                EXPECT_NEAR(d.at("A", x, y), d.line(x, y) + (1 - d.line(x, y)) * d.at("surface.A", x, y), 2e-3);
                EXPECT_EQ(d.at("id.object", x, y) == 0, std::isinf(d.at("Z", x, y)));
            }
        }
    }
}

}  // namespace
}  // namespace burin::single_pass_test
