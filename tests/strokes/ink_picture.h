#pragma once

#include <string>
#include <vector>

#include "render/frame.h"
#include "shading/ink/inked_lines.h"
#include "strokes/ink_printer.h"
#include "tests/support/drawing.h"

namespace burin::test {

/// Strokes by hand over a plain surface.
class InkPicture {
  public:
    InkPicture(int width, int height)
        : scene_(scene_of({soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})})), width_(width), height_(height) {}

    InkedLines lines;
    glm::vec4 paper{1.0f};  ///< what lies below the strokes
    bool perspective = false;
    bool only_lines = false;  ///< of the layers

    /// Adds a stroke along points; each has its own chain unless that is changed.
    InkStroke& add(const std::vector<InkPoint>& points) {
        InkStroke stroke;
        stroke.first_point = lines.points.size();
        stroke.point_count = points.size();
        stroke.chain = InkStroke::chain_of(static_cast<std::uint32_t>(lines.strokes.size()), 0);
        for (const InkPoint& p : points) {
            lines.points.push_back(p);
            const InkPoint& first = points.front();
            stroke.is_constant = stroke.is_constant && p.width_px == first.width_px && p.opacity == first.opacity &&
                                 p.color == first.color;
        }
        lines.strokes.push_back(stroke);
        return lines.strokes.back();
    }
    InkStroke& add(glm::dvec2 from, glm::dvec2 to, float width_px, float opacity = 1, glm::vec3 color = glm::vec3(0)) {
        return add({point(from, width_px, opacity, color), point(to, width_px, opacity, color)});
    }
    static InkPoint point(glm::dvec2 place, float width_px, float opacity = 1, glm::vec3 color = glm::vec3(0)) {
        InkPoint p;
        p.place = place;
        p.nearness = -100;
        p.width_px = width_px;
        p.opacity = opacity;
        p.color = color;
        return p;
    }

    PixelRect whole() const { return {0, 0, width_, height_}; }
    Image draw(int threads = 1) const { return draw(whole(), threads); }
    Image draw(PixelRect crop, int threads) const {
        const Camera camera = perspective ? perspective_camera({0, 0, 10}, {0, 0, 0}) : pixel_camera(width_, height_);
        const Frame frame = make_frame(scene_, camera, width_, height_, crop);
        LayerSet layers{true, true, true, true, true, true, true, true};
        if (only_lines) layers = {false, true, false, false, false, false, false, false};
        for (const std::string& name : lines.layers) {
            if (!name.empty()) layers.line_sets.push_back(name);
        }
        Film film(whole(), crop, layers, LineClassSet::all());
        PixelResult pixel;
        pixel.beauty = pixel.surface = paper;
        pixel.distance = 1;
        for (int y = crop.y0; y < crop.y1; ++y) {
            if (only_lines) film.put_color(crop.x0, crop.x1, y, {});
            for (int x = crop.x0; x < crop.x1 && !only_lines; ++x) film.put(x, y, pixel);
        }
        draw_ink(frame, lines, threads, film);
        return film.image();
    }
    double projection_focal_px() const {
        const Camera camera = perspective ? perspective_camera({0, 0, 10}, {0, 0, 0}) : pixel_camera(width_, height_);
        return make_frame(scene_, camera, width_, height_, whole()).surfaces.projection.focal_px;
    }

  private:
    Scene scene_;
    int width_, height_;
};

inline double at(const Image& image, const std::string& channel, int x, int y) {
    const Channel* const c = image.find(channel);
    if (c == nullptr) ADD_FAILURE() << "no channel " << channel;
    return c == nullptr ? 0 : image.value(*c, x - image.data().x0, y - image.data().y0);
}
inline double sum(const Image& image, const std::string& channel) {
    double sum = 0;
    for (int y = image.data().y0; y < image.data().y1; ++y) {
        for (int x = image.data().x0; x < image.data().x1; ++x) sum += at(image, channel, x, y);
    }
    return sum;
}

}  // namespace burin::test
