// What the z-buffer methods show and do not show, scene by scene.

#include "mesh/shapes.h"
#include "tests/methods/zbuffer_support.h"

namespace burin::zbuffer_artefacts_test {
namespace {

using namespace test;

bool is_plane_method(std::string_view m) { return m == "edging-plane" || m == "virgin-plane" || m == "stencil"; }

TEST(ZBufferLines, AreOnePixelWideEverywhere) {
    // A single triangle, level: the whole stroke, within the silhouette and without; two levels.
    const MinimalScene s = scene_sil();
    for (const std::string_view method : kZBufferMethods) {
        const MethodDrawing d(method, s);
        double pixels = 0;
        for (const ScreenSegment& line : s.lines) {
            EXPECT_EQ(missing_share(d, line), 0) << method;
            pixels += std::max(std::abs(line.b.x - line.a.x), std::abs(line.b.y - line.a.y));
        }
        EXPECT_NEAR(d.sum("lines.A"), pixels, 4) << method;
        EXPECT_EQ(d.sum("coverage.border"), d.sum("lines.A")) << method;
        for (int y = 0; y < s.size_px; ++y) {
            for (int x = 0; x < s.size_px; ++x) {
                const double level = d.at("lines.A", x, y);
                ASSERT_TRUE(level == 0 || level == 1);
            }
        }
    }
}

TEST(ZBufferLines, WidthVariesWithTheAngle) {
    // One pixel per column or row, so max(|cos|, |sin|) across: .707 at 45 degrees.
    const MinimalScene s = scene_star();
    const MethodDrawing d("edging-plane", s);
    for (std::size_t i = 0; i < s.lines.size(); ++i) {
        const glm::dvec2 middle = 0.5 * (s.lines[i].a + s.lines[i].b);
        double pixels = 0;
        for (int y = static_cast<int>(middle.y) - 8; y <= middle.y + 8; ++y) {
            for (int x = static_cast<int>(middle.x) - 8; x <= middle.x + 8; ++x) pixels += d.has_line(x, y);
        }
        const double angle = glm::radians(static_cast<double>(i));
        EXPECT_NEAR(pixels, 14 * std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle))), 1) << i;
    }
}

TEST(ZBufferLines, WideOnesAreRepeatedAcrossTheMajorAxis) {
    MinimalScene s = scene_sil();
    const double one = MethodDrawing("edging-plane", s).sum("lines.A");
    for (const int width : {2, 3, 5}) {
        s.scene.lines.style.width_px = width;
        EXPECT_NEAR(MethodDrawing("edging-plane", s).sum("lines.A"), width * one, 4 * width * width) << width;
    }
    s.scene.lines.style.width_px = 1.5;
    EXPECT_EQ(MethodDrawing("edging-plane", s).sum("lines.A"), one);
    // An offset of half a pixel's slope does no longer do: the stroke is three pixels wide.
    s = scene_slope(1e-2);
    s.scene.lines.style.width_px = 3;
    s.scene.zbuffer.eps = 0.5 * 1e-2;
    const double stitched = MethodDrawing("offset", s).sum("coverage.polygon");
    s.scene.zbuffer.eps = 1.5 * 1e-2;
    EXPECT_LT(stitched, 0.9 * MethodDrawing("offset", s).sum("coverage.polygon"));
}

TEST(ZBufferLines, StepAndFlatStepAreDrawn) {
    const MinimalScene step = scene_step(), flat = scene_flat();
    for (const std::string_view method : kZBufferMethods) {
        const MethodDrawing d(method, step);
        for (int y = 64; y < 186; ++y) {
            double pixels = 0;
            for (int x = 96; x < 106; ++x) pixels += d.has_line(x, y);
            ASSERT_EQ(pixels, 1) << method << " is one pixel wide";
        }
        const MethodDrawing e(method, flat);
        for (const ScreenSegment& line : flat.lines) EXPECT_EQ(missing_share(e, line), 0) << method;
    }
}

TEST(ZBufferLines, ConcavePolygonsAreFilledAndOutlined) {
    const MinimalScene s = scene_concave();
    for (const std::string_view method : kZBufferMethods) {
        const MethodDrawing d(method, s);
        for (const ScreenSegment& line : s.lines) EXPECT_EQ(missing_share(d, line), 0) << method;
        EXPECT_EQ(d.at("R", 80, 170), 1) << "inside";
        EXPECT_EQ(d.at("A", 170, 80), 0) << "in the notch";
        EXPECT_EQ(d.at("id.polygon", 80, 170), 1);
        EXPECT_EQ(d.at("id.polygon", 170, 80), 0);
        EXPECT_EQ(d.sum("lines.A"), d.sum("coverage.border")) << "no diagonals";
    }
}

TEST(ZBufferLines, NeverWhereSurfacesPassThroughEachOther) {
    const MinimalScene s = scene_intersect();
    for (const std::string_view method : kZBufferMethods) {
        const MethodDrawing d(method, s);
        EXPECT_EQ(drawn_share(d, s.lines[0]), 0) << method;
        EXPECT_EQ(d.sum("coverage.intersection"), 0) << method;
        EXPECT_FALSE(find_method(method)->draws.has(LineClass::intersection));
        EXPECT_FALSE(find_method(method)->draws.has(LineClass::object));
    }
}

