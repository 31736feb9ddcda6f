// What must not change a picture, and what must change it in a known way.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/shapes.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::invariance_test {
namespace {

using namespace test;

/// A heap of random triangles and a few shapes: occlusions, intersections, borders, creases.
Scene heap(std::uint64_t seed, double scale = 1) {
    Random random(seed);
    std::vector<PolygonSoup> objects;
    for (int o = 0; o < 3; ++o) {
        PolygonSoup soup;
        for (int i = 0; i < 12; ++i) {
            const glm::dvec3 center = random.in_box(1);
            std::vector<std::uint32_t> corners;
            const int count = random.integer(3, 4);
            const glm::dvec3 u = random.direction() * random.real(0.1, 0.8),
                             v = random.direction() * random.real(0.1, 0.8);
            for (int k = 0; k < count; ++k) {
                const double a = 6.283185307 * k / count;
                corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
                soup.positions.push_back((center + std::cos(a) * u + std::sin(a) * v) * scale);
            }
            soup.add_polygon(corners);
        }
        objects.push_back(soup);
    }
    objects.push_back(transformed(make_torus(0.7, 0.25, 24, 12), [=](glm::dvec3 p) { return p * scale; }));
    objects.push_back(
        transformed(make_box({0.8, 0.5, 1.1}), [=](glm::dvec3 p) { return (p + glm::dvec3(0.2, 0.3, -0.1)) * scale; }));
    Scene scene = scene_of(std::move(objects));
    scene.lines.classes = LineClassSet::all();
    return scene;
}

const glm::dvec3 kEye(2.3, 1.7, 4.1);

TEST(Invariance, ThreadsAndRepetitionChangeNothing) {
    const Scene scene = heap(1);
    const Camera camera = perspective_camera(kEye, {0, 0, 0});
    const Drawing one(scene, camera, 150, 110, 1);
    for (const int threads : {1, 2, 3, 8}) {
        EXPECT_TRUE(same_bits(one.image(), Drawing(scene, camera, 150, 110, threads).image())) << threads;
    }
}

TEST(Invariance, ACropIsThatPartOfTheWhole) {
    const Scene scene = heap(2);
    const Camera camera = perspective_camera(kEye, {0, 0, 0});
    const Drawing whole(scene, camera, 150, 110);
    const PixelRect crop{37, 21, 101, 80};
    const Drawing part(scene, camera, 150, 110, crop, 2);
    ASSERT_EQ(part.width(), crop.width());
    for (const Channel& channel : part.image().channels()) {
        const Channel& full = *whole.image().find(channel.name);
        for (int y = 0; y < part.height(); ++y) {
            for (int x = 0; x < part.width(); ++x) {
                ASSERT_EQ(part.image().value(channel, x, y), whole.image().value(full, x + crop.x0, y + crop.y0))
                    << channel.name << " " << x << "," << y;
            }
        }
    }
}

TEST(Invariance, ScalingSceneAndCameraByAPowerOfTwoChangesNothing) {
    const Drawing unit(heap(3), perspective_camera(kEye, {0, 0, 0}), 120, 90);
    for (const double scale : {0x1p-40, 0x1p-3, 0x1p20, 0x1p60}) {
        const Drawing scaled(heap(3, scale), perspective_camera(kEye * scale, {0, 0, 0}), 120, 90);
        EXPECT_EQ(unit.coverage(), scaled.coverage()) << scale;
    }
}

TEST(Invariance, ScalingByAnyFactorChangesNextToNothing) {
    const Drawing unit(heap(4), perspective_camera(kEye, {0, 0, 0}), 120, 90);
    for (const double scale : {1e-12, 0.037, 1e12}) {
        const Drawing scaled(heap(4, scale), perspective_camera(kEye * scale, {0, 0, 0}), 120, 90);
        double difference = 0, total = 0;
        const auto a = unit.coverage(), b = scaled.coverage();
        for (std::size_t i = 0; i < a.size(); ++i) {
            difference += std::abs(a[i] - b[i]);
            total += a[i];
        }
        EXPECT_LT(difference, 0.01 * total) << scale << ": rounding may move a corner by 1/256 pixel";
    }
}

/// Objects from random triangles with corners on a coarse grid of 1/256 pixels, in pixel units.
std::vector<PolygonSoup> pixel_heap(std::uint64_t seed, int width, int height) {
    Random random(seed);
    std::vector<PolygonSoup> objects;
    for (int o = 0; o < 4; ++o) {
        PolygonSoup soup;
        for (int i = 0; i < 8; ++i) {
            std::vector<std::uint32_t> corners;
            for (int k = 0; k < 3; ++k) {
                corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
                soup.positions.emplace_back(
                    (random.integer(5, width - 6) * 256 + 17 + 2 * random.integer(0, 100)) / 256.0,
                    (random.integer(5, height - 6) * 256 + 17 + 2 * random.integer(0, 100)) / 256.0,
                    random.integer(-64, 64) / 2.0);
            }
            soup.add_polygon(corners);
        }
        objects.push_back(soup);
    }
    return objects;
}

TEST(Invariance, MovingByWholePixelsMovesThePicture) {
    constexpr int kWidth = 90, kHeight = 70, kDx = 11, kDy = 7;
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const auto objects = pixel_heap(seed, kWidth - kDx, kHeight - kDy);
        auto moved = objects;
        for (auto& soup : moved) soup = transformed(soup, [](glm::dvec3 p) { return p + glm::dvec3(kDx, -kDy, 0); });
        const auto lifted = [&](std::vector<PolygonSoup> list) {
            for (auto& soup : list) soup = transformed(soup, [](glm::dvec3 p) { return p + glm::dvec3(0, kDy, 0); });
            return list;
        };
        const Drawing here(scene_of(lifted(objects)), pixel_camera(kWidth, kHeight), kWidth, kHeight);
        const Drawing there(scene_of(lifted(moved)), pixel_camera(kWidth, kHeight), kWidth, kHeight);
        for (int y = 0; y + kDy < kHeight; ++y) {
            for (int x = 0; x + kDx < kWidth; ++x) {
                ASSERT_EQ(here.line(x, y), there.line(x + kDx, y + kDy)) << "seed " << seed << ": " << x << "," << y;
            }
        }
    }
}

