#include "cli/vector_output.h"

#include <cstdio>
#include <utility>

#include "base/atomic_file.h"
#include "output/paths/path_order.h"
#include "output/vector_files.h"
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
    return drawing;
}

void finish_drawing(const PictureSettings& picture, const Arguments& a, VectorDrawing& drawing, VectorStats& stats,
                    std::vector<std::string>& notes) {
    drawing.paper = picture.background;
    // Machines would draw the outline of the paper.
    const bool is_for_machine = a.page == PagePreset::plotter || a.page == PagePreset::laser;
    if (is_for_machine && a.background.empty()) drawing.paper.reset();
    if (!drawing.paper && !picture.transparent && !is_for_machine) drawing.paper = glm::vec3(1.0f);
    if (a.page == PagePreset::patent) {
        const OpaquePaths made = make_opaque(drawing);
        if (made.solid + made.left_out > 0) {
            notes.push_back("--page patent has no grey: of paths that fade, " + std::to_string(made.solid) +
                            " are drawn solid, and " + std::to_string(made.left_out) +
                            ", paler than half, are left out");
        }
    }
    if (a.page == PagePreset::laser) make_hairlines(kHairlineMm * drawing.dpi / 25.4, drawing);
    if (a.merges_paths) merge_paths(drawing);
    if (is_for_machine) {
        const PenTravel travel = sort_for_pen(drawing);
        stats.pen_travel_mm = {travel.before_px * 25.4 / drawing.dpi, travel.after_px * 25.4 / drawing.dpi};
    }
    stats.paths = drawing.paths.size();
}

void write_vector(const VectorDrawing& drawing, const Arguments& a, const OutputOptions& output) {
    VectorFileOptions options;
    options.names_paths = a.names_paths;
    options.is_plain_pdf = a.page == PagePreset::patent;
    options.tolerance_px = a.tolerance_px;
    options.fingerprint = output.fingerprint;
    std::vector<std::string> notes;
    const std::string text = vector_file_of(drawing, output.format, options, notes);
    if (!a.quiet) {
        for (const std::string& note : notes) std::fprintf(stderr, "burin: note: %s\n", note.c_str());
    }
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
    if (!stats.pen_travel_mm) return;
    json.key("pen_travel_unsorted_mm").value((*stats.pen_travel_mm)[0]);
    json.key("pen_travel_mm").value((*stats.pen_travel_mm)[1]);
}

}  // namespace burin
