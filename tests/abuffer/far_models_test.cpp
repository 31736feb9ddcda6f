// Small things in large scenes: far from the origin, far from each other, on a huge ground. The
// picture is that of the same things alone, near the origin.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "tests/support/drawing.h"
#include "tests/support/joined_soups.h"

namespace burin::far_models_test {
namespace {

using namespace test;

constexpr int kSize = 200;
/// Sums with multiples of 1/1024 are exact in double precision.
constexpr glm::dvec3 kFar(500000.25, 12.5, 4600000.75);

PolygonSoup at(PolygonSoup soup, const glm::dvec3& place) {
    return transformed(std::move(soup), [&](glm::dvec3 p) { return glm::round(p * 1024.0) / 1024.0 + place; });
}

/// Each as an object of one file.
PolygonSoup side_by_side(const std::vector<PolygonSoup>& soups) {
    PolygonSoup all = joined(soups);
    for (std::uint32_t i = 0; i < soups.size(); ++i) {
        all.object_names.push_back(std::string(1, static_cast<char>('a' + i)));
        all.polygon_object.insert(all.polygon_object.end(), soups[i].polygon_count(), i);
    }
    return all;
}

std::vector<PolygonSoup> parts_at(const glm::dvec3& place) {
    return {at(make_box({0.5, 0.41, 0.3}), place),
            at(make_cylinder(0.12, 0.12, 0.4, 24), place + glm::dvec3(0, 0.25, 0)),
            at(make_sphere(0.2, 20, 10), place + glm::dvec3(0.375, 0, 0.125))};
}

Camera camera_at(const glm::dvec3& place) {
    return perspective_camera(place + glm::dvec3(1.5, 1.25, 2.0), place + glm::dvec3(0.125, 0.0625, 0), 28);
}

Drawing drawing_of(Scene scene, const Camera& camera, HiddenStyle hidden = HiddenStyle::solid) {
    scene.lines.style.hidden.style = hidden;
    return Drawing(scene, camera, kSize, kSize, {0, 0, kSize, kSize}, 2, render_abuffer);
}

/// Rounding may move a corner to the next 1/256 pixel.
void expect_alike(
    const Drawing& a, const Drawing& b, const std::string& what,
    const std::function<bool(int, int)>& counts = [](int, int) { return true; }) {
    double ink = 0, difference = 0, largest = 0;
    glm::ivec2 at(0);
    for (const char* const channel : {"lines.A", "lines_hidden.A"}) {
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                if (!counts(x, y)) continue;
                const double d = std::abs(a.at(channel, x, y) - b.at(channel, x, y));
                ink += a.at(channel, x, y);
                difference += d;
                if (d > largest) at = {x, y};
                largest = std::max(largest, d);
            }
        }
    }
    EXPECT_GT(ink, 300) << what;
    EXPECT_LT(difference, 1e-3 * ink) << what;
    EXPECT_LT(largest, 0.05) << what << " at " << at.x << "," << at.y;
}

Drawing parts_alone() {
    return drawing_of(scene_of({side_by_side(parts_at(glm::dvec3(0.0)))}), camera_at(glm::dvec3(0.0)));
}

TEST(FarModels, AreWhatTheyAreBesideAMarkerAtTheOrigin) {
    const Drawing expected = parts_alone();
    std::vector<PolygonSoup> parts = parts_at(kFar);
    for (const PolygonSoup& marker : {make_box({1, 1, 1}), make_sphere(0.5, 64, 32)}) {
        std::vector<PolygonSoup> all = parts;
        all.insert(all.begin(), marker);
        expect_alike(expected, drawing_of(scene_of({side_by_side(all)}), camera_at(kFar)), "in one file");
        all.assign({marker, side_by_side(parts)});
        expect_alike(expected, drawing_of(scene_of(all), camera_at(kFar)), "in two files");
    }
}

TEST(FarModels, AreWhatTheyAreInOneObjectWithOthersFarAway) {
    const Drawing expected = drawing_of(scene_of({joined(parts_at(glm::dvec3(0.0)))}), camera_at(glm::dvec3(0.0)));
    std::vector<PolygonSoup> both = parts_at(kFar);
    for (const PolygonSoup& part : parts_at(-kFar)) both.push_back(part);
    const Scene scene = scene_of({joined(both)});
    expect_alike(expected, drawing_of(scene, camera_at(kFar)), "here");
    expect_alike(expected, drawing_of(scene, camera_at(-kFar)), "there");
    // Whichever has more corners.
    std::vector<PolygonSoup> all = parts_at(kFar);
    all.push_back(make_sphere(0.5, 64, 32));
    expect_alike(expected, drawing_of(scene_of({joined(all)}), camera_at(kFar)), "beside a marker");
}

