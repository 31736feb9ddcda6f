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

/// Three by three tilted squares, turned on the screen; z falls by `b` of the depth range per pixel.
Model tilted(double b) {
    constexpr double kRange = 256;
    const PolygonSoup squares = transformed(make_plane(150, 150, 3, 3), [b](glm::dvec3 p) {
        const double c = std::cos(0.35), s = std::sin(0.35);
        const double x = c * p.x - s * p.z, y = s * p.x + c * p.z;
        return glm::dvec3(128.13 + x, 127.71 + y, b * kRange * y);
    });
    return {squares, {pixel_camera(kSize, kSize), 1000 - 0.5 * kRange, 1000 + 0.5 * kRange}};
}

std::vector<double> by_burin(const Model& model, std::string_view method) {
    Scene scene = scene_of({model.soup});
    scene.lines.classes = LineClass::polygon;
    scene.wire.width = WireWidth::published;
    scene.zbuffer.depth_range = {model.view.near_distance, model.view.far_distance};
    return Drawing(scene, model.view.camera, kSize, kSize, {0, 0, kSize, kSize}, 2, find_method(method)->render).coverage();
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

struct Difference {
    double mean = 0;      ///< of absolute differences, over pixels with line in either picture
    double differing = 0; ///< share of those that differ by more than 2 / 255
    double line_a = 0, line_b = 0;  ///< sums
};

Difference difference(const std::vector<double>& a, const std::vector<double>& b) {
    Difference d;
    double pixels = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        d.line_a += a[i];
        d.line_b += b[i];
        if (std::max(a[i], b[i]) < 1.0 / 255) continue;
        ++pixels;
        d.mean += std::abs(a[i] - b[i]);
        d.differing += std::abs(a[i] - b[i]) > 2.0 / 255;
    }
    d.mean /= pixels;
    d.differing /= pixels;
    return d;
}

TEST(OpenGl, SinglePassDrawsTheSameLines) {
    for (const auto& model : {cube(), teapot(), tilted(1e-3)}) {
        const Model triangles{in_triangles(model.soup), model.view};
        const Difference d = difference(by_burin(triangles, "single-pass"), by_opengl(triangles, GlMethod::single_pass));
        std::printf("single-pass mean %.5f differing %.5f sums %.1f %.1f\n", d.mean, d.differing, d.line_a, d.line_b);
    }
}

TEST(OpenGl, ZBuffer) {
    for (const auto& model : {cube(), teapot(), tilted(1e-3), tilted(-1e-2), tilted(0)}) {
        for (const auto& [name, method] : {std::pair{"simple", GlMethod::simple}, {"slope-offset", GlMethod::slope_offset}, {"stencil", GlMethod::stencil}}) {
            const Difference d = difference(by_burin(model, name), by_opengl(model, method));
            std::printf("method %d mean %.5f differing %.5f sums %.1f %.1f\n", static_cast<int>(method), d.mean, d.differing, d.line_a, d.line_b);
        }
    }
}

}  // namespace
}  // namespace burin
