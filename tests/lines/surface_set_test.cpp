#include "lines/surface_set.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/drawing.h"

namespace burin {
namespace {

using namespace test;

/// A disc around a place, tilted by `tilt` per unit to the right and by as much downwards.
PolygonSoup disc(glm::dvec3 middle, std::uint32_t corners, double tilt = 0) {
    PolygonSoup soup;
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double angle = 0.3 + 6.283185307179586 * i / corners;
        const glm::dvec2 at(30 * std::cos(angle), 30 * std::sin(angle));
        soup.positions.push_back(middle + glm::dvec3(at, tilt * (at.x + at.y)));
        numbers.push_back(i);
    }
    soup.add_polygon(numbers);
    return soup;
}

struct Orders {
    int coincident = 0, in_front = 0, behind = 0, asked = 0;

    /// Of all triangles of the first object and all of the second one.
    explicit Orders(std::vector<PolygonSoup> objects) {
        const Scene scene = scene_of(std::move(objects));
        const Frame frame = make_frame(scene, pixel_camera(100, 100), 100, 100, {0, 0, 100, 100});
        const SurfaceSet& surfaces = frame.surfaces;
        for (std::uint32_t s = 0; s < scene.meshes[0].triangles.size(); ++s) {
            for (std::uint32_t t = 0; t < scene.meshes[1].triangles.size(); ++t) {
                const SurfaceOrder order = surfaces.order({0, s}, {1, t});
                if (!order.have_common_place) continue;
                ++asked;
                coincident += order.are_coincident();
                in_front += order.has_front && !order.has_behind && !order.has_level;
                behind += order.has_behind && !order.has_front && !order.has_level;
            }
        }
    }
};

TEST(SurfaceSet, ComparesWholePolygons) {
    // Their planes cross within the picture, 1/100 pixel apart at most: some pairs of triangles do not cross themselves.
    const Orders quads({disc({50, 50, 0}, 4), disc({50, 50, 0.0015}, 4, 2e-4)});
    EXPECT_EQ(quads.asked, 4);
    EXPECT_EQ(quads.coincident, 4);
    EXPECT_EQ(quads.in_front + quads.behind, 0);
}

/// Or time would grow with the square of the corners.
TEST(SurfaceSet, ComparesTrianglesOfPolygonsWithManyCorners) {
    const Orders discs({disc({50, 50, 0}, 60), disc({50, 50, 0.0015}, 47, 2e-4)});
    EXPECT_GT(discs.asked, 100);
    EXPECT_GT(discs.in_front, 0);
    EXPECT_GT(discs.behind, 0);
    EXPECT_GT(discs.coincident, 0);
}

TEST(SurfaceSet, ComparesNoPolygonWithItself) {
    const Scene scene = scene_of({disc({50, 50, 0}, 4)});
    const Frame frame = make_frame(scene, pixel_camera(100, 100), 100, 100, {0, 0, 100, 100});
    EXPECT_FALSE(frame.surfaces.order({0, 0}, {0, 1}).have_common_place);
    EXPECT_FALSE(frame.surfaces.order({0, 0}, {0, 0}).have_common_place);
}

}  // namespace
}  // namespace burin
