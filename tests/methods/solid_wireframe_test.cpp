// NVIDIA's solid wireframe: corners behind the eye, its profile, and dotted diagonals.

#include <gtest/gtest.h>

#include "methods/wire/wire_profile.h"
#include "tests/methods/wire_checks.h"

namespace burin::solid_wireframe_test {
namespace {

using namespace test;

/// Edges of S-NEAR as far as they lie before the eye, on the screen.
std::vector<ScreenSegment> visible_edges(const MinimalScene& s) {
    const Camera& camera = s.camera;
    const Projection projection = camera.projection(s.size_px, s.size_px, 0);
    const glm::dmat4 to_view = camera.to_view();
    const Mesh& mesh = s.scene.meshes[0];
    std::vector<ScreenSegment> edges;
    for (std::uint32_t k = 0; k < 3; ++k) {
        glm::dvec3 a(to_view * glm::dvec4(mesh.position(mesh.triangles[0][k]), 1));
        glm::dvec3 b(to_view * glm::dvec4(mesh.position(mesh.triangles[0][(k + 1) % 3]), 1));
        if (a.z > b.z) std::swap(a, b);
        if (a.z >= 0) continue;
        if (b.z > -1e-4) b = a + (b - a) * ((-1e-4 - a.z) / (b.z - a.z));
        edges.push_back({projection.to_pixel(a), projection.to_pixel(b)});
    }
    return edges;
}

TEST(SolidWireframe, CornersBehindTheEyeAreNoTrouble) {
    for (const int behind : {1, 2}) {
        const MinimalScene s = scene_near(behind);
        const std::vector<ScreenSegment> edges = visible_edges(s);
        const WireProfile profile = matched_profile(WireProfileKind::nv, 1);
        MinimalScene lines = s;
        lines.scene.wire.path = WirePath::homogeneous;
        const Drawing cases = draw(s, render_solid_wireframe), homogeneous = draw(lines, render_solid_wireframe);
        int drawn = 0;
        for (int y = 0; y < 256; ++y) {
            for (int x = 0; x < 256; ++x) {
                if (cases.at("id.object", x, y) == 0) continue;
                const double truth = profile.intensity(distance_to(edges, {x + 0.5, y + 0.5}));
                EXPECT_NEAR(cases.line(x, y), truth, 0.02) << behind << ": " << x << "," << y;
                EXPECT_NEAR(homogeneous.line(x, y), truth, 0.02) << behind << ": " << x << "," << y;
                drawn += truth > 0.5;
            }
        }
        EXPECT_GT(drawn, 30);
    }
}

TEST(SolidWireframe, ACornerInTheEyesPlaneNeedsHomogeneousLines) {
    MinimalScene s = scene_near(0);
    const std::vector<ScreenSegment> edges = visible_edges(s);
    ASSERT_EQ(edges.size(), 3u);
    const Drawing cases = draw(s, render_solid_wireframe);
    s.scene.wire.path = WirePath::homogeneous;
    const Drawing homogeneous = draw(s, render_solid_wireframe);
    const WireProfile profile = matched_profile(WireProfileKind::nv, 1);
    int missing = 0;
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            if (cases.at("id.object", x, y) == 0) continue;
            const double truth = profile.intensity(distance_to(edges, {x + 0.5, y + 0.5}));
            EXPECT_NEAR(homogeneous.line(x, y), truth, 0.02);
            EXPECT_LE(cases.line(x, y), truth + 0.02);
            missing += cases.line(x, y) < truth - 0.5;
        }
    }
    EXPECT_GT(missing, 20);
}

TEST(SolidWireframe, PublishedLinesAreOnePixelWideAndLeaveAStepAtSilhouettes) {
    const MinimalScene slope = as_published(scene_slope(0));
    EXPECT_NEAR(integrated_width(draw(slope, render_solid_wireframe), slope.lines[0].a, slope.lines[0].b), 1.0182,
                0.005);
    const MinimalScene sil = as_published(scene_sil());
    const Drawing d = draw(sil, render_solid_wireframe);
    for (const ScreenSegment& line : sil.lines) EXPECT_NEAR(integrated_width(d, line.a, line.b), 1.0182 / 2, 0.01);
    // W = 1.5 is not black anywhere: the fill shows through by .083.
    EXPECT_NEAR(darkest(draw(slope, render_solid_wireframe), [](glm::dvec2) { return true; }), 1 - 0.083, 5e-3);
}

TEST(SolidWireframe, DiagonalsAreHiddenOrDotted) {
    // A square, mirrored in both of its diagonals to the bit.
    MinimalScene s = scene_from(
        {soup_of({at_pixel(64, 64, 0.5), at_pixel(192, 64, 0.5), at_pixel(192, 192, 0.5), at_pixel(64, 192, 0.5)},
                 {{3, 2, 1, 0}})});
    s.scene.lines.style.width_px = 2;
    const auto inner = [](glm::dvec2 p) { return p.x > 72 && p.x < 184 && p.y > 72 && p.y < 184; };
    EXPECT_EQ(darkest(draw(s, render_solid_wireframe), inner), 0);
    s.scene.wire.dotted_diagonals = true;
    const Drawing d = draw(s, render_solid_wireframe);
    EXPECT_GT(darkest(d, inner), 0.95);
    // The dots of the two triangles are the same dots.
    const bool is_main = d.line(128, 128) + d.line(127, 127) + d.line(126, 126) + d.line(125, 125) >
                         d.line(128, 127) + d.line(127, 128) + d.line(126, 129) + d.line(125, 130);
    double jump = 0;
    int dark = 0, light = 0;
    for (int y = 72; y < 184; ++y) {
        for (int x = 72; x < 184; ++x) {
            jump = std::max(jump, std::abs(d.line(x, y) - (is_main ? d.line(y, x) : d.line(255 - y, 255 - x))));
        }
        const double on_diagonal = is_main ? d.line(y, y) : d.line(255 - y, y);
        dark += on_diagonal > 0.5;
        light += on_diagonal < 0.5;
    }
    EXPECT_LT(jump, 0.02);
    EXPECT_GT(dark, 30);
    EXPECT_GT(light, 20);
    // Diagonals are lines of class polygon, for those who ask for it.
    EXPECT_EQ(darkest(draw(with_classes(s, LineClass::border), render_solid_wireframe), inner), 0);
    // Near the square's corners its own edges win.
    EXPECT_NEAR(d.line(is_main ? 65 : 190, 65), matched_profile(WireProfileKind::nv, 2).intensity(1.5), 0.01);
}

}  // namespace
}  // namespace burin::solid_wireframe_test
