#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "abuffer/hidden_pass.h"
#include "abuffer/screen/triangle_bins.h"
#include "methods/abuffer.h"
#include "tests/support/drawing.h"
#include "tests/support/joined_soups.h"

/// What tests of hidden lines and of transparent surfaces have in common: all layers of a square picture.
namespace burin::test {

constexpr int kSize = 240;

inline PolygonSoup moved(PolygonSoup soup, glm::dvec3 by) {
    return transformed(std::move(soup), [by](glm::dvec3 p) { return p + by; });
}

/// All its polygons wound the other way.
inline PolygonSoup turned(PolygonSoup soup) {
    for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
        const std::size_t begin = static_cast<std::size_t>(soup.polygon(i).data() - soup.corners.data());
        std::reverse(soup.corners.begin() + static_cast<std::ptrdiff_t>(begin),
                     soup.corners.begin() + static_cast<std::ptrdiff_t>(begin + soup.polygon(i).size()));
    }
    return soup;
}

/// Finds all lines of a picture, with what is in front of them, in one slice.
inline void find_all(HiddenPass& pass, const Frame& frame) {
    const TileRows rows = HiddenPass::tiles_of(frame).rows();
    pass.find_lines(rows);
    pass.sort(rows);
    pass.find_parts();
    pass.join_results();
}

/// The lines of a frame with what is in front of them.
struct Layers {
    Frame frame;
    ScreenSurfaces screen;
    TriangleBins bins;  // finds out which way triangles face
    HiddenPass pass;

    Layers(const Scene& scene, const Camera& camera, int threads = 2, const PreparedScene* prepared = nullptr)
        : frame(make_frame(scene, camera, kSize, kSize, {0, 0, kSize, kSize}, prepared)),
          screen(frame.surfaces, frame.criteria, best_kernels(), threads),
          bins(screen, frame.crop, 4, best_kernels(), threads),
          pass(frame, screen, best_kernels(), threads) {
        find_all(pass, frame);
    }
    /// How many pixels of lines have `invisibility` opaque surfaces in front, of one class or of all.
    double hidden_px(int invisibility, std::optional<LineClass> of = std::nullopt) const {
        double sum = 0;
        for (const LinePart& p : pass.parts()) {
            const WholeLine& line = pass.lines()[p.line];
            if (p.invisibility != invisibility || (of && line.drawn_as != *of)) continue;
            sum += (p.end - p.begin) * line.length_px();
        }
        return sum;
    }
    double all_hidden_px() const {
        double sum = 0;
        for (int i = 1; i < 256; ++i) sum += hidden_px(i);
        return sum;
    }
    /// How many opaque layers are in front of a line at a place on it.
    int invisibility(std::uint32_t line, double at) const {
        for (const LinePart& p : pass.parts()) {
            if (p.line == line && p.begin <= at && at < p.end) return p.invisibility;
        }
        return 0;
    }
};

inline Image draw(const Scene& scene, const Camera& camera, int threads = 2, PixelRect crop = {0, 0, kSize, kSize}) {
    const Frame frame = make_frame(scene, camera, kSize, kSize, crop);
    LayerSet all{true, true, true, true, true, true, true, true};
    Film film({0, 0, kSize, kSize}, crop, all, frame.criteria.classes);
    RunOptions options;
    options.threads = threads;
    render_abuffer(frame, options, film);
    return film.image();
}

inline double value(const Image& image, const std::string& channel, int x, int y) {
    const Channel* const c = image.find(channel);
    if (c == nullptr) ADD_FAILURE() << "no channel " << channel;
    return c == nullptr ? std::nan("") : image.value(*c, x, y);
}
inline double sum(const Image& image, const std::string& channel) {
    double total = 0;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) total += value(image, channel, x, y);
    }
    return total;
}

inline Camera ortho_camera(glm::dvec3 eye, double height) {
    CameraSettings settings;
    settings.eye = eye;
    settings.target = glm::dvec3(0.0);
    settings.orthographic = true;
    settings.height = height;
    return resolve_camera(
        settings, [](const auto&) {}, 1);
}

inline glm::dvec2 pixel_of(const Frame& frame, const Camera& camera, glm::dvec3 world) {
    return frame.surfaces.projection.to_pixel(glm::dvec3(camera.to_view() * glm::dvec4(world, 1)));
}

}  // namespace burin::test
