// What the ID buffer method must show, and must not, on the minimal scenes.

#include "methods/wire/id_buffer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "mesh/shapes.h"
#include "methods/wire/wire_profile.h"
#include "tests/methods/wire_checks.h"
#include "tests/support/random.h"

namespace burin::id_buffer_test {
namespace {

using namespace test;

constexpr double kCut = 1.8;

/// Every pixel of the picture shows its distance to the lines, on surfaces and beside them.
void expect_strokes(const MinimalScene& s, const WireProfile& profile) {
    const Drawing d = draw(s, render_id_buffer);
    for (int y = 0; y < s.size_px; ++y) {
        for (int x = 0; x < s.size_px; ++x) {
            const double distance = distance_to(s.lines, {x + 0.5, y + 0.5});
            if (std::abs(distance - profile.reach_px()) < 0.01) continue;  // corners are snapped
            ASSERT_NEAR(d.line(x, y), profile.intensity(distance), 0.02) << x << "," << y;
        }
    }
}

TEST(IdBuffer, SilhouettesHaveTheirWholeWidth) {
    const MinimalScene sil = as_published(scene_sil());
    const Drawing d = draw(sil, render_id_buffer);
    for (const ScreenSegment& line : sil.lines) EXPECT_NEAR(integrated_width(d, line.a, line.b), 1.5013, 0.01);
    for (const double width : {0.5, 1.0, 3.0}) {
        MinimalScene s = scene_sil();
        s.scene.lines.style.width_px = width;
        const Drawing m = draw(s, render_id_buffer);
        for (const ScreenSegment& line : s.lines) EXPECT_NEAR(integrated_width(m, line.a, line.b), width, 0.01 * width);
    }
}

TEST(IdBuffer, StrokesAreTheSameOnBothSidesOfASilhouette) {
    // So a line is continuous where the fill below it changes, and as black as it gets there.
    expect_strokes(as_published(scene_sil()), {WireProfileKind::gauss, 0, 1, 1, kCut});
    expect_strokes(scene_sil(), matched_profile(WireProfileKind::gauss, 1, kCut));
    expect_strokes(as_published(scene_sil(), 2), {WireProfileKind::gauss, 2, 1, 1, kCut});
}

TEST(IdBuffer, WidthAtSilhouettesHardlyDependsOnPhase) {
    double lowest = 1e9, highest = 0;
    for (int phase = 0; phase < 256; phase += 17) {
        const double x = 100.5 + phase / 256.0;
        const PolygonSoup soup =
            soup_of({at_pixel(x, 20, 0.5), at_pixel(230, 20, 0.5), at_pixel(230, 230, 0.5), at_pixel(x, 230, 0.5)},
                    {{3, 2, 1, 0}});
        const Drawing d = draw(as_published(scene_from({soup})), render_id_buffer);
        double sum = 0;
        for (int i = 90; i < 112; ++i) sum += d.line(i, 128);
        lowest = std::min(lowest, sum);
        highest = std::max(highest, sum);
    }
    // 0.3 % of the Gaussian, and as much again from cutting it off at 1.8 px, where it is .011.
    EXPECT_LT(highest - lowest, 0.012 * 1.5013);
    EXPECT_NEAR(0.5 * (lowest + highest), 1.5013, 0.008);
}

TEST(IdBuffer, PolygonsMayBeConcave) {
    expect_strokes(scene_concave(), matched_profile(WireProfileKind::gauss, 1, kCut));
}

TEST(IdBuffer, OutlinesHaveNoNotches) {
    MinimalScene s = as_published(scene_notch(), 2);
    s.lines.push_back({s.lines[0].a, s.lines[1].a});
    s.lines.push_back({s.lines[0].b, s.lines[1].b});
    expect_strokes(s, {WireProfileKind::gauss, 2, 1, 1, kCut});
}

TEST(IdBuffer, SharedEdgesAreWholeAtEverySlope) {
    for (const double b : {0.0, 1e-4, -1e-3, 1e-2, -1e-2}) {
        const MinimalScene s = with_classes(scene_slope(b), LineClass::polygon);
        const Drawing d = draw(s, render_id_buffer);
        EXPECT_NEAR(integrated_width(d, s.lines[0].a, s.lines[0].b), 1, 0.005) << b;
        const WireProfile profile = matched_profile(WireProfileKind::gauss, 1, kCut);
        for (int y = 0; y < 256; ++y) {
            for (int x = 0; x < 256; ++x) {
                if (d.at("id.object", x, y) == 0) continue;
                const double distance = distance_to(s.lines, {x + 0.5, y + 0.5});
                if (std::abs(distance - profile.reach_px()) < 0.01) continue;
                ASSERT_NEAR(d.line(x, y), profile.intensity(distance), 0.02) << b << ": " << x << "," << y;
            }
        }
    }
}

TEST(IdBuffer, NothingLeaksThroughAnyGapBetweenSurfacesThatFaceTheEye) {
    for (const double gap : {1e-6, 1e-4, 1e-2, 1e-1}) {
        EXPECT_EQ(
            draw(with_classes(scene_gap(gap), LineClass::polygon | LineClass::border), render_id_buffer).sum("lines.A"),
            0)
            << gap;
    }
}

/// A marked edge behind a parallel cover whose depth changes by b per pixel; all else is unmarked.
MinimalScene covered_edge(double b, double gap) {
    const auto p = [b](double x, double y, double z) { return at_pixel(x, y, 0.5 + b * (y - 128) + z); };
    PolygonSoup hidden = soup_of({p(100, 110.3, gap), p(180, 120.8, gap), p(150, 150, gap)}, {{0, 2, 1}});
    hidden.marked_edges = {{0, 1}};
    const PolygonSoup cover = soup_of({p(80, 90, 0), p(200, 90, 0), p(200, 165, 0), p(80, 165, 0)}, {{3, 2, 1, 0}});
    return with_classes(scene_from({hidden, cover}), LineClass::mark);
}

TEST(IdBuffer, SteepSurfacesLeakWhatTheyDescendWithinAStroke) {
    // A stroke keeps its edge's depth across its width, while the cover's depth goes on changing:
    // on one side it comes out if the gap is less than slope times reach.
    const double reach = matched_profile(WireProfileKind::gauss, 1, kCut).reach_px();
    for (const double b : {1e-3, 1e-2, -1e-2, 2e-2}) {
        EXPECT_EQ(draw(covered_edge(b, 1.02 * reach * std::abs(b)), render_id_buffer).sum("lines.A"), 0) << b;
        const double leak = draw(covered_edge(b, 0.1 * reach * std::abs(b)), render_id_buffer).sum("lines.A");
        EXPECT_GT(leak, 20) << b;
        EXPECT_LT(leak, 0.5 * 81) << b << ": half the stroke";
    }
    const MinimalScene s = scene_dilemma();
    const Drawing d = draw(s, render_id_buffer);
    EXPECT_NEAR(integrated_width(d, s.lines[0].a, s.lines[0].b), 1, 0.01);
    EXPECT_GT(integrated_width(d, s.lines[1].a, s.lines[1].b), 0.1);
}

TEST(IdBuffer, HiddenEdgesShowAtTheLimbOfASphere) {
    // A pixel below the surface: deep in the middle of the sphere, less than a stroke at its limb.
    const Drawing d = draw(scene_sphere(), render_id_buffer);
    const auto is_inner = [](glm::dvec2 p) { return glm::distance(p, {128.2, 127.9}) < 70; };
    EXPECT_EQ(darkest(d, is_inner), 0);
    EXPECT_GT(d.sum("lines.A"), 0);
}

TEST(IdBuffer, TheSlopeVariantLeaksHalfAPixelsSlopeMore) {
    MinimalScene s = covered_edge(1e-2, 0.004);
    const double plain = draw(s, render_id_buffer).sum("lines.A");
    s.scene.wire.slope = true;
    const double allowing = draw(s, render_id_buffer).sum("lines.A");
    EXPECT_GT(allowing, plain + 20);
    s = covered_edge(1e-2, 0.5e-2 + 1.02 * 1.2e-2);
    s.scene.wire.slope = true;
    EXPECT_EQ(draw(s, render_id_buffer).sum("lines.A"), 0);
}

TEST(IdBuffer, TheOrderOfPolygonsDoesNotMatter) {
    for (std::uint64_t trial = 0; trial < 4; ++trial) {
        Random random(trial);
        std::vector<glm::dvec3> positions;
        std::vector<std::vector<std::uint32_t>> polygons;
        for (std::uint32_t i = 0; i < 40; ++i) {
            const glm::dvec2 middle(random.real(40, 216), random.real(40, 216));
            for (int k = 0; k < 3; ++k) {
                positions.push_back(
                    at_pixel(middle.x + random.real(-40, 40), middle.y + random.real(-40, 40), random.real(0.1, 0.9)));
            }
            polygons.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        }
        std::vector<std::vector<std::uint32_t>> shuffled = polygons;
        for (std::size_t i = shuffled.size() - 1; i > 0; --i) {
            std::swap(shuffled[i], shuffled[static_cast<std::size_t>(random.integer(0, static_cast<int>(i)))]);
        }
        const Drawing a = draw(scene_from({soup_of(positions, polygons)}), render_id_buffer);
        const Drawing b = draw(scene_from({soup_of(positions, shuffled)}), render_id_buffer);
        EXPECT_EQ(a.coverage(), b.coverage()) << trial;
        EXPECT_GT(a.sum("lines.A"), 1000);
    }
}

TEST(IdBuffer, LinesEndWithTheOccludersPixels) {
    // Pixels belong to one polygon: the line is there or not, where the truth has a ramp.
    for (const double angle : {5.0, 20.0, 40.0}) {
        const MinimalScene s = with_classes(scene_cut(angle), LineClass::polygon);
        const Drawing d = draw(s, render_id_buffer);
        const double whole = matched_profile(WireProfileKind::gauss, 1, kCut).intensity(0.13);
        int cut = 0, drawn = 0;
        for (int x = 30; x < 220; ++x) {
            const double line = d.line(x, 128);
            EXPECT_TRUE(line == 0 || std::abs(line - whole) < 0.02) << x;
            cut += line == 0;
            drawn += line != 0;
        }
        EXPECT_GT(cut, 50) << angle;
        EXPECT_GT(drawn, 50) << angle;
    }
}

/// A sheet without visible edges, and behind it a marked edge `inset_px` within its right border.
MinimalScene hidden_edge(double inset_px) {
    const PolygonSoup cover =
        soup_of({at_pixel(60, 60, 0.3), at_pixel(160, 60, 0.3), at_pixel(160, 200, 0.3), at_pixel(60, 200, 0.3)},
                {{3, 2, 1, 0}});
    PolygonSoup hidden = soup_of(
        {at_pixel(160 - inset_px, 80, 0.6), at_pixel(160 - inset_px, 180, 0.6), at_pixel(100, 130, 0.6)}, {{0, 2, 1}});
    hidden.marked_edges = {{0, 1}};
    return as_published(with_classes(scene_from({cover, hidden}), LineClass::mark));
}

TEST(IdBuffer, HiddenEdgesLeakOverTheBackgroundByAtMostTheirReach) {
    for (const double inset : {0.1, 0.9, 1.25}) {
        const Drawing d = draw(hidden_edge(inset), render_id_buffer);
        EXPECT_GT(d.sum("lines.A"), 0.5) << "the leak";
        EXPECT_EQ(darkest(d, [&](glm::dvec2 p) { return p.x < 160 || p.x > 160 - inset + 1.8; }), 0);
    }
    EXPECT_EQ(draw(hidden_edge(1.9), render_id_buffer).sum("lines.A"), 0);
    // Usually the silhouette's own stroke covers it.
    MinimalScene s = hidden_edge(0.1);
    s.scene.lines.classes = LineClass::mark | LineClass::border;
    const Drawing covered = draw(s, render_id_buffer);
    EXPECT_LT(covered.sum(LineClass::mark), 0.02 * covered.sum(LineClass::border));
}

TEST(IdBuffer, WhereEdgesEndInTheMiddleOfOthers) {
    // All three polygons draw their own side of the line through the T.
    const MinimalScene s = scene_tjunc();
    const Drawing d = draw(s, render_id_buffer);
    const std::vector<ScreenSegment> lines = {{{40.3, 60.6}, {210.7, 60.6}},   {{210.7, 60.6}, {210.7, 200.2}},
                                              {{210.7, 200.2}, {40.3, 200.2}}, {{40.3, 200.2}, {40.3, 60.6}},
                                              {{128.4, 60.6}, {128.4, 200.2}}, {{128.4, 130.7}, {210.7, 130.7}}};
    const WireProfile profile = matched_profile(WireProfileKind::gauss, 1, kCut);
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            const glm::dvec2 at(x + 0.5, y + 0.5);
            // Where an end reaches over a neighbour of the same depth, either may win.
            if (glm::distance(at, {128.4, 130.7}) < 2) continue;
            const double distance = distance_to(lines, at);
            if (std::abs(distance - profile.reach_px()) < 0.01) continue;
            ASSERT_NEAR(d.line(x, y), profile.intensity(distance), 0.02) << x << "," << y;
        }
    }
}

