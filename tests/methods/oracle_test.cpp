// The lines that method patel draws are those that rays find, on real and on built scenes.

#include <gtest/gtest.h>

#include <filesystem>

#include "mesh/shapes.h"
#include "scene/scene_description.h"
#include "tests/support/drawing.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

namespace burin::oracle_test {
namespace {

using namespace test;

void expect_agreement(const Scene& scene, const Camera& camera, int width, int height, const std::string& what) {
    const Drawing drawing(scene, camera, width, height);
    const Oracle oracle(scene, camera, width, height);
    const auto truth = oracle.line_points(0, 0, width, height, 8, scene.lines.crease_angle_deg);
    const LineAgreement agreement = compare_lines(truth, drawing.coverage(), 0, 0, width, height);
    EXPECT_GT(agreement.certain, 500) << what << ": the scene must have lines";
    EXPECT_EQ(agreement.missing, 0) << what << ", first at " << agreement.missing_points[0].x << ","
                                    << agreement.missing_points[0].y;
    EXPECT_EQ(agreement.false_mass, 0) << what << ", first at " << agreement.false_pixels[0].x << ","
                                       << agreement.false_pixels[0].y;
}

Camera fitted(const Scene& scene, glm::dvec3 direction, double aspect) {
    CameraSettings settings;
    settings.direction = direction;
    return resolve_camera(settings, scene_points(scene), aspect);
}

const glm::dvec3 kDirections[] = {{0.55, 0.4, 0.9}, {-1, 0.1, 0.2}, {0.5, -0.8, -0.4}};

TEST(Oracle, Teapot) {
    const Scene scene = scene_of({make_teapot(10)});
    for (const glm::dvec3& d : kDirections) expect_agreement(scene, fitted(scene, d, 1.6), 240, 150, "teapot");
}

TEST(Oracle, CreasedPart) {
    // A flange: chamfered cone on a disc, a box through it, a torus as a bead.
    std::vector<PolygonSoup> parts;
    parts.push_back(make_cylinder(1, 1, 0.3, 48));
    parts.push_back(
        transformed(make_cylinder(0.6, 0.45, 0.8, 48), [](glm::dvec3 p) { return p + glm::dvec3(0, 0.5, 0); }));
    parts.push_back(transformed(make_box({2.4, 0.2, 0.3}), [](glm::dvec3 p) { return p + glm::dvec3(0, 0.45, 0); }));
    parts.push_back(
        transformed(make_torus(0.6, 0.08, 48, 16), [](glm::dvec3 p) { return p + glm::dvec3(0, 0.15, 0); }));
    const Scene scene = scene_of(parts);
    for (const glm::dvec3& d : kDirections) expect_agreement(scene, fitted(scene, d, 1.6), 240, 150, "part");
}

TEST(Oracle, CrossingSheets) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        Random random(seed);
        std::vector<PolygonSoup> sheets;
        PolygonSoup one_object;
        for (int i = 0; i < 6; ++i) {
            const glm::dvec3 u = random.direction(), v = glm::normalize(glm::cross(u, random.direction()));
            const glm::dvec3 c = random.in_box(0.2);
            const PolygonSoup sheet = soup_of({c - u - v, c + u - v, c + u + v, c - u + v}, {{0, 1, 2, 3}});
            if (seed % 2 == 0) {
                sheets.push_back(sheet);
                continue;
            }
            std::vector<std::uint32_t> corners;
            for (const glm::dvec3& p : sheet.positions) {
                corners.push_back(static_cast<std::uint32_t>(one_object.positions.size()));
                one_object.positions.push_back(p);
            }
            one_object.add_polygon(corners);
        }
        if (seed % 2 == 1) sheets.push_back(one_object);
        const Scene scene = scene_of(sheets);
        expect_agreement(scene, fitted(scene, {0.3, 0.5, 1}, 1.6), 240, 150, "sheets " + std::to_string(seed));
    }
}

TEST(Oracle, Engine) {
    // The CAD assembly that scripts/demo draws: thousands of unstitched patches.
    ASSERT_TRUE(std::filesystem::exists(BURIN_ENGINE))
        << "install assimp-testmodels (scripts/install-dependencies does)";
    const Scene scene = load_scene(bare_model_scene(BURIN_ENGINE, {}));
    for (const glm::dvec3& d : kDirections) expect_agreement(scene, fitted(scene, d, 1.6), 256, 160, "engine");
}

TEST(Oracle, EngineByItsOwnCamera) {
    const Scene scene = load_scene(bare_model_scene(BURIN_ENGINE, {}));
    const Camera own = resolve_camera(scene.cameras.front(), scene_points(scene), 1.6);
    expect_agreement(scene, own, 256, 160, "engine, its own camera");
}

TEST(Oracle, NoticesAMissingClass) {
    // The oracle itself must be able to fail.
    Scene scene = scene_of({make_box({1, 1, 1})});
    const Camera camera = fitted(scene, kDirections[0], 1.6);
    const auto truth = Oracle(scene, camera, 160, 100).line_points(0, 0, 160, 100, 8, 40);
    const auto check = [&](LineClassSet classes) {
        scene.lines.classes = classes;
        return compare_lines(truth, Drawing(scene, camera, 160, 100).coverage(), 0, 0, 160, 100);
    };
    EXPECT_GT(check(LineClass::silhouette).missing, 100);
    EXPECT_GT(check(LineClass::crease | LineClass::border).missing + 1, 0);
    scene = scene_of({make_sphere(0.6, 24, 12)});
    EXPECT_GT(check(LineClass::polygon).false_mass, 50);
}

}  // namespace
}  // namespace burin::oracle_test