TEST(Invariance, MirroringMirrorsThePicture) {
    // Corners lie on odd multiples of 1/256 pixel, so that no edge passes exactly through a sample and
    // the top-left rule, which is not symmetric, never decides.
    constexpr int kWidth = 80, kHeight = 60;
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const auto objects = pixel_heap(seed, kWidth, kHeight);
        auto mirrored = objects;
        for (auto& soup : mirrored)
            soup = transformed(soup, [](glm::dvec3 p) { return glm::dvec3(kWidth - p.x, p.y, p.z); });
        const Drawing a(scene_of(objects), pixel_camera(kWidth, kHeight), kWidth, kHeight);
        const Drawing b(scene_of(mirrored), pixel_camera(kWidth, kHeight), kWidth, kHeight);
        double difference = 0, total = 0;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                difference += std::abs(a.line(x, y) - b.line(kWidth - 1 - x, y));
                total += a.line(x, y);
            }
        }
        EXPECT_LT(difference, 0.005 * total) << "seed " << seed;
    }
}

TEST(Invariance, TheOrderOfPolygonsChangesNoLine) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        PolygonSoup soup = transformed(make_torus(0.7, 0.25, 24, 12), [](glm::dvec3 p) { return p; });
        const PolygonSoup box = make_box({1, 0.4, 1});
        for (std::size_t i = 0; i < box.polygon_count(); ++i) {
            std::vector<std::uint32_t> corners;
            for (const std::uint32_t v : box.polygon(i))
                corners.push_back(v + static_cast<std::uint32_t>(soup.positions.size()));
            soup.add_polygon(corners);
        }
        for (const glm::dvec3& p : box.positions) soup.positions.push_back(p);
        // Fix the offsets that were made before the positions were added.
        PolygonSoup shuffled;
        shuffled.positions = soup.positions;
        std::vector<std::size_t> order(soup.polygon_count());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        Random random(seed);
        for (std::size_t i = order.size() - 1; i > 0; --i)
            std::swap(order[i], order[static_cast<std::size_t>(random.integer(0, static_cast<int>(i)))]);
        for (const std::size_t i : order) {
            const auto polygon = soup.polygon(i);
            shuffled.add_polygon(polygon);
        }
        const Camera camera = perspective_camera(kEye, {0, 0, 0});
        const Drawing a(scene_of({soup}), camera, 140, 100), b(scene_of({shuffled}), camera, 140, 100);
        EXPECT_EQ(a.coverage(), b.coverage()) << "seed " << seed;
    }
}

