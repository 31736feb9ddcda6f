// Pixels that are not square.

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "methods/method_table.h"
#include "scene/camera.h"
#include "tests/support/drawing.h"
#include "tests/support/joined_soups.h"

namespace burin::test::pixel_aspect_test {
namespace {

constexpr int kWidth = 60, kHeight = 50;

/// A turned box, a sphere that runs into it, and an open sheet that reaches behind the eye.
Scene make_scene() {
    const auto turned = [](glm::dvec3 p) {
        return glm::dvec3(0.8 * p.x + 0.6 * p.z, 0.96 * p.y - 0.28 * (0.8 * p.z - 0.6 * p.x),
                          0.28 * p.y + 0.96 * (0.8 * p.z - 0.6 * p.x));
    };
    const PolygonSoup sheet = soup_of({{-3, -1.3, -4}, {3, -1.3, -4}, {3, -1.2, 9}, {-3, -1.2, 9}}, {{0, 1, 2, 3}});
    Scene scene = scene_of(
        {transformed(make_box({1.3, 1.1, 0.9}), turned),
         transformed(make_sphere(0.6, 12, 8), [](glm::dvec3 p) { return p + glm::dvec3(0.7, 0.4, 0.2); }), sheet});
    scene.lines.classes = LineClassSet::all();
    return scene;
}

CameraSettings settings_from(const glm::dvec3& eye) {
    CameraSettings settings;
    settings.eye = eye;
    settings.target = eye - glm::dvec3(0, 0, 1);
    settings.shift = {0.05, -0.025};
    return settings;
}
Camera camera_of(CameraSettings settings, bool orthographic, double pixel_aspect) {
    settings.orthographic = orthographic;
    if (orthographic) settings.height = 3;
    settings.pixel_aspect = pixel_aspect;
    return resolve_camera(
        settings, [](const auto&) {}, static_cast<double>(kWidth) / kHeight);
}

/// Where a picture with square pixels has the same lines: of a scene that is narrower as seen from the camera, which
/// looks along -z. The factor is a power of two, so that no bit differs.
Scene narrowed(Scene scene, double pixel_aspect) {
    glm::dmat4 narrow(1.0);
    narrow[0][0] = 1 / pixel_aspect;
    for (SceneObject& object : scene.objects) object.to_world = narrow * object.to_world;
    return scene;
}

Drawing drawn(const Scene& scene, const Camera& camera, RenderFunction render) {
    return {scene, camera, kWidth, kHeight, {0, 0, kWidth, kHeight}, 2, render};
}

const std::set<std::string_view> kFight = {"simple",       "slope-offset", "decal",
                                           "edging-plane", "virgin-plane", "stencil"};

TEST(PixelAspect, EachMethodSeesWhatANarrowerSceneShows) {
    for (const Method& method : methods()) {
        for (const double aspect : {2.0, 0.5}) {
            for (const bool orthographic : {false, true}) {
                SCOPED_TRACE(std::string(method.name) + (orthographic ? ", orthographic, " : ", ") +
                             std::to_string(aspect));
                Scene scene = make_scene();
                scene.lines.classes = scene.lines.classes & method.draws;
                scene.lines.style.hidden.style = HiddenStyle::none;
                CameraSettings settings = settings_from({0, 0.3, 5});
                const Drawing own = drawn(scene, camera_of(settings, orthographic, aspect), method.render);
                settings.shift.x /= aspect;
                const Drawing other =
                    drawn(narrowed(scene, aspect), camera_of(settings, orthographic, 1), method.render);
                double ink = 0, difference = 0;
                int other_ids = 0;
                for (int y = 0; y < kHeight; ++y) {
                    for (int x = 0; x < kWidth; ++x) {
                        ink += own.line(x, y);
                        difference += std::abs(own.line(x, y) - other.line(x, y));
                        other_ids += own.at("id.object", x, y) != other.at("id.object", x, y) ? 1 : 0;
                        if (own.at("id.object", x, y) == 0) continue;
                        ASSERT_NEAR(own.at("Z", x, y), other.at("Z", x, y), 1e-5) << x << ' ' << y;
                    }
                }
                EXPECT_GT(ink, 60);
                // Depths that are compared are rounded in another way. Where lines fight with surfaces for them, more
                // than a few pixels differ.
                EXPECT_LE(difference, (kFight.contains(method.name) ? 0.1 : 0.005) * ink);
                EXPECT_EQ(other_ids, 0);
            }
        }
    }
}

/// A method of surfaces: normals and light are those of the scene, not of its narrower picture.
TEST(PixelAspect, SurfacesAreLitAsTheyAre) {
    const Scene scene = make_scene();
    const CameraSettings settings = settings_from({0, 0, 5});
    const Drawing square = drawn(scene, camera_of(settings, false, 1), render_abuffer);
    const Drawing wide = drawn(scene, camera_of(settings, false, 3), render_abuffer);
    const auto is_within_polygon = [](const Drawing& drawing, int x, int y) {
        const double id = drawing.at("id.polygon", x, y);
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                if (drawing.at("id.polygon", x + dx, y + dy) != id) return false;
            }
        }
        return id != 0;
    };
    int compared = 0;
    for (int y = 1; y + 1 < kHeight; ++y) {
        for (int x = 1; x + 1 < kWidth; ++x) {
            const int x_square = 3 * x + 1 - kWidth;  // the middle of a pixel is that of three square ones
            if (x_square < 1 || x_square + 1 >= kWidth) continue;
            if (!is_within_polygon(wide, x, y) || !is_within_polygon(square, x_square, y)) continue;
            if (wide.at("id.polygon", x, y) != square.at("id.polygon", x_square, y)) continue;
            ++compared;
            for (const char* const channel : {"N.X", "N.Y", "N.Z", "Z"}) {
                ASSERT_NEAR(wide.at(channel, x, y), square.at(channel, x_square, y), 2e-3)
                    << channel << ' ' << x << ' ' << y;
            }
        }
    }
    EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace burin::test::pixel_aspect_test
