#include "compare/svg_method.h"

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "compare/rasterize_svg.h"
#include "methods/abuffer.h"
#include "methods/method_table.h"
#include "output/paths/make_paths.h"
#include "scene/plain_sheet.h"
#include "shading/ink/ink_lines.h"

namespace burin {
namespace {

RenderStats render_as_svg(const Frame& frame, const RunOptions& options, Film& film) {
    const std::string rasterizer = find_svg_rasterizer();
    if (rasterizer.empty()) throw InputError("rsvg-convert: this program is not installed; install librsvg2-bin");
    RenderStats stats;
    const FoundLines lines = find_styled_lines(frame, options, film, stats);
    InkedLines inked = ink_lines(lines, *frame.sheet, stats.threads, stats.notes, {true, true});
    VectorOptions vector_options;
    vector_options.crop = frame.crop;
    VectorStats counts;
    VectorDrawing drawing = vector_drawing_of(std::move(inked), lines, vector_options, counts);
    const std::vector<glm::vec4> colors = rasterize_svg(std::move(drawing), rasterizer);
    // A vector file has no surfaces.
    PixelResult pixel;
    pixel.distance = std::numeric_limits<float>::infinity();
    auto color = colors.begin();
    for (int y = frame.crop.y0; y < frame.crop.y1; ++y) {
        for (int x = frame.crop.x0; x < frame.crop.x1; ++x) {
            pixel.beauty = pixel.lines = *color++;
            film.put(x, y, pixel);
        }
    }
    film.end_picture();
    return stats;
}

constexpr Method kSvg{"svg",
                      "Burin; method abuffer as paths, drawn by rsvg-convert of librsvg",
                      LineClassSet::all(),
                      render_as_svg,
                      nullptr,
                      nullptr,
                      true};

}  // namespace

const Method& svg_method() { return kSvg; }

void draw_as_paths(Scene& scene) {
    scene.sheet = std::make_shared<const StyleSheet>(plain_sheet(scene.lines));
    scene.names_lines = scene.draws_one_sheet = true;
}

void draw_as_pixels(Scene& scene) {
    scene.sheet.reset();
    scene.names_lines = scene.draws_one_sheet = false;
}

std::vector<const Method*> compared_methods() {
    std::vector<const Method*> all;
    for (const Method& method : methods()) all.push_back(&method);
    all.push_back(&kSvg);
    return all;
}

const Method* find_compared_method(std::string_view name) { return name == kSvg.name ? &kSvg : find_method(name); }

}  // namespace burin
