// Contours of smooth surfaces along interpolated normals: where they are, that they are there once, and what
// is left alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "lines/corner_normals.h"
#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "tests/support/drawing.h"

namespace burin {
namespace {

using namespace test;

constexpr int kSize = 240;

Scene smooth_scene(PolygonSoup soup, Contours contours = Contours::smooth) {
    Scene scene = scene_of({std::move(soup)});
    scene.lines.contours = contours;
    return scene;
}

Drawing drawing_of(const Scene& scene, glm::dvec3 eye, glm::dvec3 target = {0, 0, 0},
                   PixelRect crop = {0, 0, kSize, kSize}, int threads = 2) {
    return Drawing(scene, perspective_camera(eye, target), kSize, kSize, crop, threads, render_abuffer);
}

TEST(CornerNormals, OfASphereAreRadial) {
    const Scene scene = scene_of({make_sphere(0.5, 24, 12)});
    const Mesh& mesh = scene.meshes[0];
    const SmoothMesh smooth = make_smooth(mesh, std::cos(40 * std::numbers::pi / 180));
    for (HalfEdge c = 0; c < smooth.normals.size(); ++c) {
        const glm::dvec3 p(mesh.position(mesh.triangles[c / 3][c % 3]));
        EXPECT_GT(std::abs(glm::dot(glm::dvec3(smooth.normals[c]), p / glm::length(p))), 0.9995);
        EXPECT_FALSE(smooth.is_sharp(c));
    }
}

TEST(CornerNormals, EndAtCreases) {
    const Scene scene = scene_of({make_box({1, 2, 3})});
    const SmoothMesh smooth = make_smooth(scene.meshes[0], std::cos(40 * std::numbers::pi / 180));
    for (const glm::vec3& n : smooth.normals)
        EXPECT_NEAR(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1, 1e-6);
}

/// Some of the polygons, `seed` says which, are wound the other way. They keep their first corner.
PolygonSoup some_turned(const PolygonSoup& soup, unsigned seed) {
    PolygonSoup result;
    result.positions = soup.positions;
    result.object_names = soup.object_names;
    std::mt19937 random(seed);
    for (std::size_t p = 0; p < soup.polygon_count(); ++p) {
        std::vector<std::uint32_t> polygon(soup.polygon(p).begin(), soup.polygon(p).end());
        if (p > 0 && random() % 2 == 0) std::reverse(polygon.begin() + 1, polygon.end());
        result.add_polygon(polygon);
    }
    return result;
}

TEST(CornerNormals, AreOnOneSideHoweverTrianglesAreWound) {
    const double cosine = std::cos(40 * std::numbers::pi / 180);
    const SmoothMesh alike = make_smooth(scene_of({make_sphere(0.5, 24, 12)}).meshes[0], cosine);
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Scene scene = scene_of({some_turned(make_sphere(0.5, 24, 12), seed)});
        const Mesh& mesh = scene.meshes[0];
        const SmoothMesh turned = make_smooth(mesh, cosine);
        EXPECT_EQ(turned.sharp, alike.sharp);
        for (HalfEdge c = 0; c < turned.normals.size(); ++c) {
            const glm::dvec3 p(mesh.position(mesh.triangles[c / 3][c % 3]));
            EXPECT_GT(glm::dot(glm::dvec3(turned.normals[c]), p / glm::length(p)), 0.9995);
        }
    }
}

/// A strip around an axis that turns by some half turns on its way.
PolygonSoup twisted_strip(std::uint32_t steps, int half_turns) {
    PolygonSoup soup;
    soup.object_names = {"strip"};
    for (std::uint32_t i = 0; i < steps; ++i) {
        const double along = 2 * std::numbers::pi * i / steps, turn = 0.5 * half_turns * along;
        for (const double side : {-0.2, 0.2}) {
            const double r = 1 + side * std::cos(turn);
            soup.positions.push_back({r * std::cos(along), side * std::sin(turn), r * std::sin(along)});
        }
    }
    for (std::uint32_t i = 0; i < steps; ++i) {
        const std::uint32_t next = 2 * ((i + 1) % steps), crosses = i + 1 == steps && half_turns % 2 != 0 ? 1 : 0;
        soup.add_polygon(std::vector<std::uint32_t>{2 * i, next + crosses, next + 1 - crosses});
        soup.add_polygon(std::vector<std::uint32_t>{2 * i, next + 1 - crosses, 2 * i + 1});
    }
    return soup;
}

TEST(CornerNormals, OfASurfaceWithOneSideTurnOverAtOneEdge) {
    constexpr std::uint32_t kSteps = 60;
    const auto sharp_edges = [](const PolygonSoup& soup) {
        std::uint32_t count = 0;
        const SmoothMesh smooth = make_smooth(scene_of({soup}).meshes[0], 0.76);
        for (HalfEdge h = 0; h < smooth.normals.size(); ++h) count += smooth.is_sharp(h) ? 1 : 0;
        return count;
    };
    for (unsigned seed = 0; seed < 20; ++seed) {
        EXPECT_EQ(sharp_edges(some_turned(twisted_strip(kSteps, 2), seed)), 2 * kSteps);
        EXPECT_EQ(sharp_edges(some_turned(twisted_strip(kSteps, 1), seed)), 2 * kSteps + 2);
    }
}

/// How much line there is across a circle around the picture's middle, and where: mean distance from the
/// middle, in equal steps around it.
struct Across {
    double width_px, radius_px;
};
std::vector<Across> across_circle(const Drawing& drawing, int steps) {
    std::vector<Across> result;
    for (int i = 0; i < steps; ++i) {
        const double a = 2 * std::numbers::pi * i / steps;
        double sum = 0, moment = 0;
        for (double r = 0; r < 0.5 * kSize - 1; r += 0.125) {
            const glm::dvec2 p = glm::dvec2(kSize * 0.5) + r * glm::dvec2(std::cos(a), std::sin(a));
            const double ink = 0.125 * drawing.line(static_cast<int>(p.x), static_cast<int>(p.y));
            sum += ink;
            moment += r * ink;
        }
        result.push_back({sum, sum > 0 ? moment / sum : 0});
    }
    return result;
}

TEST(SmoothContours, OfACoarseSphereAreOneCircle) {
    const double sine = 0.25, focal_px = 0.5 * kSize / std::tan(17.5 * std::numbers::pi / 180);
    const double radius_px = focal_px * sine / std::sqrt(1 - sine * sine);
    // Chords of a polygon with that many corners are so far within its circle.
    const double sagitta_px = radius_px * (1 - std::cos(std::numbers::pi / 16));
    for (const glm::dvec3 eye :
         {glm::dvec3(0, 0, 2), glm::dvec3(1.1, 0.9, std::sqrt(4 - 1.21 - 0.81)), glm::dvec3(0.3, 1.7, 1.01)}) {
        const glm::dvec3 at = eye * (2 / glm::length(eye));
        Scene scene = smooth_scene(make_sphere(0.5, 16, 8));
        scene.lines.style.width_px = 2;
        const Drawing drawing = drawing_of(scene, at);
        for (const Across& a : across_circle(drawing, 360)) {
            EXPECT_GT(a.width_px, 1.5);  // no gap
            EXPECT_LT(a.width_px, 2.8);  // nothing twice, no hook
            EXPECT_LT(a.radius_px, radius_px + 0.3);
            EXPECT_GT(a.radius_px, radius_px - 2 * sagitta_px - 0.3);
        }
    }
}

TEST(SmoothContours, LeaveFlatSidesAlone) {
    const glm::dvec3 eye(1.9, 1.4, 3.1);
    const Drawing smooth = drawing_of(smooth_scene(make_box({1, 1, 1})), eye);
    const Drawing mesh = drawing_of(smooth_scene(make_box({1, 1, 1}), Contours::mesh), eye);
    EXPECT_TRUE(same_bits(smooth.image(), mesh.image()));
}

TEST(SmoothContours, LeaveTheTipOfAConeAlone) {
    const glm::dvec3 eye(1.2, 0.8, 2.6);
    const Drawing smooth = drawing_of(smooth_scene(make_cylinder(0.5, 0, 1, 40)), eye);
    const Drawing mesh = drawing_of(smooth_scene(make_cylinder(0.5, 0, 1, 40), Contours::mesh), eye);
    EXPECT_TRUE(same_bits(smooth.image(), mesh.image()));
}

TEST(SmoothContours, DoNotHangOnWinding) {
    for (const PolygonSoup& soup : {make_sphere(0.5, 16, 8), make_torus(0.5, 0.2, 24, 12)}) {
        const Drawing alike = drawing_of(smooth_scene(soup), {1.1, 0.9, 1.4});
        for (unsigned seed = 0; seed < 4; ++seed) {
            const Drawing turned = drawing_of(smooth_scene(some_turned(soup, seed)), {1.1, 0.9, 1.4});
            EXPECT_EQ(turned.coverage(), alike.coverage());
        }
    }
}

/// Share of the line in a picture that is further than this from all line of another.
double stray_share(const Drawing& lines, const Drawing& others, int reach_px) {
    double all = 0, stray = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const double ink = lines.line(x, y);
            if (ink == 0) continue;
            double near = 0;
            for (int v = std::max(0, y - reach_px); v <= std::min(kSize - 1, y + reach_px); ++v) {
                for (int u = std::max(0, x - reach_px); u <= std::min(kSize - 1, x + reach_px); ++u) {
                    near = std::max(near, others.line(u, v));
                }
            }
            all += ink;
            stray += near < 0.1 ? ink : 0;
        }
    }
    return stray / all;
}

