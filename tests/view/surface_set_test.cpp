#include "view/surface_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/shapes.h"
#include "tests/support/layers.h"

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

    /// Counts the orders of all triangles of the first object and all of the second one.
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
    // Their planes cross within the picture, 1/100 pixel apart at most: some pairs of triangles do not cross
    // themselves.
    const Orders quads({disc({50, 50, 0}, 4), disc({50, 50, 0.0015}, 4, 2e-4)});
    EXPECT_EQ(quads.asked, 4);
    EXPECT_EQ(quads.coincident, 4);
    EXPECT_EQ(quads.in_front + quads.behind, 0);
}

TEST(SurfaceSet, TrianglesAreOfOnePolygonWhereIdsAreEqual) {
    const Scene scene = scene_of({disc({50, 50, 0}, 7), make_plane(60, 60, 3, 2), disc({40, 50, 1}, 7)});
    const Frame frame = make_frame(scene, pixel_camera(100, 100), 100, 100, {0, 0, 100, 100});
    const SurfaceSet& surfaces = frame.surfaces;
    std::vector<SurfaceId> all = {kBackground};
    for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) {
        for (std::uint32_t t = 0; t < scene.meshes[i].triangles.size(); ++t) all.push_back({i, t});
    }
    for (const SurfaceId a : all) {
        for (const SurfaceId b : all)
            EXPECT_EQ(surfaces.are_of_one_polygon(a, b), surfaces.polygon_id(a) == surfaces.polygon_id(b));
    }
}

/// Or time would grow with the square of the corners.
TEST(SurfaceSet, ComparesTrianglesOfPolygonsWithManyCorners) {
    const Orders discs({disc({50, 50, 0}, 60), disc({50, 50, 0.0015}, 47, 2e-4)});
    EXPECT_GT(discs.asked, 100);
    EXPECT_GT(discs.in_front, 0);
    EXPECT_GT(discs.behind, 0);
    EXPECT_GT(discs.coincident, 0);
}

/// How many faces near z = 0 of one box coincide with those of another one, both in one object.
int coincident_faces(const PolygonSoup& a, const PolygonSoup& b) {
    const Scene scene = scene_of({joined({a, b})});
    const Frame frame = make_frame(scene, pixel_camera(100, 100), 100, 100, {0, 0, 100, 100});
    const auto is_near_zero = [&](std::uint32_t t) {
        const auto& corners = scene.meshes[0].triangles[t];
        return std::all_of(corners.begin(), corners.end(),
                           [&](std::uint32_t v) { return std::abs(scene.meshes[0].position(v).z) < 0.1; });
    };
    int count = 0;
    const auto first_of_b = static_cast<std::uint32_t>(2 * a.polygon_count()),
               end = static_cast<std::uint32_t>(scene.meshes[0].triangles.size());
    for (std::uint32_t s = 0; s < first_of_b; ++s) {
        for (std::uint32_t t = first_of_b; t < end; ++t)
            count += is_near_zero(s) && is_near_zero(t) && frame.surfaces.order({0, s}, {0, t}).are_coincident();
    }
    return count;
}

/// Bodies of one object are flush, whichever way they are wound. A thin plate has two sides, as do two sheets.
TEST(SurfaceSet, TellsTheSidesOfBodies) {
    const auto tilted = [](glm::dvec3 p) { return p + glm::dvec3(0, 0, 0.0015 + 2e-4 * (p.x + p.y - 100)); };
    const PolygonSoup large = moved(make_box({60, 60, 20}), {50, 50, -10}),
                      small = transformed(moved(make_box({30, 30, 20}), {50, 50, -10}), tilted);
    for (const PolygonSoup& a : {large, turned(large)}) {
        for (const PolygonSoup& b : {small, turned(small)}) EXPECT_EQ(coincident_faces(a, b), 4);
    }
    const PolygonSoup behind =
        transformed(moved(make_box({30, 30, 20}), {50, 50, 10}), tilted);  // with its back at z = 0
    for (const PolygonSoup& b : {behind, turned(behind)}) EXPECT_EQ(coincident_faces(large, b), 0);
    const PolygonSoup sheet = disc({50, 50, 0}, 4), other = disc({50, 50, 0.0015}, 4, 2e-4);
    EXPECT_EQ(coincident_faces(sheet, other), 4);
    EXPECT_EQ(coincident_faces(sheet, turned(other)), 0);
}

TEST(SurfaceSet, ComparesNoPolygonWithItself) {
    const Scene scene = scene_of({disc({50, 50, 0}, 4)});
    const Frame frame = make_frame(scene, pixel_camera(100, 100), 100, 100, {0, 0, 100, 100});
    EXPECT_FALSE(frame.surfaces.order({0, 0}, {0, 1}).have_common_place);
    EXPECT_FALSE(frame.surfaces.order({0, 0}, {0, 0}).have_common_place);
}

/// Users know polygons by the order of the file, whatever the mesh's is.
TEST(SurfaceSet, PolygonsHaveTheNumbersOfTheInput) {
    Scene scene = scene_of({make_box({10, 10, 10}), make_box({10, 10, 10})});
    ASSERT_EQ(scene.meshes[1].polygon_count, 6u);
    scene.meshes[1].input_order = InputOrder({5, 4, 3, 2, 1, 0}, {});
    const Frame frame = make_frame(scene, pixel_camera(100, 100), 100, 100, {0, 0, 100, 100});
    for (std::uint32_t t = 0; t < 12; ++t) {
        const std::uint32_t polygon = scene.meshes[1].polygon_of(t);
        EXPECT_EQ(frame.surfaces.polygon_id({0, t}), 1 + scene.meshes[0].polygon_of(t));
        EXPECT_EQ(frame.surfaces.polygon_id({1, t}), 1 + 6 + (5 - polygon));
    }
}

}  // namespace
}  // namespace burin
