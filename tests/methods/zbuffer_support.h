#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "methods/method_table.h"
#include "methods/zbuffer/methods.h"
#include "render/film.h"
#include "tests/support/drawing.h"
#include "tests/support/minimal_scenes.h"

namespace burin::test {

inline const std::vector<std::string_view> kZBufferMethods = {"simple",       "offset",       "slope-offset", "decal",
                                                              "edging-plane", "virgin-plane", "stencil"};
/// The methods that protect an edge against its own polygon by a bit.
inline const std::vector<std::string_view> kPlaneMethods = {"edging-plane", "virgin-plane", "stencil"};

/// A picture with all layers, drawn by a method of the table.
class MethodDrawing {
  public:
    MethodDrawing(std::string_view method, const Scene& scene, const Camera& camera, int width, int height,
                  int threads = 1)
        : MethodDrawing(method, scene, camera, width, height, {0, 0, width, height}, threads) {}
    MethodDrawing(std::string_view method, const Scene& scene, const Camera& camera, int width, int height,
                  PixelRect crop, int threads) {
        const Frame frame = make_frame(scene, camera, width, height, crop);
        Film film({0, 0, width, height}, crop, {true, true, true, true, true, true, true}, frame.criteria.classes);
        RunOptions options;
        options.threads = threads;
        find_method(method)->render(frame, options, film);
        image_ = film.image();
    }
    MethodDrawing(std::string_view method, const MinimalScene& s)
        : MethodDrawing(method, s.scene, s.camera, s.size_px, s.size_px) {}

    const Image& image() const { return image_; }
    double at(const std::string& channel, int x, int y) const { return image_.value(*image_.find(channel), x, y); }
    bool has_line(int x, int y) const { return at("lines.A", x, y) > 0; }
    bool is_red(int x, int y) const { return at("lines.R", x, y) == 1 && at("lines.G", x, y) == 0; }
    double sum(const std::string& channel) const {
        double sum = 0;
        for (int y = 0; y < image_.height(); ++y) {
            for (int x = 0; x < image_.width(); ++x) sum += at(channel, x, y);
        }
        return sum;
    }

  private:
    Image image_;
};

/// The pixels of an aliased line: in each column of its major axis the one that it crosses in the
/// middle. Without those within `trim_px` of its ends.
inline std::vector<glm::ivec2> pixels_along(const ScreenSegment& s, double trim_px = 4) {
    glm::dvec2 a = s.a, b = s.b;
    const int major = std::abs(b.x - a.x) >= std::abs(b.y - a.y) ? 0 : 1;
    if (b[major] < a[major]) std::swap(a, b);
    std::vector<glm::ivec2> pixels;
    for (int i = static_cast<int>(std::ceil(a[major] + trim_px)); i + 1 <= b[major] - trim_px; ++i) {
        const double t = (i + 0.5 - a[major]) / (b[major] - a[major]);
        glm::ivec2 pixel;
        pixel[major] = i;
        pixel[1 - major] = static_cast<int>(std::floor(a[1 - major] + t * (b[1 - major] - a[1 - major])));
        pixels.push_back(pixel);
    }
    return pixels;
}

/// Share of a line's pixels for which the condition holds.
template <typename Condition>
double share_along(const ScreenSegment& s, const Condition& condition) {
    int found = 0;
    const std::vector<glm::ivec2> pixels = pixels_along(s);
    for (const glm::ivec2 p : pixels) found += condition(p.x, p.y);
    return static_cast<double>(found) / static_cast<double>(pixels.size());
}
inline double drawn_share(const MethodDrawing& d, const ScreenSegment& s) {
    return share_along(s, [&](int x, int y) { return d.has_line(x, y); });
}
inline double missing_share(const MethodDrawing& d, const ScreenSegment& s) { return 1 - drawn_share(d, s); }

inline double measured_missing(std::string_view method, const MinimalScene& s) {
    return missing_share(MethodDrawing(method, s), s.lines[0]);
}

}  // namespace burin::test