TEST(Invariance, CuttingAFaceWithoutANewPolygonAddsNoLine) {
    // A quadrilateral, and the same with a fifth corner in the middle of a side.
    const PolygonSoup quad =
        soup_of({{20.1, 20.1, 0}, {80.1, 22.1, 10}, {78.1, 81.1, 20}, {21.1, 77.1, 10}}, {{0, 1, 2, 3}});
    PolygonSoup five = quad;
    five.positions.push_back(0.5 * (quad.positions[0] + quad.positions[1]));
    five.corners = {0, 4, 1, 2, 3};
    five.polygon_ends = {5};
    Scene a = scene_of({quad}), b = scene_of({five});
    a.lines.classes = b.lines.classes = LineClassSet::all();
    const Drawing da(a, pixel_camera(100, 100), 100, 100), db(b, pixel_camera(100, 100), 100, 100);
    EXPECT_EQ(da.sum(LineClass::polygon), 0);
    EXPECT_EQ(db.sum(LineClass::polygon), 0);
    for (int y = 26; y < 74; ++y) {
        for (int x = 26; x < 74; ++x) ASSERT_EQ(db.line(x, y), 0) << x << "," << y;
    }
}

TEST(Extremes, ATriangleThroughTheEyePlaneIsDrawnUpToTheHorizon) {
    // A floor from far in front of the eye to far behind it: everything below the horizon is covered.
    const PolygonSoup floor = soup_of({{-1e4, 0, -1e4}, {1e4, 0, -1e4}, {1e4, 0, 1e4}, {-1e4, 0, 1e4}}, {{0, 1, 2, 3}});
    const Drawing d(scene_of({floor}), perspective_camera({0, 10, 0}, {0, 10, -1}), 80, 60);
    for (int x = 0; x < 80; ++x) {
        for (int y = 33; y < 60; ++y) {
            ASSERT_EQ(d.at("id.object", x, y), 1) << x << "," << y;
            ASSERT_EQ(d.line(x, y), 0) << x << "," << y;
        }
        for (int y = 0; y < 28; ++y) ASSERT_EQ(d.at("id.object", x, y), 0) << x << "," << y;
    }
}

TEST(Extremes, DepthAndNormalAreThoseOfTheSurface) {
    const PolygonSoup floor = make_plane(40, 40, 1, 1);
    const Camera camera = perspective_camera({0, 5, 15}, {0, 0, 0});
    const Drawing d(scene_of({floor}), camera, 80, 60);
    const glm::dmat4 view = camera.to_view();
    const Projection p = camera.projection(80, 60, 1e-6);
    int checked = 0;
    for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 80; ++x) {
            if (d.at("id.object", x, y) == 0) continue;
            glm::dvec3 origin, ray;
            p.view_ray({x + 0.5, y + 0.5}, origin, ray);
            // The ray meets the plane y = 0 of the world at distance t.
            const glm::dvec3 normal = glm::dmat3(view) * glm::dvec3(0, 1, 0);
            const glm::dvec3 on_plane(view * glm::dvec4(0, 0, 0, 1));
            const double t = glm::dot(normal, on_plane) / glm::dot(normal, ray);
            if (std::abs(t) > 30) continue;
            ASSERT_NEAR(d.at("Z", x, y), t, 0.02 * t) << x << "," << y;
            ASSERT_NEAR(d.at("N.Y", x, y), 1, 1e-6);
            ++checked;
        }
    }
    EXPECT_GT(checked, 500);
}

TEST(Extremes, AnEmptyViewIsBackground) {
    const Drawing d(scene_of({make_box({1, 1, 1})}), perspective_camera({0, 0, 5}, {0, 0, 10}), 40, 30);
    EXPECT_EQ(d.sum("A"), 0);
    EXPECT_EQ(d.sum("lines.A"), 0);
    EXPECT_TRUE(std::isinf(d.at("Z", 20, 15)));
}

}  // namespace
}  // namespace burin::invariance_test
