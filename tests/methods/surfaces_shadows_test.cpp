// Where `lit` changes on a surface itself: where it turns away from the light, and where another one stands on it.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "methods/abuffer.h"
#include "tests/scene/scene_text.h"
#include "tests/support/drawing.h"

namespace burin::surfaces_shadows_test {
namespace {

using namespace test;

constexpr int kSize = 200;

Drawing drawn(const std::string& text) {
    return Drawing(loaded("[lines]\ndraw = \"none\"\n" + text), pixel_camera(kSize, kSize), kSize, kSize,
                   {0, 0, kSize, kSize}, 2, render_abuffer);
}

TEST(Terminator, IsAsSoftAsAPixel) {
    const glm::dvec3 light = glm::normalize(glm::dvec3(3, 1, 1));
    const Drawing d = drawn(
        "[[light]]\ndirection = [3, 1, 1]\n[surfaces]\ncolor = \"=rgb(lit, lit, lit)\"\nnormals = \"smooth\"\n"
        "[[object]]\nshape = \"sphere\"\nradius = 80\nsegments = 256\nrings = 128\ntranslate = [100, 100, 0]\n");
    int between = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const double u = (x + 0.5 - 100) / 80, v = (100 - y - 0.5) / 80;
            if (std::hypot(u, v) > 0.85) continue;
            const double w = std::sqrt(1 - u * u - v * v);
            const double cosine = light.x * u + light.y * v + light.z * w;
            const double per_px = std::hypot(light.x - light.z * u / w, light.y - light.z * v / w) / 80;
            const double share = std::clamp(0.5 + cosine / per_px, 0.0, 1.0);
            ASSERT_NEAR(d.at("R", x, y), share, 0.2) << x << ' ' << y;
            between += d.at("R", x, y) > 0.1 && d.at("R", x, y) < 0.9 ? 1 : 0;
        }
    }
    EXPECT_GT(between, 100);
}

TEST(Contact, OfABoxWithAFloorHasNoDots) {
    const std::string on_floor = "translate = [100, 80, 0]\nrotate = [50, 0, 0]\n";
    for (const char* const normals : {"flat", "smooth"}) {
        const std::string scene =
            "[[light]]\ndirection = [-0.3, 0.5, 2]\n[surfaces]\ncolor = \"=rgb(lit, lit, lit)\"\nnormals = \"" +
            std::string(normals) + "\"\n[[object]]\nname = \"floor\"\nshape = \"plane\"\nsize = [400, 400]\n" +
            on_floor + "[[object]]\nname = \"box\"\nshape = \"box\"\nsize = [60, 60, 60]\n" + on_floor +
            "instance = [{ rotate = [0, 27, 0], translate = [0, 30, 0] }]\n";
        const Drawing d = drawn(scene);
        int contact = 0;
        for (int y = 132; y < kSize; ++y) {  // in front of the box
            for (int x = 0; x < kSize; ++x) {
                ASSERT_GE(d.at("R", x, y), 0.999) << normals << ' ' << x << ' ' << y;
                contact += d.at("id.object", x, y) != d.at("id.object", x, y - 1) ? 1 : 0;
            }
        }
        EXPECT_GT(contact, 40);
    }
}

}  // namespace
}  // namespace burin::surfaces_shadows_test