TEST(FarModels, OfAMeshAreWhereTheirTransformsPutThem) {
    Scene scene = scene_of({side_by_side(parts_at(glm::dvec3(0.0)))});
    const Drawing expected = drawing_of(scene, camera_at(glm::dvec3(0.0)));
    const std::vector<SceneObject> objects = scene.objects;
    scene.objects.clear();
    for (const glm::dvec3& place : {kFar, glm::dvec3(0.0), -3.0 * kFar}) {
        for (SceneObject object : objects) {
            object.to_world[3] = glm::dvec4(place, 1);
            scene.objects.push_back(object);
        }
    }
    expect_alike(expected, drawing_of(scene, camera_at(kFar)), "far");
    expect_alike(expected, drawing_of(scene, camera_at(glm::dvec3(0.0))), "at the origin");
    expect_alike(expected, drawing_of(scene, camera_at(-3.0 * kFar)), "farther");
}

/// The ground as a scene has it: a plane of this size, at `height`, not centred.
PolygonSoup ground(double size, double height) {
    return transformed(make_plane(size, size, 1, 1),
                       [&](glm::dvec3 p) { return p + glm::dvec3(0.1 * size, height, 0.05 * size); });
}

TEST(FarModels, StandOnAGroundOfAnySize) {
    const double foot = -0.205078125;  // of the box, in 1/1024
    const auto draw = [&](double size, bool is_one_file, bool is_one_object) {
        std::vector<PolygonSoup> all = parts_at(glm::dvec3(0.0));
        all.push_back(ground(size, foot));
        if (is_one_object) return drawing_of(scene_of({joined(all)}), camera_at(glm::dvec3(0.0)));
        return drawing_of(scene_of(is_one_file ? std::vector{side_by_side(all)} : all), camera_at(glm::dvec3(0.0)));
    };
    for (const bool is_one_object : {false, true}) {
        const Drawing expected = draw(64, true, is_one_object);
        const auto below_horizon = [](int, int y) { return y > 30; };
        for (const double size : {1e4, 1e6, 1e7}) {
            expect_alike(expected, draw(size, true, is_one_object), "ground of " + std::to_string(size), below_horizon);
            if (!is_one_object)
                expect_alike(expected, draw(size, false, false),
                             "in a file of its own, ground of " + std::to_string(size), below_horizon);
        }
    }
}

TEST(FarModels, StandOnAGroundThatIsTilted) {
    const glm::dmat3 turn{glm::dvec3(0.6, 0.64, -0.48), glm::dvec3(-0.8, 0.48, -0.36), glm::dvec3(0, 0.6, 0.8)};
    const double foot = -0.205078125;
    const auto scene = [&](double size, bool is_turned) {
        std::vector<PolygonSoup> all = parts_at(glm::dvec3(0.0));
        all.push_back(ground(size, foot));
        PolygonSoup soup = side_by_side(all);
        return scene_of({is_turned ? transformed(soup, [&](glm::dvec3 p) { return turn * p; }) : soup});
    };
    Camera camera = camera_at(glm::dvec3(0.0));
    const Drawing expected = drawing_of(scene(64, false), camera);
    camera.to_world = glm::dmat4(turn) * camera.to_world;
    expect_alike(expected, drawing_of(scene(1e7, true), camera), "turned", [](int, int y) { return y > 30; });
}

TEST(FarModels, InOrthographicViewsDoNotFlattenWhatIsInFrontOfThem) {
    Camera camera = camera_at(glm::dvec3(0.0));
    camera.orthographic = true;
    camera.height = 1.5;
    const Drawing expected = drawing_of(scene_of({side_by_side(parts_at(glm::dvec3(0.0)))}), camera);
    // Farther behind, beside the picture.
    const glm::dvec3 behind = -4e6 * glm::dvec3(camera.to_world[2]) + 3e5 * glm::dvec3(camera.to_world[0]);
    std::vector<PolygonSoup> all = parts_at(glm::dvec3(0.0));
    all.push_back(at(make_box({1, 1, 1}), behind));
    expect_alike(expected, drawing_of(scene_of({side_by_side(all)}), camera), "orthographic");
}

TEST(FarModels, TheEyeMayBeCloseToAHugeSurface) {
    // A floor seen from 1/1000 above it: nothing near is cut away.
    const Scene scene = scene_of({ground(1e7, 0)});
    const Camera camera = perspective_camera({0, 0.001, 0}, {0, 0.001 - 0.1, -1}, 40);
    const Drawing drawing = drawing_of(scene, camera);
    for (int x = 0; x < kSize; ++x) {
        EXPECT_EQ(drawing.at("id.object", x, kSize - 1), 1);
        EXPECT_NEAR(drawing.at("Z", x, kSize - 1), 0.001 / (0.1 + std::tan(20 * 3.14159 / 180)), 0.0003);
    }
}

}  // namespace
}  // namespace burin::far_models_test
