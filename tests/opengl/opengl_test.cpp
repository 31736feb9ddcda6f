// Burin's versions of methods that are made for graphics hardware, against OpenGL itself: the same
// polygons, camera and depth range, drawn by OpenGL with the shaders and state of the papers.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>

#include "mesh/shapes.h"
#include "methods/method_table.h"
#include "tests/opengl/gl_renderer.h"
#include "tests/support/drawing.h"

namespace burin {
namespace {

using namespace test;

constexpr int kSize = 256;

struct View {
    Camera camera;
    double near_distance, far_distance;

    glm::mat4 to_clip() const {
        const double h = 0.5 * camera.height;
        return glm::mat4(camera.orthographic
                             ? glm::ortho(-h, h, -h, h, near_distance, far_distance)
                             : glm::perspective(glm::radians(camera.fov_deg), 1.0, near_distance, far_distance));
    }
};

/// One mesh, drawn by both.
struct Model {
    PolygonSoup soup;
    View view;
};

/// Each polygon as triangles around its first corner; without those that have no area.
PolygonSoup in_triangles(const PolygonSoup& soup) {
    std::vector<std::vector<std::uint32_t>> triangles;
    for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
        const auto p = soup.polygon(i);
        for (std::size_t k = 2; k < p.size(); ++k) {
            const glm::dvec3 a = soup.positions[p[0]], b = soup.positions[p[k - 1]], c = soup.positions[p[k]];
            if (glm::length(glm::cross(b - a, c - a)) > 1e-9) triangles.push_back({p[0], p[k - 1], p[k]});
        }
    }
    return soup_of(soup.positions, triangles);
}

View seen_from(glm::dvec3 eye, glm::dvec3 target, double near_distance, double far_distance) {
    return {perspective_camera(eye, target), near_distance, far_distance};
}

Model cube() { return {make_box({1, 1, 1}), seen_from({2, 1.5, 3}, {0, 0, 0}, 2, 6)}; }
Model teapot() { return {in_triangles(make_teapot(3)), seen_from({4, 5, 9}, {0, 1.4, 0}, 5, 18)}; }

/// Three by three tilted squares, turned on the screen; z falls by `b` of the depth range per
/// pixel.
Model tilted(double b) {
    constexpr double kRange = 256;
    const PolygonSoup squares = transformed(make_plane(150, 150, 3, 3), [b](glm::dvec3 p) {
        const double c = std::cos(0.35), s = std::sin(0.35);
        const double x = c * p.x - s * p.z, y = s * p.x + c * p.z;
        return glm::dvec3(128.13 + x, 127.71 + y, b * kRange * (0.8 * y + 0.6 * x));
    });
    return {squares, {pixel_camera(kSize, kSize), 1000 - 0.5 * kRange, 1000 + 0.5 * kRange}};
}

std::vector<double> by_burin(const Model& model, std::string_view method) {
    Scene scene = scene_of({model.soup});
    scene.lines.classes = LineClassSet::all();
    scene.wire.width = WireWidth::published;
    scene.zbuffer.depth_range = {model.view.near_distance, model.view.far_distance};
    return Drawing(scene, model.view.camera, kSize, kSize, {0, 0, kSize, kSize}, 2, find_method(method)->render)
        .coverage();
}

std::vector<double> by_opengl(const Model& model, GlMethod method) {
    static GlRenderer renderer;
    GlMesh mesh;
    for (const glm::dvec3& p : model.soup.positions) {
        mesh.positions.emplace_back(model.view.camera.to_view() * glm::dvec4(p, 1));
    }
    for (std::size_t i = 0; i < model.soup.polygon_count(); ++i) {
        const auto p = model.soup.polygon(i);
        mesh.polygons.emplace_back(p.begin(), p.end());
    }
    const std::vector<float> alpha = renderer.line_alpha(mesh, model.view.to_clip(), kSize, kSize, method);
    return {alpha.begin(), alpha.end()};
}

/// How two pictures of the same lines differ.
struct Difference {
    double mean = 0;       ///< of absolute differences, over the pixels with line in either picture
    double differing = 0;  ///< share of those that differ by more than 2 / 255
    double largest = 0;
    int astray = 0;  ///< pixels with line in one picture and none within a pixel in the other
};

bool has_line_near(const std::vector<double>& picture, int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, kSize - 1); ++v) {
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, kSize - 1); ++u) {
            if (picture[static_cast<std::size_t>(v * kSize + u)] > 0.5) return true;
        }
    }
    return false;
}

