#include "cli/vector_output.h"

#include <utility>

#include "base/atomic_file.h"
#include "output/svg.h"
#include "shading/ink/ink_lines.h"

namespace burin {

VectorDrawing draw_paths(const FoundLines& lines, const Frame& frame, const Arguments& a, VectorStats& stats,
                         std::vector<std::string>& notes) {
    InkedLines inked = ink_lines(lines, *frame.sheet, a.threads, notes, {true, a.cuts_dashes});
    VectorOptions options;
    options.bounds = {a.tolerance_px, a.chord_sag_px};
    options.grouping = a.grouping;
    options.crop = frame.crop;
    VectorDrawing drawing = vector_drawing_of(std::move(inked), lines, options, stats);
    if (stats.mean_inks > 0) {
        notes.push_back("a path has one colour and opacity: " + std::to_string(stats.mean_inks) +
                        " strokes that vary in them have their means");
    }
    const PictureSettings& picture = frame.scene->picture;
    drawing.paper = picture.background;
    if (!drawing.paper && !picture.transparent) drawing.paper = glm::vec3(1.0f);
    return drawing;
}

void write_vector(const VectorDrawing& drawing, const Arguments& a, const OutputOptions& output) {
    const std::string text = svg_of(drawing, {a.names_paths});
    AtomicFile file(output.path);
    file.write(text.data(), text.size());
    file.commit();
}

void add_stages(JsonWriter& json, const VectorStats& stats) {
    json.key("chain").value(stats.chain_s).key("clean").value(stats.clean_s).key("fit").value(stats.fit_s);
}

void add_counts(JsonWriter& json, const VectorStats& stats) {
    json.key("strokes").value(std::uint64_t{stats.strokes}).key("chained").value(std::uint64_t{stats.chained});
    json.key("paths").value(std::uint64_t{stats.paths});
}

}  // namespace burin