/// A tilted sheet with a marked edge, and beside it in the same plane, but of another object, one
/// without lines: half of the stroke lies on a polygon that the edge does not belong to.
MinimalScene foreign_neighbour(double b) {
    const auto p = [b](double x, double y) { return at_pixel(x, y, 0.5 + b * (y - 128)); };
    PolygonSoup sheet = soup_of({p(40.3, 60.2), p(210.4, 100.7), p(210.4, 190.3), p(40.3, 190.3)}, {{3, 2, 1, 0}});
    sheet.marked_edges = {{0, 1}};
    const PolygonSoup foreign =
        soup_of({p(-0.8, 50.413), p(251.5, 110.487), p(251.5, 20), p(-0.8, 20)}, {{0, 1, 2, 3}});
    return with_classes(scene_from({sheet, foreign}), LineClass::mark);
}

TEST(IdBuffer, OnForeignPolygonsStrokesAreComparedInDepth) {
    // Where the neighbour comes nearer away from the edge, its half of the stroke is lost. The
    // variant +slope brings back what lies within half a pixel.
    const glm::dvec2 a(40.3, 60.2), b(210.4, 100.7);
    for (const bool comes_nearer : {true, false}) {
        MinimalScene s = foreign_neighbour(comes_nearer ? 3e-3 : -3e-3);
        EXPECT_NEAR(integrated_width(draw(s, render_id_buffer), a, b), comes_nearer ? 0.51 : 1, 0.02);
        s.scene.wire.slope = true;
        EXPECT_NEAR(integrated_width(draw(s, render_id_buffer), a, b), comes_nearer ? 0.905 : 1, 0.02);
    }
}