Difference difference(const std::vector<double>& a, const std::vector<double>& b) {
    Difference d;
    double pixels = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const auto i = static_cast<std::size_t>(y * kSize + x);
            const double gap = std::abs(a[i] - b[i]);
            pixels += std::max(a[i], b[i]) >= 1.0 / 255;
            d.mean += gap;
            d.differing += gap > 2.0 / 255;
            d.largest = std::max(d.largest, gap);
            d.astray += (a[i] > 0.5 && !has_line_near(b, x, y)) || (b[i] > 0.5 && !has_line_near(a, x, y));
        }
    }
    d.mean /= pixels;
    d.differing /= pixels;
    return d;
}

double sum(const std::vector<double>& picture) { return std::accumulate(picture.begin(), picture.end(), 0.0); }

TEST(OpenGl, SinglePassHasTheSameDarknessInEveryPixel) {
    for (const Model& model : {cube(), teapot(), tilted(1e-3)}) {
        // A triangle's heights know its own three edges only.
        const Model triangles{in_triangles(model.soup), model.view};
        const auto ours = by_burin(triangles, "single-pass"), theirs = by_opengl(triangles, GlMethod::single_pass);
        EXPECT_GT(sum(ours), 1000);
        const Difference d = difference(ours, theirs);
        EXPECT_LT(d.mean, 1e-3);  // corners are snapped to 1/256 pixel here
        EXPECT_LE(d.differing, 1e-3);
    }
}

struct Pair {
    const char* name;
    GlMethod method;
};
constexpr Pair kSimple{"simple", GlMethod::simple}, kSlopeOffset{"slope-offset", GlMethod::slope_offset},
    kStencil{"stencil", GlMethod::stencil};

TEST(OpenGl, ZBufferMethodsDrawTheSamePixels) {
    // OpenGL leaves open which pixel a line takes between two, and whether it has its last one.
    for (const Model& model : {cube(), teapot(), tilted(0), tilted(1e-3), tilted(-3e-3)}) {
        for (const Pair& pair : {kSimple, kSlopeOffset, kStencil}) {
            const auto ours = by_burin(model, pair.name), theirs = by_opengl(model, pair.method);
            EXPECT_GT(sum(ours), 400) << pair.name;
            const Difference d = difference(ours, theirs);
            EXPECT_LT(d.differing, 0.015) << pair.name;
            EXPECT_LE(d.astray, 2) << pair.name;
            EXPECT_NEAR(sum(ours), sum(theirs), 0.01 * sum(theirs)) << pair.name;
        }
    }
}

TEST(OpenGl, SimpleEdgingLosesAsManyPixels) {
    // On tilted faces, about half of each line within the surface is lost.
    for (const double b : {1e-3, -3e-3}) {
        const Model model = tilted(b);
        const auto missing = [](const std::vector<double>& simple, const std::vector<double>& whole) {
            return 1 - sum(simple) / sum(whole);
        };
        const double ours = missing(by_burin(model, kSimple.name), by_burin(model, kStencil.name));
        const double theirs = missing(by_opengl(model, kSimple.method), by_opengl(model, kStencil.method));
        EXPECT_GT(theirs, 0.3);
        EXPECT_NEAR(ours, theirs, 0.01);
        // So the comparison does tell methods apart.
        EXPECT_GT(difference(by_burin(model, kStencil.name), by_opengl(model, kSimple.method)).differing, 0.3);
    }
}

}  // namespace
}  // namespace burin
