#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "mesh/shapes.h"
#include "methods/method_table.h"
#include "tests/support/drawing.h"

namespace burin::layers_test {
namespace {

using namespace test;

Drawing some_drawing() {
    Scene scene =
        scene_of({make_box({1, 1, 1}),
                  transformed(make_sphere(0.4, 32, 16), [](glm::dvec3 p) { return p + glm::dvec3(0.5, 0.3, 0.2); })});
    scene.lines.style.colors.fill({0.2f, 0.4f, 0.6f});
    scene.surfaces.shading = SurfaceShading::lambert;
    return Drawing(scene, perspective_camera({2, 1.5, 3}, {0, 0, 0}), 120, 100);
}

TEST(Layers, ClassesAddUpToAllLines) {
    const Drawing d = some_drawing();
    for (int y = 0; y < d.height(); ++y) {
        for (int x = 0; x < d.width(); ++x) {
            double sum = 0;
            for (int c = 0; c < kLineClassCount; ++c) sum += d.line(static_cast<LineClass>(c), x, y);
            ASSERT_NEAR(sum, d.line(x, y), 2e-3) << x << "," << y;
        }
    }
    EXPECT_GT(d.sum(LineClass::intersection), 10) << "the ball sticks out of the box";
}

TEST(Layers, ColoursArePremultiplied) {
    const Drawing d = some_drawing();
    for (int y = 0; y < d.height(); ++y) {
        for (int x = 0; x < d.width(); ++x) {
            ASSERT_NEAR(d.at("lines.R", x, y), 0.2 * d.at("lines.A", x, y), 1e-3);
            ASSERT_NEAR(d.at("lines.B", x, y), 0.6 * d.at("lines.A", x, y), 1e-3);
            ASSERT_LE(d.at("R", x, y), d.at("A", x, y) + 1e-3);
            // Beauty covers what surfaces and lines cover together.
            ASSERT_GE(d.at("A", x, y) + 1e-3, std::max(d.at("lines.A", x, y), d.at("surface.A", x, y)));
            ASSERT_LE(d.at("A", x, y), d.at("lines.A", x, y) + d.at("surface.A", x, y) + 1e-3);
        }
    }
}

TEST(Layers, NumbersDepthAndNormalAreThoseOfVisibleSurfaces) {
    const Drawing d = some_drawing();
    std::set<double> objects;
    for (int y = 0; y < d.height(); ++y) {
        for (int x = 0; x < d.width(); ++x) {
            const double object = d.at("id.object", x, y);
            objects.insert(object);
            const double length = std::hypot(d.at("N.X", x, y), d.at("N.Y", x, y), d.at("N.Z", x, y));
            if (object == 0) {
                ASSERT_TRUE(std::isinf(d.at("Z", x, y)));
                ASSERT_EQ(length, 0);
                ASSERT_EQ(d.at("id.polygon", x, y), 0);
                ASSERT_EQ(d.at("id.material", x, y), 0);
            } else {
                ASSERT_GT(d.at("Z", x, y), 2);
                ASSERT_LT(d.at("Z", x, y), 5);
                ASSERT_NEAR(length, 1, 1e-5);
                ASSERT_EQ(d.at("id.material", x, y), object);
                ASSERT_EQ(d.at("id.polygon", x, y) <= 6, object == 1) << "the box has polygons 1 to 6";
            }
        }
    }
    EXPECT_EQ(objects, (std::set<double>{0, 1, 2}));
}

TEST(Layers, InvisibleSurfacesStillHide) {
    Scene scene = scene_of({make_box({1, 1, 1})});
    const Camera camera = perspective_camera({2, 1.5, 3}, {0, 0, 0});
    const Drawing paper(scene, camera, 100, 100);
    scene.surfaces.shading = SurfaceShading::none;
    const Drawing none(scene, camera, 100, 100);
    EXPECT_EQ(paper.coverage(), none.coverage());
    EXPECT_NEAR(none.sum("A"), none.sum("lines.A"), 0.5);
    EXPECT_GT(paper.sum("A"), 5 * none.sum("A"));
}

/// What a method draws over memory that holds some byte.
Image drawn_over(const Method& method, const Scene& scene, PixelRect crop, std::uint8_t garbage) {
    const Frame frame = make_frame(scene, perspective_camera({2, 1.5, 3}, {0, 0, 0}), 150, 140, crop);
    const LayerSet layers{true, true, true, true, true, true, true};
    Film film({0, 0, 150, 140}, crop, layers, frame.criteria.classes);
    for (const Channel& channel : film.image().channels()) {
        auto& bytes = const_cast<Channel&>(channel).bytes;
        std::fill(bytes.begin(), bytes.end(), std::byte{garbage});
    }
    method.render(frame, {}, film);
    return film.image();
}

TEST(Layers, EveryPixelIsPut) {
    Scene scene = scene_of({make_box({1, 1, 1})});
    std::vector<Scene> scenes(3, scene);
    scenes[1].surfaces.shading = SurfaceShading::lambert;
    scenes[2].materials.front().opacity = 0.5f;
    for (Scene& s : scenes) s.reference.samples = 4;
    for (const Method& method : methods()) {
        for (const Scene& s : scenes) {
            for (const PixelRect crop : {PixelRect{0, 0, 150, 140}, PixelRect{3, 5, 144, 131}}) {
                EXPECT_TRUE(same_bits(drawn_over(method, s, crop, 0x00), drawn_over(method, s, crop, 0xA5)))
                    << method.name;
            }
        }
    }
}

TEST(Layers, AnImageThatDoesNotFitTheMachineIsRefused) {
    const LayerSet all{true, true, true, true, true, true, true};
    EXPECT_THROW(Film({0, 0, 65535, 65535}, {0, 0, 65535, 65535}, all, LineClassSet::all()), std::runtime_error);
}

}  // namespace
}  // namespace burin::layers_test