TEST(IdBuffer, MorePolygonsThan24BitsCanNumberAreRefused) {
    // 4096 instances of 64 x 64 polygons are one too many for numbers from 1.
    Scene scene = scene_of({make_plane(1, 1, 64, 64)});
    scene.objects.resize(4096, scene.objects[0]);
    const auto draw_corner = [&] {
        return Drawing(scene, pixel_camera(256, 256), 256, 256, {0, 0, 1, 1}, 1, render_id_buffer);
    };
    EXPECT_THROW(draw_corner(), InputError);
}

TEST(IdBuffer, IntersectionsHaveNoLine) {
    const Drawing d = draw(scene_intersect(), render_id_buffer);
    EXPECT_EQ(darkest(d, [](glm::dvec2 p) { return std::abs(p.x - 128) < 2 && p.y > 110 && p.y < 160; }), 0);
}

TEST(IdBuffer, DenseMeshesTurnSolid) {
    // The darkest line wins, so cells of 1.5 px keep some grey in their middles.
    const Drawing d = draw(as_published(scene_dense()), render_id_buffer);
    double least = 1;
    for (int y = 60; y < 190; ++y) {
        for (int x = 60; x < 190; ++x) least = std::min(least, d.line(x, y));
    }
    EXPECT_GT(least, 0.45);
}

