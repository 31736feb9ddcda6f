// Variables of lines that change with depth, light and sets have the values that geometry gives them.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "tests/support/shaded_scene.h"

namespace burin::line_slopes_test {
namespace {

using namespace test;
using V = Variable;

/// A sheet that asks for what is read here.
std::string all_of(const std::string& classes, const std::string& head = "") {
    return head + sheet_of(classes, "width = \"=1 + 0 * (depth_x + depth_y + light + light2 + gap + rand_set)\"",
                           "qi = [0, 255]");
}

/// How the depth of a tilted plane changes from a pixel to the next one, along its border.
TEST(LineColumns, SlopesOfDepthAreThoseOfThePlane) {
    // z = 0.3 x + 0.2 y, in front of an eye that looks along -z: to the right it comes nearer, downwards it recedes.
    const auto at = [](double x, double y) { return glm::dvec3(x, y, 0.3 * x + 0.2 * y); };
    const auto on_screen = [&](const Camera& camera, double size) {
        return ShadedScene(
            {soup_of({at(-size, -size), at(size, -size), at(size, size), at(-size, size)}, {{0, 1, 2, 3}})}, camera,
            all_of(R"("border")"), 120, 100);
    };
    Camera level = pixel_camera(120, 100);
    level.to_world[3] = glm::dvec4(0, 0, 1000, 1);
    level.height = 200;  // two units are a pixel
    std::size_t count = 0;
    {
        const ShadedScene scene = on_screen(level, 60);
        const FoundLines lines = scene.found();
        const ColumnsOfLines columns(lines);
        columns.each([&](const LineSample& sample, const LineRun&, const LinePiece&) {
            ++count;
            EXPECT_NEAR(columns.at(V::depth_x, sample), -0.3 * 2, 1e-4);
            EXPECT_NEAR(columns.at(V::depth_y, sample), 0.2 * 2, 1e-4);
        });
    }
    EXPECT_GT(count, 50u);
    count = 0;
    const ShadedScene scene = on_screen(perspective_camera({0, 0, 9}, {0, 0, 0}, 40), 2);
    const double focal = scene.frame(scene.whole()).surfaces.projection.focal_px;
    const FoundLines lines = scene.found();
    const ColumnsOfLines columns(lines);
    columns.each([&](const LineSample& sample, const LineRun&, const LinePiece&) {
        ++count;
        // A ray to the right by u and up by v meets the plane at depth 9 / (1 + 0.3 u + 0.2 v).
        const double u = (static_cast<double>(columns.at(V::x, sample)) - 60) / focal,
                     v = (50 - static_cast<double>(columns.at(V::y, sample))) / focal;
        const double depth = 9 / (1 + 0.3 * u + 0.2 * v);
        EXPECT_NEAR(columns.at(V::depth, sample), depth, 0.013);  // at corners, what a pixel changes
        EXPECT_NEAR(columns.at(V::depth_x, sample), -depth * depth * 0.3 / 9 / focal, 1e-6 * depth * depth);
        EXPECT_NEAR(columns.at(V::depth_y, sample), depth * depth * 0.2 / 9 / focal, 1e-6 * depth * depth);
    });
    EXPECT_GT(count, 50u);
}

/// A fold of a flat face and a steep one: each side has the light that its own normal gets.
TEST(LineColumns, BothSidesHaveTheirLight) {
    const auto fold = soup_of({{20, 50, 0}, {100, 50, 0}, {100, 59, -3}, {20, 59, -3}, {100, 41, -9}, {20, 41, -9}},
                              {{0, 1, 2, 3}, {1, 0, 5, 4}});
    const glm::dvec3 flat = glm::normalize(glm::dvec3(0, 1, 3)), steep = glm::normalize(glm::dvec3(0, -1, 1));
    for (const glm::dvec3 light : {glm::dvec3(0, 0, 1), {0, 3, 4}, {0, 4, 3}, {1, -2, 2}, {0, -4, 1}}) {
        const std::string text = "light = [" + std::to_string(light.x) + ", " + std::to_string(light.y) + ", " +
                                 std::to_string(light.z) + "]\n";
        const ShadedScene scene({fold}, pixel_camera(120, 100), all_of(R"("crease")", text), 120, 100);
        const FoundLines lines = scene.found();
        const ColumnsOfLines columns(lines);
        std::size_t count = 0;
        columns.each([&](const LineSample& sample, const LineRun&, const LinePiece&) {
            ++count;
            const glm::dvec3 to_light = glm::normalize(light);
            EXPECT_NEAR(columns.at(V::light, sample), std::max(glm::dot(flat, to_light), 0.0), 1e-5) << text;
            EXPECT_NEAR(columns.at(V::light2, sample), std::max(glm::dot(steep, to_light), 0.0), 1e-5) << text;
        });
        EXPECT_GT(count, 0u);
    }
}

/// Of what is behind a contour, or 0 before the background.
TEST(LineColumns, TheLightBehindAContourIsThatOfWhatIsSeenThere) {
    for (const bool has_wall : {true, false}) {
        std::vector<PolygonSoup> objects{
            soup_of({{40, 30, 50}, {80, 30, 50}, {80, 70, 50}, {40, 70, 50}}, {{0, 1, 2, 3}})};
        if (has_wall)  // its normal is (-0.6, 0, 0.8)
            objects.push_back(soup_of({{0, 0, -90}, {120, 0, 0}, {120, 100, 0}, {0, 100, -90}}, {{0, 1, 2, 3}}));
        const ShadedScene scene(std::move(objects), pixel_camera(120, 100),
                                all_of(R"("border", "silhouette")", "light = [0, 3, 4]\n"), 120, 100);
        const FoundLines lines = scene.found();
        const ColumnsOfLines columns(lines);
        std::size_t count = 0;
        columns.each([&](const LineSample& sample, const LineRun& run, const LinePiece&) {
            if (run.is_hidden || columns.at(V::object, sample) != 1) return;
            ++count;
            EXPECT_NEAR(columns.at(V::light, sample), 0.8, 1e-5);
            EXPECT_NEAR(columns.at(V::light2, sample), has_wall ? 0.64 : 0, 1e-5);
        });
        EXPECT_GT(count, 10u);
    }
}

/// The random number of a set is that of its name, wherever its lines are, with the seed and the copy.
TEST(LineColumns, RandomNumbersOfSetsAreOnePerSet) {
    const std::string camera = "[camera]\neye = [3, 2, 7]\nfov = 50\n", box = "[[object]]\nshape = \"box\"\n",
                      other = "[[object]]\nname = \"b\"\nshape = \"box\"\ntranslate = [2, 0, 0]\n";
    const auto number = [&](const std::string& text, const SampleVariant& variant) {
        const ShadedScene scene(text, all_of(R"("crease")"));
        const FoundLines lines = scene.found();
        const ColumnsOfLines columns(lines);
        std::set<float> all;
        columns.each([&](const LineSample& sample, const LineRun&, const LinePiece&) {
            all.insert(columns.at(V::rand_set, sample, 0, variant));
        });
        EXPECT_EQ(all.size(), 1u);
        EXPECT_TRUE(*all.begin() >= 0 && *all.begin() < 1);
        return *all.begin();
    };
    const float one = number(camera + box, {0, 0, "all"});
    EXPECT_EQ(number(camera + other + box, {0, 0, "all"}), one);
    EXPECT_EQ(number(box, {0, 0, "all"}), one);
    std::set<float> others{one};
    for (const SampleVariant& v : {SampleVariant{0, 0, "some"}, {0, 0, "alle"}, {1, 0, "all"}, {0, 1, "all"}})
        others.insert(number(camera + box, v));
    EXPECT_EQ(others.size(), 5u);
}

}  // namespace
}  // namespace burin::line_slopes_test
