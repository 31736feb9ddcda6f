// Meshes whose polygons have fallen apart by less than a pixel.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "methods/patel/patel.h"
#include "methods/reference/reference.h"
#include "render/close_cracks.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::cracks_test {
namespace {

using namespace test;

constexpr int kSize = 160;

/// Every corner of every polygon for itself, moved by up to `by` along each axis.
PolygonSoup shaken(const PolygonSoup& soup, double by, std::uint64_t seed) {
    Random random(seed);
    PolygonSoup result = soup_of({}, {});
    for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
        std::vector<std::uint32_t> corners;
        for (const std::uint32_t corner : soup.polygon(i)) {
            corners.push_back(static_cast<std::uint32_t>(result.positions.size()));
            result.positions.push_back(soup.positions[corner] + random.in_box(by));
        }
        result.add_polygon(corners);
    }
    return result;
}

/// The greatest line within `reach` pixels.
double near(const Drawing& d, int x, int y, int reach) {
    double most = 0;
    for (int v = std::max(y - reach, 0); v <= std::min(y + reach, d.height() - 1); ++v) {
        for (int u = std::max(x - reach, 0); u <= std::min(x + reach, d.width() - 1); ++u)
            most = std::max(most, d.line(u, v));
    }
    return most;
}

Drawing draw(Scene scene, const Camera& camera, RenderFunction render) {
    scene.lines.crease_angle_deg = 75;  // few edges are near it
    close_cracks(scene, camera, kSize, kSize, 2);
    return Drawing(scene, camera, kSize, kSize, {0, 0, kSize, kSize}, 2, render);
}

struct Shape {
    const char* name;
    PolygonSoup soup;
};

std::vector<Shape> shapes() {
    const auto hills = [](glm::dvec3 p) {
        return glm::dvec3(p.x, 0.25 * std::sin(3 * p.x) * std::cos(2.5 * p.z), p.z);
    };
    return {{"torus", make_torus(1, 0.4, 48, 24)},
            {"sphere", make_sphere(1.2, 40, 20)},
            {"hills", transformed(make_plane(2.4, 2.4, 16, 16), hills)},
            {"box", make_box({1.6, 1.2, 1.4})},
            {"cylinder", make_cylinder(0.8, 0.6, 1.8, 36)}};
}

// No more than 0.03 % of the picture is false, and nothing is lost.
TEST(Cracks, HaveNoLines) {
    for (const Shape& shape : shapes()) {
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            Random random(seed);
            const double distance = random.real(4, 5);
            const Camera camera = perspective_camera(
                distance * glm::normalize(glm::dvec3(random.real(-1, 1), random.real(0.2, 1), random.real(0.5, 1))),
                {0, 0, 0});
            const double pixel = 2 * distance * std::tan(glm::radians(35.0) / 2) / kSize;
            for (RenderFunction render : {RenderFunction{render_abuffer}, RenderFunction{render_patel}}) {
                const Drawing whole = draw(scene_of({shape.soup}), camera, render);
                for (const double by_px : {0.002, 0.01, 0.05}) {
                    const Drawing drawn = draw(scene_of({shaken(shape.soup, by_px * pixel, seed)}), camera, render);
                    int count_false = 0, count_missed = 0;
                    for (int y = 0; y < kSize; ++y) {
                        for (int x = 0; x < kSize; ++x) {
                            if (drawn.line(x, y) > 0.25 && near(whole, x, y, 2) == 0) ++count_false;
                            if (whole.line(x, y) > 0.5 && near(drawn, x, y, 1) < 0.1) ++count_missed;
                        }
                    }
                    const std::string what =
                        std::string(shape.name) + ", seed " + std::to_string(seed) + ", " + std::to_string(by_px);
                    EXPECT_LE(count_false, 0.0003 * kSize * kSize) << what;
                    EXPECT_EQ(count_missed, 0) << what;
                }
            }
        }
    }
}

TEST(Cracks, WiderThanAPixelHaveTheirBorders) {
    const PolygonSoup halves = soup_of(
        {{-1, -1, 0}, {-0.01, -1, 0}, {-0.01, 1, 0}, {-1, 1, 0}, {0.01, -1, 0}, {1, -1, 0}, {1, 1, 0}, {0.01, 1, 0}},
        {{0, 1, 2, 3}, {4, 5, 6, 7}});
    const auto ink_in_the_middle = [&](double distance) {
        const Drawing drawn = draw(scene_of({halves}), perspective_camera({0, 0, distance}, {0, 0, 0}), render_abuffer);
        double sum = 0;
        for (int x = kSize / 2 - 6; x < kSize / 2 + 6; ++x) sum += drawn.line(x, kSize / 2);
        return sum;
    };
    const double per_pixel = 2 * std::tan(glm::radians(35.0) / 2) / kSize;  // at distance 1
    EXPECT_NEAR(ink_in_the_middle(0.02 / (3 * per_pixel)), 2, 0.05);
    EXPECT_EQ(ink_in_the_middle(0.02 / (0.9 * per_pixel)), 0);
}

// One mesh, which one object shows from near by and another one from afar.
TEST(Cracks, AreWiderThanAPixelIfTheyAreInOneObject) {
    const PolygonSoup halves = soup_of(
        {{-1, -1, 0}, {-0.01, -1, 0}, {-0.01, 1, 0}, {-1, 1, 0}, {0.01, -1, 0}, {1, -1, 0}, {1, 1, 0}, {0.01, 1, 0}},
        {{0, 1, 2, 3}, {4, 5, 6, 7}});
    const auto borders = [&](double scale, double depth, bool along_view = false) {
        Scene scene = scene_of({halves});
        scene.objects.push_back(scene.objects.front());
        scene.objects.back().to_world = glm::dmat4(glm::dmat3(scale));
        if (along_view) scene.objects.back().to_world = {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 0, 0, 1}};
        scene.objects.back().to_world[3] = {0, 0, depth, 1};
        close_cracks(scene, perspective_camera({0, 0, 6}, {0, 0, 0}), kSize, kSize, 2);
        return scene.meshes.front().borders.segments().size();
    };
    EXPECT_EQ(borders(1, 0), 6u);
    EXPECT_EQ(borders(10, 0), 8u);
    EXPECT_EQ(borders(1, 4), 8u);
    EXPECT_EQ(borders(1, -20), 6u);
    EXPECT_EQ(borders(1, 6, true), 8u);  // it passes the eye
    EXPECT_EQ(borders(1, 20), 6u);       // it is behind the eye, and not seen
}

/// What is behind the eye is not seen, and says nothing about the others.
TEST(Cracks, AreClosedThoughAnotherInstanceIsBehindTheEye) {
    const Camera camera = perspective_camera({0, 0, 10}, {0, 0, 0}, 35);
    Scene alone = scene_of({shaken(make_sphere(1, 24, 12), 0.0005, 3)}), two = alone;
    two.objects.push_back(two.objects.front());
    two.objects.back().to_world[3] += glm::dvec4(0, 0, 40, 0);
    for (Scene* scene : {&alone, &two}) {
        const std::size_t before = scene->meshes[0].borders.segments().size();
        close_cracks(*scene, camera, kSize, kSize, 2);
        EXPECT_LT(scene->meshes[0].borders.segments().size(), before / 10);
    }
    EXPECT_EQ(alone.meshes[0].triangles, two.meshes[0].triangles);
}

}  // namespace
}  // namespace burin::cracks_test
