// Small pictures, kept as text: one character per pixel, from ' ' (no line) to '@' (all line).
//
// A picture that differs fails the test and is printed beside the expected one. To accept new
// pictures on purpose, run with REPLACE_GOLDEN=1 and look at the difference in version control; the
// run that replaces them fails as well.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "tests/support/drawing.h"
#include "tests/support/temporary_folder.h"

namespace burin::golden_test {
namespace {

using namespace test;

std::string as_text(const Drawing& d) {
    static constexpr char kLevels[] = " .:-=+*%@";
    std::string text;
    for (int y = 0; y < d.height(); ++y) {
        for (int x = 0; x < d.width(); ++x) {
            text += kLevels[static_cast<int>(std::ceil(d.line(x, y) * 8))];
        }
        while (!text.empty() && text.back() == ' ') text.pop_back();
        text += '\n';
    }
    return text;
}

void expect_golden(const std::string& name, const Scene& scene, const Camera& camera,
                   RenderFunction render = render_patel) {
    const std::string picture = as_text(Drawing(scene, camera, 48, 32, {0, 0, 48, 32}, 2, render));
    const std::string path = BURIN_SOURCE_FOLDER "/tests/strokes/golden/" + name + ".txt";
    const std::string expected = read_file(path);
    if (picture == expected) return;
    if (std::getenv("REPLACE_GOLDEN") != nullptr) {
        std::ofstream(path, std::ios::binary) << picture;
        FAIL() << "replaced " << path;
    }
    std::istringstream a(expected), b(picture);
    std::string side_by_side, line_a, line_b;
    while (std::getline(b, line_b)) {
        if (!std::getline(a, line_a)) line_a.clear();
        line_a.resize(48, ' ');
        side_by_side += line_a + (line_a.substr(0, line_b.size()) == line_b ? " | " : " # ") + line_b + "\n";
    }
    FAIL() << name << ": expected (left) and actual picture differ\n" << side_by_side;
}

PolygonSoup rectangle(double x0, double y0, double x1, double y1, double z, double tilt = 0) {
    return soup_of({{x0, y0, z}, {x1, y0, z + tilt}, {x1, y1, z + tilt}, {x0, y1, z}}, {{0, 1, 2, 3}});
}

TEST(Golden, Cube) {
    expect_golden("cube", scene_of({make_box({1, 1, 1})}), perspective_camera({2, 1.5, 3}, {0, 0, 0}, 30));
}

TEST(Golden, CrossingSheets) {
    expect_golden("crossing",
                  scene_of({rectangle(4.3, 4.3, 43.3, 20.3, -10, 20), rectangle(8.3, 8.3, 39.3, 28.3, 10, -20)}),
                  pixel_camera(48, 32));
}

TEST(Golden, TorusSilhouette) {
    expect_golden("torus", scene_of({make_torus(0.7, 0.25, 48, 24)}),
                  perspective_camera({0.4, 2.5, 3.2}, {0, 0, 0}, 30));
}

TEST(Golden, StrokesMeetAtATJunction) {
    expect_golden("t_junction", scene_of({rectangle(10.3, 10.3, 38.3, 22.3, 5), rectangle(20.3, 2.3, 28.3, 30.3, -5)}),
                  pixel_camera(48, 32));
}

TEST(Golden, ThinBars) {
    std::vector<PolygonSoup> bars;
    const double widths[] = {0.2, 0.5, 1.0, 2.0, 4.0};
    double x = 4.1;
    for (const double w : widths) {
        bars.push_back(rectangle(x, 3.3, x + w, 28.7, 0));
        x += w + 5.13;
    }
    expect_golden("thin_bars", scene_of(bars), pixel_camera(48, 32));
}

// ---- strokes of method abuffer ----

/// A roof whose ridge, a crease, runs behind a plate.
Scene roof_behind_plate() {
    return scene_of(
        {soup_of(
             {{3.3, 12.4, 0}, {45.2, 19.7, 0}, {45.2, 31.6, -30}, {3.3, 29.6, -30}, {3.3, 1.2, -30}, {45.2, 2.2, -30}},
             {{0, 1, 2, 3}, {1, 0, 4, 5}}),
         soup_of({{18.4, 6.2, 9}, {31.3, 8.8, 9}, {29.1, 27.2, 9}, {16.2, 24.6, 9}}, {{0, 1, 2, 3}})});
}

void expect_stroke(const std::string& name, Scene scene, double width_px, StrokeSide side = StrokeSide::both,
                   LineClassSet classes = kDefaultLineClasses) {
    scene.lines.style.width_px = width_px;
    scene.lines.style.side = side;
    scene.lines.classes = classes;
    expect_golden("stroke_" + name, scene, pixel_camera(48, 32), render_abuffer);
}

TEST(Golden, StrokesEndAtASurfaceInFrontThatIsNotDrawn) {
    expect_stroke("ends_1px", roof_behind_plate(), 1, StrokeSide::both, LineClass::crease);
    expect_stroke("ends_7px", roof_behind_plate(), 7, StrokeSide::both, LineClass::crease);
}

TEST(Golden, StrokesOnOneSide) {
    expect_stroke("inside", roof_behind_plate(), 5, StrokeSide::inside);
    expect_stroke("outside", roof_behind_plate(), 5, StrokeSide::outside);
}

/// Obtuse, right and acute corners, turning both ways.
Scene arrow() {
    return scene_of({soup_of({{5.3, 10.2, 0},
                              {24.6, 10.2, 0},
                              {24.6, 4.3, 0},
                              {42.7, 16.4, 0},
                              {24.6, 28.5, 0},
                              {24.6, 22.3, 0},
                              {5.3, 22.3, 0},
                              {12.4, 16.2, 0}},
                             {{0, 1, 2, 3, 4, 5, 6, 7}})});
}

TEST(Golden, JoinsAreRoundAndNothingIsDoubled) {
    expect_stroke("joins", arrow(), 4);
    expect_stroke("joins_inside", arrow(), 6, StrokeSide::inside);
    expect_stroke("joins_outside", arrow(), 6, StrokeSide::outside);
}

TEST(Golden, ThinStrokesAreLightNotBroken) { expect_stroke("thin", arrow(), 0.3); }

}  // namespace
}  // namespace burin::golden_test