TEST(ZBufferLines, GrazingFloorsHaveNoFalseLines) {
    MinimalScene floor = scene_graze();
    floor.scene.lines.classes = kDefaultLineClasses;
    for (const std::string_view method : kZBufferMethods) {
        const MethodDrawing d(method, floor);
        EXPECT_GT(d.sum("coverage.border"), 100) << method;
        for (int y = 33; y < 224; ++y) {
            for (int x = 32; x < 224; ++x) ASSERT_EQ(d.at("lines.A", x, y), 0) << method << x << " " << y;
        }
    }
}

TEST(ZBufferLines, DenseMeshesTurnSolid) {
    const MethodDrawing d("edging-plane", scene_dense());
    double inside = 0;
    for (int y = 40; y < 200; ++y) {
        for (int x = 40; x < 200; ++x) inside += d.at("lines.A", x, y);
    }
    // Two thirds of all rows, two thirds of all columns.
    EXPECT_NEAR(inside / (160 * 160), 1 - 1.0 / 9, 0.01);
}

TEST(ZBufferLines, CutAtTheNearPlane) {
    for (const int behind : {0, 1, 2}) {
        const MinimalScene s = scene_near(behind);
        for (const std::string_view method : kZBufferMethods) {
            const MethodDrawing d(method, s);
            EXPECT_GT(d.sum("lines.A"), 20) << method << behind;
            EXPECT_GT(d.sum("id.polygon"), 100) << method << behind;
        }
    }
}

TEST(ZBufferLines, HiddenOnesOfStackedSquaresAreHidden) {
    const MinimalScene s = scene_three_layers();
    const double outlines = 4 * 60 + 4 * 120 + 4 * 180;
    for (const std::string_view method : kZBufferMethods) {
        EXPECT_NEAR(MethodDrawing(method, s).sum("lines.A"), outlines, 6) << method;
    }
}

TEST(SharedEdge, DrawnInOneDirectionIsClean) {
    for (const std::string_view method : {"decal", "edging-plane", "virgin-plane", "stencil"}) {
        for (const bool same : {true, false}) {
            for (const double b : {4e-3, -4e-3}) {
                const MinimalScene s = scene_pair(same, b);
                const MethodDrawing d(method, s);
                // Ties go to the row ahead, which is the one that pixels_along() names.
                EXPECT_EQ(missing_share(d, s.lines[0]), 0) << method << same << b;
                EXPECT_EQ(share_along(s.lines[0], [&](int x, int y) { return d.has_line(x, y - 1); }), 0);
            }
        }
    }
}

TEST(SharedEdge, DrawnInBothDirectionsTakesOtherPixelsAtTies) {
    for (const std::string_view method : {"decal", "edging-plane", "virgin-plane", "stencil"}) {
        const auto above = [&](const MethodDrawing& d) {
            return share_along(scene_pair(true).lines[0], [&](int x, int y) { return d.has_line(x, y - 1); });
        };
        const auto drawn = [&](bool same_direction, double b) {
            MinimalScene s = scene_pair(same_direction, b);
            s.scene.zbuffer.canonical_edges = false;
            return MethodDrawing(method, s);
        };
        // The lower polygon's vector takes the upper row at ties; it shows unless the upper
        // polygon's fill is nearer there.
        EXPECT_NEAR(above(drawn(false, -4e-3)), 0.5, 0.01) << method << ": two pixels wide at ties";
        EXPECT_EQ(above(drawn(false, 4e-3)), 0) << method;
        EXPECT_EQ(above(drawn(true, -4e-3)), 0) << method;
    }
}

TEST(UnedgedNeighbour, DrawnLaterStitchesTheLine) {
    for (const std::string_view method : kZBufferMethods) {
        if (method == "slope-offset") continue;
        // Away from the line on its own side it comes nearer (b < 0) and covers its half of the
        // stroke, or goes behind it and covers nothing.
        MinimalScene nearer = scene_unedged(-1e-2), farther = scene_unedged(1e-2);
        const double missing = measured_missing(method, nearer);
        const double missing_farther = measured_missing(method, farther);
        if (method == "simple" || method == "offset") {
            // They lose the half with the nearer fill anyway, whoever it belongs to.
            const double expected = method == "simple" ? 0.5 : 0.4;
            EXPECT_NEAR(missing, expected, 0.02) << method;
            EXPECT_NEAR(missing_farther, expected, 0.02) << method;
        } else {
            EXPECT_NEAR(missing, 0.5, 0.02) << method;
            EXPECT_EQ(missing_farther, 0) << method;
        }
    }
    // A fill that is pushed away does not reach the line.
    EXPECT_EQ(measured_missing("slope-offset", scene_unedged(-1e-2)), 0);
}

