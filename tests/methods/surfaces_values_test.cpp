// Curvature and the values of files at places on surfaces, against what analysis says of squares and balls.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "methods/abuffer.h"
#include "methods/reference/reference.h"
#include "tests/scene/scene_text.h"
#include "tests/support/drawing.h"

namespace burin {
namespace {

using namespace test;

constexpr int kSide = 120;

/// A square whose texture coordinates, colours and numbers are affine in x and y, from -1 to 1, and z = 0.
constexpr const char* kSquareObj =
    "v -1 -1 0 0 0 1\nv 1 -1 0 1 0 0\nv 1 1 0 1 1 0\nv -1 1 0 0 1 1\nvt 0 0\nvt 3 0\nvt 3 5\nvt 0 5\n"
    "f 1/1 2/2 3/3 4/4\n";
constexpr const char* kSquarePly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property float heat\nproperty float load\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "-1 -1 0 0 1\n1 -1 0 2 1\n1 1 0 2 5\n-1 1 0 0 5\n4 0 1 2 3\n";

Scene scene_with_file(const std::string& name, const std::string& content, const std::string& surfaces,
                      const std::string& more = {}) {
    const TemporaryFolder folder;
    const std::string file = folder.write(name, content);
    return loaded("[lines]\ndraw = \"none\"\n[surfaces]\n" + surfaces + "\n[[object]]\nfile = \"" + file +
                  "\"\nname = \"square\"\n" + more);
}

Drawing seen(const Scene& scene, const Camera& camera, int threads = 2, RenderFunction render = render_abuffer) {
    return Drawing(scene, camera, kSide, kSide, {0, 0, kSide, kSide}, threads, render);
}

/// Where the ray through a pixel's centre meets the plane z = 0.
glm::dvec2 met_at(const Camera& camera, double fov_deg, int x, int y) {
    const double focal_px = 0.5 * kSide / std::tan(glm::radians(0.5 * fov_deg));
    const glm::dvec3 way((x + 0.5 - 0.5 * kSide) / focal_px, -(y + 0.5 - 0.5 * kSide) / focal_px, -1);
    const glm::dvec3 eye(camera.to_world[3]), ray = glm::dmat3(camera.to_world) * way;
    return glm::dvec2(eye - ray * (eye.z / ray.z));
}

TEST(SurfaceFileValues, FollowThePerspective) {
    const Camera camera = perspective_camera({0.6, -1.9, 0.8}, {0, -0.2, 0}, 50);
    const Scene uv = scene_with_file("a.obj", kSquareObj, "color = \"=rgb(u/3, v/5, 0)\"");
    const Scene colors = scene_with_file("a.obj", kSquareObj, "color = \"=Cv\"");
    const Scene numbers =
        scene_with_file("a.ply", kSquarePly, "color = '=rgb(attr(\"heat\")/2, (attr(\"load\") - 1)/4, 0)'");
    for (const RenderFunction render : {render_abuffer, render_reference}) {
        const Drawing of_uv = seen(uv, camera, 2, render), of_colors = seen(colors, camera, 2, render),
                      of_numbers = seen(numbers, camera, 2, render);
        int count = 0;
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                const glm::dvec2 p = met_at(camera, 50, x, y);
                if (!(std::max(std::abs(p.x), std::abs(p.y)) < 0.94)) continue;
                ++count;
                for (const Drawing* const drawing : {&of_uv, &of_colors, &of_numbers}) {
                    ASSERT_NEAR(drawing->at("R", x, y), 0.5 + 0.5 * p.x, 2e-3) << x << ' ' << y;
                    ASSERT_NEAR(drawing->at("G", x, y), 0.5 + 0.5 * p.y, 2e-3) << x << ' ' << y;
                }
                ASSERT_NEAR(of_colors.at("B", x, y), 0.5 - 0.5 * p.x, 2e-3);
            }
        }
        EXPECT_GT(count, 2000);
    }
}

TEST(SurfaceFileValues, EachPolygonHasItsOwnAtASeam) {
    const Scene scene = scene_with_file("a.obj",
                                        "v 0 0 0\nv 60 0 0\nv 60 120 0\nv 0 120 0\nv 120 0 0\nv 120 120 0\nvt 1 0\n"
                                        "vt 2 0\nf 1/1 2/1 3/1 4/1\nf 2/2 5/2 6/2 3/2\n",
                                        "color = \"=rgb(u/4, 0, 0)\"");
    const Drawing d = seen(scene, pixel_camera(kSide, kSide));
    for (int x = 0; x < kSide; ++x) EXPECT_NEAR(d.at("R", x, 40), x < 60 ? 0.25 : 0.5, 1e-6) << x;
}

