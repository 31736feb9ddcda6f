#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "mesh/shapes.h"
#include "tests/support/layers.h"
#include "tests/support/random.h"

namespace burin::transparency_test {
namespace {

using namespace test;

TEST(Transparency, LinesBehindGlassAreWeakened) {
    // A pane in front of the lower half of a box's face.
    Scene scene = scene_of({soup_of({{20, 20, 100}, {220, 20, 100}, {220, 120, 100}, {20, 120, 100}}, {{0, 1, 2, 3}}),
                            moved(make_box({100, 100, 20}), {120, 120, 0})});
    const Image opaque = draw(scene, pixel_camera(kSize, kSize));
    scene.materials[0].opacity = 0.25f;
    const Image glass = draw(scene, pixel_camera(kSize, kSize));
    // The box's left side at x = 70: seen above the pane, weakened behind it.
    const auto across = [](const Image& image, int y) {
        double ink = 0;
        for (int x = 66; x < 74; ++x) ink += value(image, "lines.A", x, y);
        return ink;
    };
    EXPECT_NEAR(across(opaque, 90), 1, 0.02);
    EXPECT_NEAR(across(opaque, 150), 0, 0.001);
    EXPECT_NEAR(across(glass, 90), 1, 0.02);
    EXPECT_NEAR(across(glass, 150), 0.75, 0.02);
    double by_class = 0;
    for (int x = 66; x < 74; ++x)
        by_class += value(glass, "coverage.silhouette", x, 150) + value(glass, "coverage.crease", x, 150);
    EXPECT_NEAR(by_class, across(glass, 150), 0.01);
    EXPECT_NEAR(across(glass, 200), 0, 0.001) << "nothing is behind the pane there";
}

// Dashes depend on the mesh, in front of the picture's border and behind glass.
TEST(Transparency, DashesRunOnBehindGlass) {
    PolygonSoup fold;  // a crease in waves, from far beside the picture
    constexpr std::uint32_t kPoints = 60;
    for (std::uint32_t i = 0; i < kPoints; ++i) {
        const double x = -130.7 + 8.1 * i, y = 120 + 20 * std::sin(0.05 * x);
        fold.positions.insert(fold.positions.end(), {{x, y, 0}, {x, y - 60, -60}, {x, y + 60, -60}});
    }
    for (std::uint32_t i = 0; i + 1 < kPoints; ++i) {
        fold.add_polygon(std::vector<std::uint32_t>{3 * i, 3 * i + 1, 3 * i + 4, 3 * i + 3});
        fold.add_polygon(std::vector<std::uint32_t>{3 * i, 3 * i + 3, 3 * i + 5, 3 * i + 2});
    }
    Scene scene = scene_of(
        {fold, soup_of({{60.3, 20, 100}, {170.8, 20, 100}, {170.8, 220, 100}, {60.3, 220, 100}}, {{0, 1, 2, 3}})});
    scene.lines.classes = LineClass::crease;
    scene.lines.style.dash_px = {12, 10};
    scene.materials.push_back({});
    scene.objects[1].materials = {1};
    const SceneObject glass = scene.objects[1];
    scene.objects[1].materials = {0};
    scene.objects[1].to_world = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 1000, 0));
    const Image without = draw(scene, pixel_camera(kSize, kSize));
    EXPECT_GT(sum(without, "lines.A"), 100);
    scene.objects[1] = glass;
    for (const float opacity : {0.02f, 0.0f}) {  // what is quite clear is no wall either
        scene.materials[1].opacity = opacity;
        const Image behind = draw(scene, pixel_camera(kSize, kSize));
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x)
                ASSERT_NEAR(value(behind, "lines.A", x, y), value(without, "lines.A", x, y), 0.1) << x << ' ' << y;
        }
    }
}

