#include "cli/vector_output.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "base/atomic_file.h"
#include "base/stopwatch.h"
#include "methods/seen_surfaces.h"
#include "output/paths/path_order.h"
#include "output/paths/surface_regions.h"
#include "output/vector_files.h"
#include "output/vector_layers.h"
#include "shading/ink/ink_lines.h"

namespace burin {

VectorDrawing draw_paths(const FoundLines& lines, const Frame& frame, const Arguments& a, VectorStats& stats,
                         std::vector<std::string>& notes, Progress* progress) {
    InkedLines inked = ink_lines(lines, *frame.sheet, a.threads, notes, {true, a.cuts_dashes});
    VectorOptions options;
    options.bounds = {a.tolerance_px, a.chord_sag_px};
    options.grouping = a.grouping;
    options.crop = frame.crop;
    options.progress = progress;
    VectorDrawing drawing = vector_drawing_of(std::move(inked), lines, options, stats);
    if (std::string means = note_on_means(stats); !means.empty()) notes.push_back(std::move(means));
    return drawing;
}

namespace {

/// Notes what a look becomes on a page without saying so: paths in the colour of the paper, or in colours where offices
/// want black.
void note_on_looks(const Arguments& a, const VectorDrawing& drawing, std::vector<std::string>& notes) {
    if (drawing.paths.empty()) return;
    std::size_t pale = 0, colored = 0;
    for (const VectorPath& path : drawing.paths) {
        const glm::ivec3 codes = srgb_codes(drawing.styles[path.style].color);
        const glm::ivec3 off = drawing.paper ? glm::abs(codes - srgb_codes(*drawing.paper)) : glm::ivec3(255);
        pale += std::max({off.r, off.g, off.b}) < kHardlySeen ? 1 : 0;
        colored += codes != glm::ivec3(0) ? 1 : 0;
    }
    const std::string count = std::to_string(drawing.paths.size());
    if (pale == drawing.paths.size()) {
        notes.push_back("all " + count +
                        " paths are about as pale as the paper, or as dark, so nothing is seen; "
                        "choose another --background or --color");
    } else if (a.page == PagePreset::patent && colored > 0) {
        notes.push_back("patent offices want black: " + std::to_string(colored) + " of " + count +
                        " paths have other colours; --color '#000000' makes them black where the style sheet has it");
    }
}

}  // namespace

bool draws_regions(const Scene& scene, const Arguments& a) {
    return surfaces_have_look(scene) && (a.page == PagePreset::none || a.page == PagePreset::iso128);
}

void draw_regions(const SurfaceGrid& seen, VectorDrawing& drawing, VectorStats& stats,
                  std::vector<std::string>& notes) {
    const Stopwatch watch;
    add_surface_regions(seen, drawing);
    stats.regions_s = watch.seconds();
    if (std::string means = note_on_means(seen); !means.empty()) notes.push_back(std::move(means));
}

void finish_drawing(const PictureSettings& picture, const Arguments& a, VectorDrawing& drawing, VectorStats& stats,
                    std::vector<std::string>& notes) {
    drawing.paper = picture.background;
    // Machines would draw the outline of the paper.
    const bool is_for_machine = a.page == PagePreset::plotter || a.page == PagePreset::laser;
    if (is_for_machine && a.background.empty()) drawing.paper.reset();
    if (!drawing.paper && !picture.transparent && !is_for_machine) drawing.paper = glm::vec3(1.0f);
    if (is_for_machine || a.page == PagePreset::patent) {
        const OpaquePaths made = make_opaque(drawing);
        if (made.solid + made.left_out > 0) {
            notes.push_back("--page " + std::string(page_of(a.page).name) + " has no grey: of paths that are pale, " +
                            std::to_string(made.solid) + " are drawn solid, and " + std::to_string(made.left_out) +
                            ", paler than half of the strongest of their set, are left out");
        }
    }
    if (a.page == PagePreset::laser) make_hairlines(kHairlineMm * drawing.dpi / 25.4, drawing);
    Stopwatch watch;
    if (a.merges_paths) merge_paths(drawing);
    stats.merge_s = watch.lap();
    if (is_for_machine) {
        const PenTravel travel = sort_for_pen(drawing);
        stats.sort_s = watch.lap();
        stats.pen_travel_mm = {travel.before_px * 25.4 / drawing.dpi, travel.after_px * 25.4 / drawing.dpi};
    }
    stats.paths = drawing.paths.size();
    note_on_looks(a, drawing, notes);
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
    json.key("regions").value(stats.regions_s);
    json.key("merge").value(stats.merge_s).key("sort").value(stats.sort_s);
}

void add_counts(JsonWriter& json, const VectorStats& stats) {
    json.key("strokes").value(std::uint64_t{stats.strokes}).key("chained").value(std::uint64_t{stats.chained});
    json.key("paths").value(std::uint64_t{stats.paths});
    if (!stats.pen_travel_mm) return;
    json.key("pen_travel_unsorted_mm").value((*stats.pen_travel_mm)[0]);
    json.key("pen_travel_mm").value((*stats.pen_travel_mm)[1]);
}

}  // namespace burin
