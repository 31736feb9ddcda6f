// The z-buffer machine itself: fills, vectors, stored depth, passes.

#include <map>

#include "methods/zbuffer/fill_raster.h"
#include "methods/zbuffer/vector_generator.h"
#include "tests/methods/zbuffer_support.h"
#include "tests/support/random.h"

namespace burin::zbuffer_machine_test {
namespace {

using namespace test;

constexpr PixelRect kRect{0, 0, 40, 30};

ProjectedTriangle triangle(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return {{ProjectedCorner{a, 0.1, 1}, ProjectedCorner{b, 0.5, 1}, ProjectedCorner{c, 0.9, 1}}, {0, 0}};
}

TEST(Fill, CoversEachPixelOnceWhereTrianglesMeet) {
    // Grids of jittered points, many of them on pixel centres, where ties are decided.
    for (std::uint64_t trial = 0; trial < 60; ++trial) {
        Random random(trial);
        std::map<std::pair<int, int>, glm::dvec2> points;
        for (int i = 0; i <= 4; ++i) {
            for (int j = 0; j <= 3; ++j) {
                glm::dvec2 p(i * 10, j * 10);
                if (i > 0 && i < 4) p.x += random.integer(-4, 4) * 0.5;
                if (j > 0 && j < 3) p.y += random.integer(-4, 4) * 0.5;
                if (random.integer(0, 1) && i > 0 && i < 4 && j > 0 && j < 3)
                    p += glm::dvec2(random.real(-0.5, 0.5), random.real(-0.5, 0.5));
                points[{i, j}] = p;
            }
        }
        std::vector<int> covered(static_cast<std::size_t>(kRect.width() * kRect.height()));
        const auto count = [&](int x, int y, double z) {
            ++covered[static_cast<std::size_t>(y * kRect.width() + x)];
            ASSERT_GE(z, 0.1);
            ASSERT_LE(z, 0.9);
        };
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 3; ++j) {
                const glm::dvec2 a = points[{i, j}], b = points[{i + 1, j}], c = points[{i + 1, j + 1}],
                                 d = points[{i, j + 1}];
                for_each_fragment(triangle(a, b, c), kRect, count);
                for_each_fragment(random.integer(0, 1) ? triangle(a, c, d) : triangle(d, c, a), kRect, count);
            }
        }
        for (const int n : covered) ASSERT_EQ(n, 1) << trial;
    }
}

TEST(Fill, ZIsThatOfThePlaneAtTheCentre) {
    const ProjectedTriangle t{{ProjectedCorner{{1.3, 2.1}, 0.2, 1}, ProjectedCorner{{37.4, 5.2}, 0.7, 1},
                               ProjectedCorner{{12.6, 28.3}, 0.4, 1}},
                              {0, 0}};
    const ZPlane plane(t);
    for (const ProjectedCorner& c : t.corners) EXPECT_NEAR(plane.at(c.pixel), c.z, 1e-15);
    int fragments = 0;
    for_each_fragment(t, kRect, [&](int x, int y, double z) {
        ++fragments;
        EXPECT_EQ(z, plane.at({x + 0.5, y + 0.5}));
    });
    EXPECT_NEAR(fragments, 0.5 * std::abs((36.1 * 26.2) - (3.1 * 11.3)), 12);
}

TEST(Vector, HasOnePixelPerStepOfTheMajorAxis) {
    for (std::uint64_t trial = 0; trial < 300; ++trial) {
        Random random(trial);
        const ProjectedCorner a{{random.real(1, 39), random.real(1, 29)}, random.real(0, 1), 1};
        const ProjectedCorner b{{random.real(1, 39), random.real(1, 29)}, random.real(0, 1), 1};
        const glm::dvec2 d = b.pixel - a.pixel;
        const int major = std::abs(d.x) >= std::abs(d.y) ? 0 : 1;
        std::map<int, glm::ivec2> by_step;
        for_each_vector_pixel(a, b, 1, kRect, [&](int x, int y, double z) {
            const glm::ivec2 pixel(x, y);
            EXPECT_TRUE(by_step.emplace(pixel[major], pixel).second) << "one pixel per step";
            const double t = (pixel[major] + 0.5 - a.pixel[major]) / d[major];
            EXPECT_NEAR(z, a.z + t * (b.z - a.z), 1e-12) << "z of the line, not of the pixel";
            const double minor = a.pixel[1 - major] + t * d[1 - major];
            EXPECT_NEAR(minor, pixel[1 - major] + 0.5, 0.5);
        });
        const double low = std::min(a.pixel[major], b.pixel[major]), high = std::max(a.pixel[major], b.pixel[major]);
        EXPECT_EQ(by_step.size(), static_cast<std::size_t>(std::ceil(high - 0.5) - std::ceil(low - 0.5))) << trial;
    }
}