TEST(IdBuffer, WidthDoesNotDependOnAngle) {
    const MinimalScene s = scene_star();
    const Drawing d = draw(s, render_id_buffer);
    double sum = 0, squares = 0;
    for (const ScreenSegment& line : s.lines) {
        const double width = integrated_width(d, line.a, line.b);
        sum += width;
        squares += width * width;
    }
    const double mean = sum / 180, deviation = std::sqrt(squares / 180 - mean * mean);
    EXPECT_NEAR(mean, 1, 0.01);
    EXPECT_LT(deviation, 0.05);
}

TEST(IdBuffer, CornersBehindTheEyeAreNoTrouble) {
    for (const int behind : {0, 1, 2}) {
        const MinimalScene s = scene_near(behind);
        MinimalScene filled = s;
        filled.scene.wire.path = WirePath::homogeneous;
        filled.scene.wire.exclude = WireExclude::flags;
        const Drawing strokes = draw(s, render_id_buffer), truth = draw(filled, render_single_pass);
        int drawn = 0;
        for (int y = 0; y < 256; ++y) {
            for (int x = 0; x < 256; ++x) {
                if (truth.at("id.object", x, y) == 0) continue;
                EXPECT_NEAR(strokes.line(x, y), truth.line(x, y), 0.03) << behind << ": " << x << "," << y;
                drawn += truth.line(x, y) > 0.5;
            }
        }
        EXPECT_GT(drawn, 30);
    }
}

}  // namespace
}  // namespace burin::id_buffer_test