TEST(NarrowPolygonAtTheContour, LosesItsLineToTheNextOne) {
    // The bit protects an edge from its own polygon only. On a smooth surface polygons at the
    // contour may be narrower than half a pixel; then the next one, whose edge is no line, covers
    // the stroke.
    const auto missing = [](std::string_view method, int segments) {
        MinimalScene s;
        s.scene = scene_of({transformed(make_cylinder(60, 60, 200, segments),
                                        [](glm::dvec3 p) { return p + glm::dvec3(128.3, 128.2, 0); })});
        s.scene.lines.classes = LineClass::silhouette;
        s.camera = pixel_camera(256, 256);
        s.camera.to_world[3].y += 1;  // the caps are seen edge-on
        const MethodDrawing d(method, s);
        int rows = 0;
        for (int y = 60; y < 200; ++y) {
            double left = 0;
            for (int x = 60; x < 80; ++x) left += d.at("coverage.silhouette", x, y);
            rows += left == 0;
        }
        return rows / 140.0;
    };
    for (const std::string_view method : kPlaneMethods) {
        EXPECT_EQ(missing(method, 16), 0) << method;
        EXPECT_EQ(missing(method, 400), 1) << method;
    }
    EXPECT_EQ(missing("decal", 400), 1);
    EXPECT_EQ(missing("slope-offset", 400), 0);
}

TEST(ThinWedge, ShowsItsBackWhereDepthIsTooCoarse) {
    for (const std::string_view method : kZBufferMethods) {
        MinimalScene s = scene_back();
        s.scene.zbuffer.eps = 0;
        s.scene.zbuffer.factor = s.scene.zbuffer.units = 0;
        s.scene.zbuffer.depth_bits = 24;
        EXPECT_EQ(MethodDrawing(method, s).sum("lines.A"), 0) << method;
        s.scene.zbuffer.depth_bits = 16;
        const MethodDrawing d(method, s);
        double thin = 0, thick = 0;
        for (int y = 24; y < 236; ++y) {
            for (int x = 30; x < 240; ++x) (x < 80 ? thin : thick) += d.at("lines.A", x, y);
        }
        EXPECT_GT(thin, 200) << method << ": within the smallest step of z";
        EXPECT_EQ(thick, 0) << method;
        // Tilted, it also shows where it is thinner than half a pixel's slope, in any format.
        s = scene_back(1e-3);
        s.scene.zbuffer.depth_bits = 64;
        EXPECT_GT(MethodDrawing(method, s).sum("lines.A"), 200) << method;
    }
}

TEST(Highlight, IsStitchedUnlessZIsThatOfTheLine) {
    for (const std::string_view method : kZBufferMethods) {
        MinimalScene s = scene_hilite();
        s.scene.zbuffer.highlight_classes = LineClassSet::all();
        const MethodDrawing d(method, s);
        const double red = share_along(s.lines[0], [&](int x, int y) { return d.is_red(x, y); });
        const double drawn = drawn_share(d, s.lines[0]);
        if (is_plane_method(method) || method == "slope-offset") {
            EXPECT_EQ(drawn, 1) << method;
            EXPECT_EQ(red, 1) << method;
        } else if (method == "decal") {
            EXPECT_EQ(drawn, 1) << method;
            EXPECT_NEAR(red, 0.5, 0.02) << method << ": the picture is right, its z is not";
        } else if (method == "offset") {
            EXPECT_EQ(red, 1) << "eps is more than half the slope";
        } else {
            EXPECT_NEAR(red, 0.5, 0.02) << method;
            EXPECT_EQ(drawn, red) << method;
        }
    }
    MinimalScene s = scene_hilite();
    s.scene.zbuffer.highlight_classes = LineClass::polygon;
    s.scene.zbuffer.eps = 2.5e-4;  // a quarter of the slope
    const MethodDrawing d("offset", s);
    EXPECT_NEAR(share_along(s.lines[0], [&](int x, int y) { return d.is_red(x, y); }), 0.75, 0.02);
}

TEST(Highlight, SelectsByClassAndByObject) {
    MinimalScene s = scene_hilite();
    s.scene.zbuffer.highlight_classes = LineClass::border;
    s.scene.zbuffer.highlight_color = {0, 0, 1};
    const auto count_blue = [](const MethodDrawing& d) { return d.sum("lines.B"); };
    const MethodDrawing d("stencil", s);
    EXPECT_GT(count_blue(d), 300);
    EXPECT_EQ(share_along(s.lines[0], [&](int x, int y) { return d.at("lines.B", x, y) > 0; }), 0);
    EXPECT_EQ(d.sum("lines.A"), MethodDrawing("stencil", scene_hilite()).sum("lines.A")) << "a highlight is a line";

    s = scene_three_layers();
    s.scene.objects[1].name = "middle";
    s.scene.zbuffer.highlight_objects = {"middle"};
    s.scene.zbuffer.highlight_color = {0, 0, 1};
    EXPECT_NEAR(count_blue(MethodDrawing("stencil", s)), 4 * 120, 3);
}

}  // namespace
}  // namespace burin::zbuffer_artefacts_test