TEST(Vector, IsTheSameInAnyRectangle) {
    for (std::uint64_t trial = 0; trial < 200; ++trial) {
        Random random(trial);
        const ProjectedCorner a{{random.real(-60, 100), random.real(-60, 90)}, 0.1, 1};
        const ProjectedCorner b{{random.real(-60, 100), random.real(-60, 90)}, 0.8, 1};
        const int width = random.integer(1, 4);
        using Pixels = std::map<std::pair<int, int>, double>;
        const auto pixels_in = [&](std::initializer_list<PixelRect> rects) {
            Pixels pixels;
            for (const PixelRect& r : rects) {
                for_each_vector_pixel(a, b, width, r, [&](int x, int y, double z) {
                    EXPECT_TRUE(x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1);
                    pixels[{x, y}] = z;
                });
            }
            return pixels;
        };
        EXPECT_EQ(pixels_in({kRect}), pixels_in({{0, 0, 13, 11}, {13, 0, 40, 11}, {0, 11, 13, 30}, {13, 11, 40, 30}}));
    }
}

TEST(Vector, TiesDependOnTheDirection) {
    const ProjectedCorner a{{2.5, 4}, 0, 1}, b{{22.5, 14}, 1, 1};
    std::map<int, int> there, back;
    for_each_vector_pixel(a, b, 1, kRect, [&](int x, int y, double) { there[x] = y; });
    for_each_vector_pixel(b, a, 1, kRect, [&](int x, int y, double) { back[x] = y; });
    int differ = 0;
    for (int x = 3; x < 22; ++x) {
        const bool tie = x % 2 == 0;
        EXPECT_EQ(there[x] - back[x], tie ? 1 : 0) << x;
        differ += tie;
    }
    EXPECT_EQ(differ, 9);
    EXPECT_TRUE(there.contains(2) && !there.contains(22)) << "the first end belongs to it, the last does not";
    EXPECT_TRUE(back.contains(22) && !back.contains(2));
}

/// All sweeps of a method over the whole picture of a scene, on one machine.
struct Machine {
    Frame frame;
    FeatureEdges features;
    ZBuffer zbuffer;

    Machine(const MinimalScene& s, const ZBufferMethod& method)
        : frame(make_frame(s.scene, s.camera, s.size_px, s.size_px, {0, 0, s.size_px, s.size_px})),
          features(frame, 1),
          zbuffer(frame) {
        const auto range = *s.scene.zbuffer.depth_range;
        const DepthRange depth = DepthRange::between(range[0], range[1], true);
        zbuffer.clear(frame.crop, method.initial_bit);
        for (const auto& sweep : method.sweeps) {
            for (std::uint32_t i = 0; i < frame.surfaces.instances.size(); ++i) {
                for (std::uint32_t p = 0; p < frame.surfaces.instances[i].mesh->polygon_count; ++p) {
                    ProjectedPolygon polygon;
                    project_polygon(frame, features, depth, i, p, polygon);
                    sweep(zbuffer, polygon);
                }
            }
        }
    }
};

template <typename Visit>
void for_all_pixels(const Visit& visit) {
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) visit(x, y);
    }
}

TEST(EdgingPlane, IsZeroBetweenPolygonsAndZIsThatOfTheLine) {
    const MinimalScene s = scene_hilite();
    for (const auto& method : {edging_plane_method(s.scene.zbuffer), stencil_method(s.scene.zbuffer)}) {
        const Machine m(s, method);
        for_all_pixels([&](int x, int y) { ASSERT_FALSE(m.zbuffer.bit(x, y)); });
        const ScreenSegment& line = s.lines[0];
        for (const glm::ivec2 p : pixels_along(line)) {
            const double t = (p.x + 0.5 - line.a.x) / (line.b.x - line.a.x);
            const double z = (line.za + t * (line.zb - line.za)) * (std::exp2(24) - 1);
            ASSERT_NEAR(m.zbuffer.depth(p.x, p.y), z, 2);
        }
    }
}