TEST(SurfaceFileValues, ABallBendsByOneOverItsRadius) {
    const auto picture = [](const std::string& color, const std::string& object) {
        return seen(loaded("[lines]\ndraw = \"none\"\n[surfaces]\ncolor = \"" + color +
                           "\"\n[[object]]\nshape = \"sphere\"\nsegments = 192\nrings = 96\n" + object),
                    pixel_camera(kSide, kSide));
    };
    for (const std::string object : {"radius = 50\ntranslate = [60, 60, 0]\n",
                                     "radius = 5\nscale = [10, 10, 10]\nrotate = [20, 30, 40]\n"
                                     "translate = [60, 60, 0]\n"}) {
        const Drawing bends = picture("=rgb(25*kr, -kr, isophote(0.6)/20)", object);
        const double band_px = 0.2 * 50;  // where N · V is below 0.6
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                if (std::hypot(x + 0.5 - 60, y + 0.5 - 60) > 48) continue;
                ASSERT_NEAR(bends.at("R", x, y), 0.5, 0.005) << x << ' ' << y;
                ASSERT_EQ(bends.at("G", x, y), 0);
                ASSERT_NEAR(bends.at("B", x, y), band_px / 20, 0.005);
            }
        }
    }
    // From within, it bends towards the eye.
    const Drawing inside =
        seen(loaded("[lines]\ndraw = \"none\"\n[surfaces]\ncolor = \"=rgb(-kr, kr, 0)\"\n[[object]]\n"
                    "shape = \"sphere\"\nradius = 2\nsegments = 96\nrings = 48\n"),
             perspective_camera({0.3, 0.2, 0.1}, {1, 0, 0}));
    EXPECT_NEAR(inside.at("R", 30, 80), 0.5, 0.01);
    EXPECT_EQ(inside.at("G", 30, 80), 0);
}

TEST(SurfaceFileValues, WhatIsMissingIsZeroAndNoted) {
    const std::string ball = "[[object]]\nshape = \"sphere\"\nradius = 0.4\ntranslate = [0, 0, 1]\n";
    const Scene uv = scene_with_file("a.obj", kSquareObj, "color = \"=rgb(u, 0.5, Cv.b)\"", ball);
    EXPECT_EQ(uv.notes,
              (std::vector<std::string>{"[surfaces] reads texture coordinates (u, v), which 'sphere' has not: 0 there",
                                        "[surfaces] reads colours of vertices (Cv), which 'sphere' has not: 0 there"}));
    const Drawing d = seen(uv, perspective_camera({0, 0, 9}, {0, 0, 0}));
    EXPECT_EQ(d.at("R", 60, 60), 0);
    EXPECT_NEAR(d.at("G", 60, 60), 0.5, 1e-6);
    EXPECT_EQ(d.at("B", 60, 60), 0);
    EXPECT_GT(d.at("R", 75, 60), 1.5);
    const Scene named = scene_with_file("a.ply", kSquarePly, "color = '=rgb(attr(\"heet\"), attr(\"heat\"), 1)'");
    EXPECT_EQ(named.notes,
              std::vector<std::string>{"[surfaces] reads the vertex attribute 'heet', which 'square/a' has not: 0 "
                                       "there; the models have 'heat', 'load'"});
    EXPECT_TRUE(scene_with_file("a.obj", kSquareObj, "color = \"=rgb(kr, u, v)\"").notes.empty());
}

/// What no text of [surfaces] names is not kept.
TEST(SurfaceFileValues, OnlyWhatIsReadIsLoaded) {
    const auto layers = [](const std::string& surfaces) {
        std::string names;
        const Scene scene = scene_with_file("a.ply", kSquarePly, surfaces);
        for (const AttributeLayer& layer : scene.meshes[0].attributes) names += layer.name + ";";
        return names;
    };
    EXPECT_EQ(layers("color = \"=C\""), "");
    EXPECT_EQ(layers("color = '=rgb(attr(\"load\"), 0, 0)'"), "load;");
    EXPECT_EQ(layers("color = { over = 'attr(\"heat\")', stops = [[0, \"#ff0000\"], [2, \"#0000ff\"]] }"), "heat;");
    EXPECT_EQ(layers("shading = \"hatch\"\ntone = '=attr(\"heat\")/2'\nink = '=rgb(attr(\"load\"), 0, 0)'"),
              "heat;load;");
    EXPECT_EQ(layers("shading = \"toon\"\ndetail = { over = 'attr(\"load\")', tones = { stops = [[0, 1]] } }"),
              "load;");
}

