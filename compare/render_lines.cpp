#include "compare/render_lines.h"

#include <algorithm>
#include <ctime>

#include "base/stopwatch.h"
#include "compare/peak_memory.h"
#include "image/image_io.h"

namespace burin {
namespace {

Plane plane_of(const Image& image, const char* name) {
    const Channel& channel = *image.find(name);
    Plane plane(image.width(), image.height());
    for (int y = 0; y < plane.height; ++y) {
        for (int x = 0; x < plane.width; ++x) plane.at(x, y) = static_cast<float>(image.value(channel, x, y));
    }
    return plane;
}

}  // namespace

LineRendering render_lines(const Method& method, const Scene& scene, const ComparedView& view,
                           const RunOptions& options) {
    const Frame frame = make_frame(scene, view.camera, view.width, view.height, view.crop);
    LayerSet layers{true, true, false, false, false, false, false};
    Film film({0, 0, view.width, view.height}, view.crop, layers, scene.lines.classes);
    const PeakMemory memory;
    const std::clock_t cpu_start = std::clock();
    const Stopwatch watch;
    method.render(frame, options, film);
    LineRendering result;
    result.time_s = watch.seconds();
    result.cpu_time_s = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
    if (const auto bytes = memory.bytes()) result.memory_bytes = static_cast<double>(*bytes);
    result.coverage = plane_of(film.image(), "lines.A");
    result.image = film.image();
    return result;
}

Plane ink_on_paper(const Plane& coverage) {
    Plane drawing = coverage;
    for (float& v : drawing.values) v = srgb_from_linear(1 - std::clamp(v, 0.0f, 1.0f));
    return drawing;
}

}  // namespace burin