TEST(Decal, ZIsTheNearerOfLineAndFill) {
    const MinimalScene s = scene_hilite();
    const Machine decal(s, decal_method(s.scene.zbuffer)), fill(s, simple_method(s.scene.zbuffer)),
        plane(s, edging_plane_method(s.scene.zbuffer));
    int nearer_fill = 0;
    for (const glm::ivec2 p : pixels_along(s.lines[0])) {
        const double line_z = plane.zbuffer.depth(p.x, p.y), z = decal.zbuffer.depth(p.x, p.y);
        EXPECT_EQ(z, std::min(line_z, fill.zbuffer.depth(p.x, p.y)));
        nearer_fill += z < line_z;
    }
    EXPECT_GT(nearer_fill, 50);
}

TEST(VirginPlane, IsClearExactlyWhereSomethingWasDrawn) {
    const MinimalScene s = scene_three_layers();
    const Machine m(s, virgin_plane_method(s.scene.zbuffer));
    for_all_pixels([&](int x, int y) {
        const FramePixel& pixel = m.zbuffer.frame(x, y);
        const bool drawn = !pixel.surface.is_background() || pixel.line != 0;
        ASSERT_EQ(m.zbuffer.bit(x, y), !drawn) << x << "," << y;
    });
}

TEST(VirginPlane, DiffersFromTheEdgingPlaneOnlyInZWhereTwoEdgesMeet) {
    for (const double b : {1e-3, -3e-3}) {
        const MinimalScene s = scene_half_slope(b, true);
        const Machine virgin(s, virgin_plane_method(s.scene.zbuffer)), plane(s, edging_plane_method(s.scene.zbuffer));
        // How many of the polygon's edges have a pixel in common.
        ProjectedPolygon polygon;
        const auto range = *s.scene.zbuffer.depth_range;
        project_polygon(plane.frame, plane.features, DepthRange::between(range[0], range[1], true), 0, 0, polygon);
        std::map<std::pair<int, int>, int> hits;
        for (const ProjectedEdge& e : polygon.edges) {
            for_each_vector_pixel(e.from, e.to, 1, {0, 0, 256, 256}, [&](int x, int y, double) { ++hits[{x, y}]; });
        }
        for_all_pixels([&](int x, int y) {
            ASSERT_EQ(virgin.zbuffer.frame(x, y).line != 0, plane.zbuffer.frame(x, y).line != 0) << x << "," << y;
            ASSERT_EQ(virgin.zbuffer.frame(x, y).surface, plane.zbuffer.frame(x, y).surface) << x << "," << y;
            const auto hit = hits.find({x, y});
            if (hit != hits.end() && hit->second > 1) return;
            ASSERT_EQ(virgin.zbuffer.depth(x, y), plane.zbuffer.depth(x, y)) << x << "," << y;
        });
    }
}

TEST(DepthFormats, HaveTheirSteps) {
    MinimalScene s = scene_half_slope(1e-3, true);
    for (const int bits : {16, 24, 32, 64}) {
        s.scene.zbuffer.depth_bits = bits;
        const Machine m(s, simple_method(s.scene.zbuffer));
        for_all_pixels([&](int x, int y) {
            const double z = m.zbuffer.depth(x, y);
            if (bits <= 24) {
                ASSERT_EQ(z, std::floor(z));
                ASSERT_LE(z, std::exp2(bits) - 1);
            } else if (bits == 32) {
                ASSERT_EQ(z, static_cast<double>(static_cast<float>(z)));
            }
        });
        EXPECT_EQ(m.zbuffer.depth(2, 2), bits <= 24 ? std::exp2(bits) - 1 : 1) << "cleared to the far end";
    }
}

TEST(DepthRange, IsAffineOnTheScreenAndItsOwnInverse) {
    for (const bool orthographic : {true, false}) {
        const DepthRange range = DepthRange::between(2, 50, orthographic);
        EXPECT_NEAR(range.z(2), 0, 1e-15);
        EXPECT_NEAR(range.z(50), 1, 1e-15);
        for (const double d : {2.0, 3.7, 20.0, 49.0}) EXPECT_NEAR(range.distance(range.z(d)), d, 1e-12 * d * d);
    }
    // A fitted range holds all vertices.
    const Scene scene = scene_of({soup_of({{-1, 0, 0}, {1, 0, 0}, {0, 1, -3}}, {{0, 1, 2}})});
    const Frame frame = make_frame(scene, perspective_camera({0, 0, 5}, {0, 0, 0}), 64, 64, {0, 0, 64, 64});
    const DepthRange fitted = DepthRange::fitted(frame);
    EXPECT_NEAR(fitted.z(5), 0, 0.01);
    EXPECT_GT(fitted.z(5), 0);
    EXPECT_NEAR(fitted.z(8), 1, 0.01);
    EXPECT_LT(fitted.z(8), 1);
}

}  // namespace
}  // namespace burin::zbuffer_machine_test
