#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "image/image.h"
#include "mesh/polygon_soup.h"
#include "methods/patel/patel.h"
#include "scene/scene.h"

namespace burin::test {

/// A scene of these objects, one mesh each, with every setting at its default.
Scene scene_of(std::vector<PolygonSoup> objects);
/// A soup from plain lists, for tests.
PolygonSoup soup_of(std::vector<glm::dvec3> positions, std::vector<std::vector<std::uint32_t>> polygons);
/// The soup with every position moved by f.
PolygonSoup transformed(PolygonSoup soup, const std::function<glm::dvec3(glm::dvec3)>& f);

/// Orthographic view along -Z in which world units are pixels: world (x, y) lies at pixel (x, height - y).
Camera pixel_camera(int width, int height, double eye_z = 1000);
Camera perspective_camera(glm::dvec3 eye, glm::dvec3 target, double fov_deg = 35);

using RenderFunction = RenderStats (*)(const Frame&, const RunOptions&, Film&);

/// A finished drawing with every layer, by method patel unless another is given.
class Drawing {
  public:
    Drawing(const Scene& scene, const Camera& camera, int width, int height, int threads = 2);
    Drawing(const Scene& scene, const Camera& camera, int width, int height, PixelRect crop, int threads,
            RenderFunction render = render_patel);

    const Image& image() const { return image_; }
    int width() const { return image_.width(); }
    int height() const { return image_.height(); }
    double at(const std::string& channel, int x, int y) const;
    /// Coverage of all lines, and of one class (0 if the class is not drawn).
    double line(int x, int y) const { return at("lines.A", x, y); }
    double line(LineClass c, int x, int y) const;
    /// Sum of a channel over the picture.
    double sum(const std::string& channel) const;
    double sum(LineClass c) const;
    /// All coverages of lines, row by row.
    std::vector<double> coverage() const;
    /// Share of points, every quarter pixel from a to b without the ends, that have a line within
    /// `reach_px` of them.
    double drawn_share(glm::dvec2 a, glm::dvec2 b, double trim_px = 3, double reach_px = 0.75) const;

  private:
    Image image_;
};

/// Whether two images are equal to the bit, and if not, where they differ first.
::testing::AssertionResult same_bits(const Image& a, const Image& b);

}  // namespace burin::test
