// What lies on a ground by a small part of a pixel, as roads do, is seen from anywhere.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "tests/support/ink_apart.h"
#include "tests/support/layers.h"

namespace burin::low_relief_test {
namespace {

using namespace test;

constexpr int kPx = 160;
constexpr double kViewHeight = 20, kPixel = kViewHeight / kPx;

PolygonSoup turned_about_y(const PolygonSoup& soup) {
    const double c = std::cos(0.3), s = std::sin(0.3);
    return transformed(soup, [=](glm::dvec3 p) { return glm::dvec3(c * p.x + s * p.z + 0.1, p.y, c * p.z - s * p.x); });
}
PolygonSoup slab(double height) { return turned_about_y(moved(make_box({12, height, 1.5}), {0, 0.5 * height, 0})); }
PolygonSoup strip(double height) {
    return turned_about_y(
        soup_of({{-6, height, -0.75}, {6, height, -0.75}, {6, height, 0.75}, {-6, height, 0.75}}, {{0, 1, 2, 3}}));
}
PolygonSoup ground(double half) {
    return soup_of({{-half, 0, -half}, {half, 0, -half}, {half, 0, half}, {-half, 0, half}}, {{0, 1, 2, 3}});
}

Camera camera_at(double elevation_deg, bool orthographic) {
    const double e = glm::radians(elevation_deg), distance = kViewHeight / (2 * std::tan(glm::radians(15.0)));
    Camera camera = perspective_camera({0.3, distance * std::sin(e), distance * std::cos(e)}, glm::dvec3(0.0), 30);
    camera.orthographic = orthographic;
    camera.height = kViewHeight;
    return camera;
}

int pixels_of(const Drawing& d, int object) {
    int count = 0;
    for (int y = 0; y < kPx; ++y) {
        for (int x = 0; x < kPx; ++x) count += d.at("id.object", x, y) == object ? 1 : 0;
    }
    return count;
}

TEST(LowRelief, IsSeenOnAGround) {
    for (const double half : {40.0, 4000.0}) {
        for (const bool is_slab : {false, true}) {
            for (const bool in_one : {false, true}) {
                if (in_one && !is_slab) continue;  // a sheet in contact with its own object has no border
                for (const bool is_first : {false, true}) {
                    for (const double elevation_deg : {88.0, 40.0, 12.0, 5.0}) {
                        for (const bool orthographic : {false, true}) {
                            const Camera camera = camera_at(elevation_deg, orthographic);
                            const auto drawn = [&](double height_px) {
                                const PolygonSoup road = (is_slab ? slab : strip)(height_px * kPixel),
                                                  plane = ground(half);
                                std::vector<PolygonSoup> objects =
                                    is_first ? std::vector{road, plane} : std::vector{plane, road};
                                if (in_one) objects = {test::joined(objects)};
                                return Drawing(scene_of(objects), camera, kPx, kPx, {0, 0, kPx, kPx}, 2,
                                               render_abuffer);
                            };
                            const Drawing expected = drawn(0.05);
                            for (const double height_px : {0.02, 0.006, half > 1000 ? 0.003 : 0.001}) {
                                const std::string what =
                                    std::to_string(half) + (is_slab ? " slab" : " strip") +
                                    (in_one ? ", one" : ", two") + (is_first ? ", first, " : ", second, ") +
                                    std::to_string(elevation_deg) +
                                    (orthographic ? " orthographic, " : " perspective, ") + std::to_string(height_px);
                                const Drawing d = drawn(height_px);
                                EXPECT_LE(ink_apart(d, expected), 0.5) << what;
                                EXPECT_LE(ink_apart(expected, d), 0.5) << what;
                                EXPECT_NEAR(d.sum("lines.A"), expected.sum("lines.A"), 0.02 * expected.sum("lines.A"))
                                    << what;
                                if (!in_one) {
                                    EXPECT_NEAR(pixels_of(d, is_first ? 1 : 2), pixels_of(expected, is_first ? 1 : 2),
                                                8)
                                        << what;
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace burin::low_relief_test
