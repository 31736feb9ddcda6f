#include "methods/patel/explain.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"
#include "tests/support/drawing.h"

namespace burin::explain_test {
namespace {

using namespace test;

std::string explain(const Scene& scene, const Camera& camera, int size, int x, int y) {
    const Frame frame = make_frame(scene, camera, size, size, {0, 0, size, size});
    return explain_pixel(frame, x, y);
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Explain, ShowsMasksOwnersAndTheTestThatDrewTheLine) {
    // A sheet from x = 50.5 to the right, in front of a larger one.
    PolygonSoup front = soup_of({{50.5, 10, 5}, {90, 10, 5}, {90, 90, 5}, {50.5, 90, 5}}, {{0, 1, 2, 3}});
    PolygonSoup rear = soup_of({{5, 5, -5}, {95, 5, -5}, {95, 95, -5}, {5, 95, -5}}, {{0, 1, 2, 3}});
    front.object_names = {"front"};
    rear.object_names = {"rear"};
    const Scene scene = scene_of({front, rear});
    const std::string text = explain(scene, pixel_camera(100, 100), 100, 50, 50);
    EXPECT_TRUE(contains(text, "fragment 1: object 1 \"front\"")) << text;
    EXPECT_TRUE(contains(text, "object 2 \"rear\"")) << text;
    EXPECT_TRUE(contains(text, "....####")) << "the mask of a border in the middle of the pixel\n" << text;
    EXPECT_TRUE(contains(text, "the front surface ends at a border")) << text;
    EXPECT_TRUE(contains(text, "10 pixel widths farther")) << text;
    EXPECT_TRUE(contains(text, "drawn as border")) << text;
    EXPECT_TRUE(contains(text, "line coverage of the pixel: 1.0000")) << text;
}

TEST(Explain, SaysWhyThereIsNoLine) {
    const Scene scene = scene_of({make_plane(60, 60, 2, 2)});
    Camera camera;
    camera.orthographic = true;
    camera.height = 100;
    camera.to_world = glm::dmat4(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 10, 0, 1);
    const std::string text = explain(scene, camera, 100, 50, 40);
    EXPECT_TRUE(contains(text, "classes: polygon, none of them asked for")) << text;
    EXPECT_TRUE(contains(text, "no line is drawn")) << text;
    const std::string empty = explain(scene, camera, 100, 2, 2);
    EXPECT_TRUE(contains(empty, "0 fragments")) << empty;
}

/// A quadrilateral on the left and a triangle on the right, which came the other way round.
TEST(Explain, NumbersTrianglesAsTheyStoodInTheFile) {
    Scene scene =
        scene_of({soup_of({{10, 10, 0}, {40, 10, 0}, {40, 40, 0}, {10, 40, 0}, {60, 10, 0}, {90, 10, 0}, {90, 40, 0}},
                          {{0, 1, 2, 3}, {4, 5, 6}})});
    const auto left_and_right = [&] {
        return explain(scene, pixel_camera(100, 100), 100, 12, 85) +
               explain(scene, pixel_camera(100, 100), 100, 38, 65) +
               explain(scene, pixel_camera(100, 100), 100, 85, 85);
    };
    const std::string as_read = left_and_right();
    EXPECT_TRUE(contains(as_read, "polygon 1, triangle 0") && contains(as_read, "polygon 1, triangle 1") &&
                contains(as_read, "polygon 2, triangle 2"))
        << as_read;
    scene.meshes[0].input_order = InputOrder({1, 0}, {});
    const std::string sorted = left_and_right();
    EXPECT_TRUE(contains(sorted, "polygon 2, triangle 1") && contains(sorted, "polygon 2, triangle 2") &&
                contains(sorted, "polygon 1, triangle 0"))
        << sorted;
}

/// A strip between the samples.
TEST(Explain, TellsOfLinesThatItsSamplesMiss) {
    const Scene scene =
        scene_of({soup_of({{50.51, 10, 5}, {50.53, 10, 5}, {50.53, 90, 5}, {50.51, 90, 5}}, {{0, 1, 2, 3}})});
    EXPECT_TRUE(contains(explain(scene, pixel_camera(100, 100), 100, 50, 50), "0 fragments"));
    const Frame frame = make_frame(scene, pixel_camera(100, 100), 100, 100, {0, 0, 100, 100});
    EXPECT_TRUE(contains(drawn_by_abuffer(frame, 50, 50), "covers of the pixel: border 0.9"))
        << drawn_by_abuffer(frame, 50, 50);
    EXPECT_TRUE(contains(drawn_by_abuffer(frame, 20, 50), "covers of the pixel: nothing"));
}

}  // namespace
}  // namespace burin::explain_test
