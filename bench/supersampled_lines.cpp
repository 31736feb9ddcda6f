#include "bench/supersampled_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "methods/method_table.h"

namespace burin::bench {
namespace {

/// The polygons at samples; beyond the picture's border there is nothing.
Image polygons_of(const Scene& scene, const ComparedView& fine) {
    Scene plain = scene;
    plain.lines.classes = {};
    const Frame frame = make_frame(plain, fine.camera, fine.width, fine.height, fine.crop);
    LayerSet layers{false, false, false, false, true, false, false};
    Film film({0, 0, fine.width, fine.height}, fine.crop, layers, plain.lines.classes);
    find_method("abuffer")->render(frame, {}, film);
    return film.image();
}

}  // namespace

Plane supersampled_lines(const Scene& scene, const ComparedView& view, int samples) {
    const double radius = 0.5 * scene.lines.style.width_px * samples;
    const int reach = static_cast<int>(std::ceil(radius)) + 1;
    ComparedView fine = view;
    fine.width *= samples;
    fine.height *= samples;
    const PixelRect c = view.crop;
    fine.crop = {std::max(c.x0 * samples - reach, 0), std::max(c.y0 * samples - reach, 0),
                 std::min(c.x1 * samples + reach, fine.width), std::min(c.y1 * samples + reach, fine.height)};
    const Image image = polygons_of(scene, fine);
    const Channel& object = *image.find("id.object");
    const Channel& polygon = *image.find("id.polygon");
    const int width = image.width(), height = image.height();
    std::vector<std::uint8_t> is_covered(image.pixel_count(), 0);
    const auto differ = [&](int x0, int y0, int x1, int y1) {
        return image.value(polygon, x0, y0) != image.value(polygon, x1, y1) ||
               image.value(object, x0, y0) != image.value(object, x1, y1);
    };
    const auto stamp = [&](double cx, double cy) {
        for (int y = std::max(static_cast<int>(std::ceil(cy - radius)), 0);
             y <= std::min(static_cast<int>(std::floor(cy + radius)), height - 1); ++y) {
            const double half = std::sqrt(std::max(radius * radius - (y - cy) * (y - cy), 0.0));
            for (int x = std::max(static_cast<int>(std::ceil(cx - half)), 0);
                 x <= std::min(static_cast<int>(std::floor(cx + half)), width - 1); ++x) {
                is_covered[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(x)] = 1;
            }
        }
    };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (x + 1 < width && differ(x, y, x + 1, y)) stamp(x + 0.5, y);
            if (y + 1 < height && differ(x, y, x, y + 1)) stamp(x, y + 0.5);
        }
    }
    Plane lines(c.width(), c.height());
    const float share = 1.0f / static_cast<float>(samples * samples);
    const int left = c.x0 * samples - fine.crop.x0, top = c.y0 * samples - fine.crop.y0;
    for (int y = 0; y < c.height() * samples; ++y) {
        for (int x = 0; x < c.width() * samples; ++x) {
            lines.at(x / samples, y / samples) +=
                share * is_covered[static_cast<std::size_t>(y + top) * static_cast<std::size_t>(width) +
                                   static_cast<std::size_t>(x + left)];
        }
    }
    return lines;
}

}  // namespace burin::bench