TEST(Transparency, SurfacesAreCompositedInOrder) {
    const auto square = [](double low, double high, double z) {
        return soup_of({{low, low, z}, {high, low, z}, {high, high, z}, {low, high, z}}, {{0, 1, 2, 3}});
    };
    Scene scene = scene_of({square(20, 220, 0), square(60, 180, 50), square(100, 140, 100)});
    scene.lines.classes = LineClassSet();
    scene.surfaces.shading = SurfaceShading::lambert;
    scene.materials[0].color = {1, 0, 0};
    scene.materials[1].color = {0, 1, 0};
    scene.materials[2].color = {0, 0, 1};
    scene.materials[1].opacity = 0.5f;
    scene.materials[2].opacity = 0.25f;
    const Image image = draw(scene, pixel_camera(kSize, kSize));
    const auto expect = [&](int at, glm::dvec4 color) {
        const char* const names[] = {"R", "G", "B", "A"};
        for (int c = 0; c < 4; ++c) {
            EXPECT_NEAR(value(image, names[c], at, at), color[c], 2e-3) << at << names[c];
            EXPECT_NEAR(value(image, std::string("surface.") + names[c], at, at), color[c], 2e-3);
        }
    };
    expect(30, {1, 0, 0, 1});
    expect(80, {0.5, 0.5, 0, 1});
    expect(120, {0.375, 0.375, 0.25, 1});
    scene.materials[0].opacity = 0.5f;
    const Image all_glass = draw(scene, pixel_camera(kSize, kSize));
    EXPECT_NEAR(value(all_glass, "A", 80, 80), 0.75, 2e-3);
    EXPECT_NEAR(value(all_glass, "R", 80, 80), 0.25, 2e-3);
    EXPECT_EQ(value(all_glass, "id.object", 120, 120), 3) << "numbers are those of the nearest surface";
}

// The first of the faces in one plane is seen (decision 9), also if it is of glass: rounding does not tell at each
// sample anew.
TEST(Transparency, GlassFlushWithASolidHasOneColour) {
    const PolygonSoup inlay = transformed(make_box({1.4, 0.1, 1.4}), [](glm::dvec3 p) {
        return glm::dvec3(std::cos(0.35) * p.x - std::sin(0.35) * p.z, p.y + 0.05,
                          std::sin(0.35) * p.x + std::cos(0.35) * p.z);
    });
    const PolygonSoup board = make_box({4, 0.2, 3});
    for (const bool is_glass_first : {true, false}) {
        Scene scene = is_glass_first ? scene_of({inlay, board}) : scene_of({board, inlay});
        Material& glass = scene.materials[is_glass_first ? 0 : 1];
        scene.lines.classes = LineClassSet();
        scene.surfaces.shading = SurfaceShading::lambert;
        scene.materials[0].color = scene.materials[1].color = {1, 0, 0};
        glass.color = {0, 0, 1};
        glass.opacity = 0.25f;
        for (int k = 0; k < 12; ++k) {
            const Camera camera = ortho_camera({4.1 + 0.13 * k, 3.1 + 0.1 * k, 6.3 - 0.17 * k}, 5);
            const Image image = draw(scene, camera);
            const Frame frame = make_frame(scene, camera, kSize, kSize, {0, 0, kSize, kSize});
            const glm::dvec2 first = pixel_of(frame, camera, {0, 0.1, 0});
            const auto color = [&](glm::dvec2 at) {
                return value(image, "surface.B", static_cast<int>(at.x), static_cast<int>(at.y));
            };
            EXPECT_EQ(color(first) > 0.01, is_glass_first) << k;
            for (const double x : {-0.5, -0.21, 0.13, 0.45}) {
                for (const double z : {-0.44, -0.1, 0.28, 0.5})
                    EXPECT_NEAR(color(pixel_of(frame, camera, {x, 0.1, z})), color(first), 1e-3) << k;
            }
        }
    }
}

TEST(Transparency, GlassDoesNotCountAsALayer) {
    const auto wall = [](double z) {
        return soup_of({{20, 20, z}, {220, 20, z}, {220, 220, z}, {20, 220, z}}, {{0, 1, 2, 3}});
    };
    Scene scene = scene_of({moved(make_box({100, 100, 20}), {120, 120, 0}), wall(50), wall(60), wall(70)});
    scene.materials[2].opacity = 0.5f;
    const Layers layers(scene, pixel_camera(kSize, kSize));
    EXPECT_GT(layers.hidden_px(2), 300);
    EXPECT_EQ(layers.hidden_px(3) + layers.hidden_px(4), layers.hidden_px(3))
        << "only the box's rear face is behind its front";
    for (const LinePart& p : layers.pass.parts()) {
        if (layers.pass.lines()[p.line].owners[0] < 12) {
            EXPECT_EQ(p.transmission, 128);
        }
    }
}

}  // namespace
}  // namespace burin::transparency_test