TEST(SmoothContours, OfATeapotAreThoseOfAFineOne) {
    const auto teapot = [](int tessellation, Contours contours) {
        Scene scene = smooth_scene(make_teapot(tessellation), contours);
        scene.lines.classes = LineClass::silhouette;
        return Drawing(scene, perspective_camera({6, 5, 4.5}, {1.8, 1.6, 0.2}, 22), kSize, kSize, {0, 0, kSize, kSize},
                       2, render_abuffer);
    };
    const Drawing fine = teapot(48, Contours::mesh);
    const Drawing mesh = teapot(10, Contours::mesh), smooth = teapot(10, Contours::smooth);
    const double mesh_stray = stray_share(mesh, fine, 2), smooth_stray = stray_share(smooth, fine, 2);
    RecordProperty("mesh_stray", std::to_string(mesh_stray));
    RecordProperty("smooth_stray", std::to_string(smooth_stray));
    EXPECT_LT(smooth_stray, 0.5 * mesh_stray);
    EXPECT_LT(smooth_stray, 0.03);
    EXPECT_LT(stray_share(fine, smooth, 3), 0.05);  // nothing is missing
}

TEST(SmoothContours, DependOnThePictureOnly) {
    const Scene scene = smooth_scene(make_torus(0.6, 0.25, 24, 12));
    const glm::dvec3 eye(0.4, 1.6, 2.1);
    const Drawing whole = drawing_of(scene, eye);
    EXPECT_TRUE(same_bits(whole.image(), drawing_of(scene, eye, {0, 0, 0}, {0, 0, kSize, kSize}, 7).image()));
    const PixelRect crop{71, 60, 133, 122};
    const Drawing part = drawing_of(scene, eye, {0, 0, 0}, crop);
    for (int y = crop.y0; y < crop.y1; ++y) {
        for (int x = crop.x0; x < crop.x1; ++x) ASSERT_EQ(part.line(x - crop.x0, y - crop.y0), whole.line(x, y));
    }
    PolygonSoup soup = make_torus(0.6, 0.25, 24, 12), turned;
    turned.positions = soup.positions;
    for (std::size_t p = soup.polygon_count(); p-- > 0;) turned.add_polygon(soup.polygon(p));
    turned.object_names = soup.object_names;
    EXPECT_EQ(whole.coverage(), drawing_of(smooth_scene(turned), eye).coverage());
}

}  // namespace
}  // namespace burin