TEST(SurfaceFileValues, AnExpressionMayReadManyNumbers) {
    std::string header, row, sum = "=rgb((0";
    for (int i = 0; i < 60; ++i) {
        header += "property float n" + std::to_string(i) + "\n";
        row += " 0.25";
        sum += " + attr(\"n" + std::to_string(i) + "\")";
    }
    std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" + header +
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (const char* const place : {"0 0 0", "240 0 0", "0 240 0"}) ply += place + row + "\n";
    const Drawing d = seen(scene_with_file("a.ply", ply + "3 0 1 2\n", "color = '" + sum + ") / 60, 0, 0)'"),
                           pixel_camera(kSide, kSide));
    EXPECT_NEAR(d.at("R", 60, 60), 0.25, 1e-4);
}

/// Lines of equal v: what a row covers depends on its v alone, and the mean is the tone, in perspective, too.
TEST(SurfaceFileValues, HatchingMayLieOnTextures) {
    const std::string hatch = "shading = \"hatch\"\nspace = \"uv\"\nangle = 0\nlevels = 1\nspacing = 12\ntone = 0.6";
    const Camera above = perspective_camera({0, 0, 4}, {0, 0, 0}, 35);
    const Drawing d = seen(scene_with_file("a.obj", kSquareObj, hatch), above);
    // 1.26 / 60 world units a pixel; v changes by 2.5 a unit: lines are 2^floor(log2(12 dv)) apart in v.
    const double dv = 2.5 * 4 * std::tan(glm::radians(17.5)) / 60, apart = std::exp2(std::floor(std::log2(12 * dv)));
    double sum = 0;
    int rows = 0, dark = 0;
    for (int y = 16; y < 104; ++y, ++rows) {
        sum += d.at("R", 60, y);
        for (const int x : {20, 45, 75, 100}) ASSERT_NEAR(d.at("R", x, y), d.at("R", 60, y), 1e-6) << x << ' ' << y;
        const double v = 2.5 * (1 + met_at(above, 35, 60, y).y), from_line = v / apart - std::round(v / apart);
        if (std::abs(from_line) * apart < 0.1 * apart && d.at("R", 60, y) < 0.2) ++dark;
        if (std::abs(from_line) < 0.02) {
            ASSERT_LT(d.at("R", 60, y), 0.2) << y;
        }
    }
    EXPECT_GT(dark, 6);
    EXPECT_NEAR(sum / rows, 0.6, 0.03);

    const Drawing slanted =
        seen(scene_with_file("a.obj", kSquareObj, hatch), perspective_camera({0.6, -1.9, 0.8}, {0, -0.2, 0}, 50));
    double mean = 0;
    int count = 0;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            if (slanted.at("A", x, y) < 1) continue;
            mean += slanted.at("R", x, y);
            ++count;
        }
    }
    EXPECT_NEAR(mean / count, 0.6, 0.03);

    // Without texture coordinates the tone is even.
    const Scene without = scene_with_file("a.ply", kSquarePly, hatch);
    EXPECT_EQ(without.notes, std::vector<std::string>{
                                 "[surfaces] reads texture coordinates (u, v), which 'square/a' has not: 0 there"});
    const Drawing even = seen(without, above);
    for (int y = 20; y < 100; ++y) ASSERT_NEAR(even.at("R", 60, y), 0.6, 1e-4);
}

TEST(SurfaceFileValues, ThreadsAndCropsChangeNothing) {
    const Scene scene = scene_with_file("a.obj", kSquareObj, "color = \"=rgb(fract(4*u), Cv.g, 0.1*kr)\"",
                                        "[[object]]\nshape = \"sphere\"\nradius = 0.4\n");
    const Camera camera = perspective_camera({0.6, -1.9, 0.8}, {0, -0.2, 0}, 50);
    const Drawing one = seen(scene, camera, 1);
    EXPECT_TRUE(same_bits(one.image(), seen(scene, camera, 3).image()));
    const Drawing part(scene, camera, kSide, kSide, {30, 40, 90, 90}, 2, render_abuffer);
    for (int y = 40; y < 90; ++y) {
        for (int x = 30; x < 90; ++x) ASSERT_EQ(part.at("R", x - 30, y - 40), one.at("R", x, y)) << x << ' ' << y;
    }
}

}  // namespace
}  // namespace burin
