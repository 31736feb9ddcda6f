#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "base/stopwatch.h"
#include "cli/blur.h"
#include "cli/commands.h"
#include "cli/job.h"
#include "compare/rasterize_svg.h"
#include "compare/report.h"
#include "compare/run_comparison.h"
#include "compare/svg_method.h"
#include "compare/truth.h"
#include "mesh/text_scan.h"
#include "render/close_cracks.h"
#include "render/copied_objects.h"

namespace burin {
namespace {

/// Checks that the folder can be written to before the work, not after it.
void make_folder(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder)) {
        throw InputError(folder + ": cannot make this folder" + (error ? ": " + error.message() : "") +
                         "; give the name of a folder to write to");
    }
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
        throw InputError(folder + ": this folder cannot be written to; change its permissions");
    }
}

/// All files that a comparison writes.
std::vector<OutputFile> files_in(const std::string& folder) {
    std::vector<OutputFile> files;
    const auto add = [&](const std::string& name) {
        files.push_back({"--output", (std::filesystem::path(folder) / name).string()});
    };
    for (const Method* const method : compared_methods()) {
        add(std::string(method->name) + ".png");
        add(std::string(method->name) + "_diff.png");
    }
    for (const char* name : {"truth.png", "report.html", "metrics.csv", "metrics.json"}) add(name);
    return files;
}

/// Removes what an earlier comparison left in the folder, which would pass for results of this one.
void remove_earlier_results(const std::string& folder) {
    if (!std::filesystem::exists(std::filesystem::path(folder) / "metrics.json")) return;
    std::error_code ignored;
    for (const OutputFile& file : files_in(folder)) std::filesystem::remove(file.path, ignored);
}

/// All that can be compared but the truth itself, unless they are named. An SVG needs a program to draw it.
std::vector<const Method*> chosen_methods(const Arguments& a) {
    const bool has_rasterizer = !find_svg_rasterizer().empty();
    std::vector<const Method*> chosen;
    for (const std::string& name : a.methods) {
        const Method* const method = find_compared_method(name);
        if (method == nullptr) {
            throw UsageError("--methods: unknown method '" + printable(name) +
                             "'; burin methods lists them, and svg can be compared, too");
        }
        if (method == &svg_method() && !has_rasterizer) {
            throw UsageError("--methods: svg is drawn by rsvg-convert, which is not installed; install librsvg2-bin, " +
                             std::string("or leave svg out"));
        }
        chosen.push_back(method);
    }
    if (!chosen.empty()) return chosen;
    for (const Method* const method : compared_methods()) {
        if (method == &truth_method() || (method == &svg_method() && !has_rasterizer)) continue;
        chosen.push_back(method);
    }
    if (!has_rasterizer && !a.quiet) {
        std::fputs(
            "burin: note: svg is not compared, for rsvg-convert, which draws it, is not installed; the package "
            "librsvg2-bin has it\n",
            stderr);
    }
    return chosen;
}

/// All methods draw the same lines: those in front, to both sides. What only some of them can do
/// is left out, and the user told.
void draw_what_all_can(Scene& scene, bool quiet) {
    std::string left_out;
    const auto leave_out = [&](const char* what) { left_out += (left_out.empty() ? "" : ", ") + std::string(what); };
    LineStyle& style = scene.lines.style;
    if (style.side != StrokeSide::both) leave_out("lines.side (strokes lie on both sides)");
    if (style.filter != PixelFilter::box) leave_out("lines.filter");
    if (style.dash_px) leave_out("lines.dash");
    if (scene.lines.contours != Contours::mesh) leave_out("lines.contours");
    if (scene.lines.crease_fade_deg > 0) leave_out("creases that fade");
    if (style.hidden.style != HiddenStyle::none) leave_out("lines.hidden");
    bool is_opaque = true;
    for (Material& material : scene.materials) {
        is_opaque = is_opaque && material.opacity >= 1;
        material.opacity = 1;
    }
    if (!is_opaque) leave_out("opacity");
    style.side = StrokeSide::both;
    style.filter = PixelFilter::box;
    style.dash_px.reset();
    scene.lines.contours = Contours::mesh;
    scene.lines.crease_fade_deg = 0;
    style.hidden.style = HiddenStyle::none;
    if (!left_out.empty() && !quiet) {
        std::fprintf(stderr, "burin: note: not every method has %s; the comparison goes without\n", left_out.c_str());
    }
}

}  // namespace

void run_compare(const Arguments& a) {
    const bool shows_bar = !a.quiet && isatty(STDERR_FILENO) != 0;
    Progress progress(a.alf_progress ? ProgressStyle::alf : (shows_bar ? ProgressStyle::bar : ProgressStyle::none));
    const Stopwatch total;
    const std::vector<const Method*> chosen = chosen_methods(a);
    Still still = load_still(a, files_in(a.output));
    Scene& scene = still.scene;
    if (scene.sheet) throw UsageError("--style: burin compare draws no style sheets; remove the style sheet");
    draw_what_all_can(scene, a.quiet);
    ComparedView view;
    {
        const Camera& camera = still.camera;
        note_missing_blur(scene, camera, a, "burin compare");
        empty_copied_objects(scene);
        close_cracks(scene, camera, scene.picture.width, scene.picture.height, a.threads);
        const Frame frame = frame_of(scene, camera, a);
        view = {frame.camera, frame.width, frame.height, frame.crop};
    }
    make_folder(a.output);
    remove_earlier_results(a.output);
    ComparisonOptions options{a.output, chosen, a.frames, a.threads, &progress};
    Comparison so_far;
    try {
        const Comparison comparison = run_comparison(scene, a.input, view, options, [&](const Comparison& c) {
            so_far = c;
            write_metrics(c, a.output);
        });
        write_report(comparison, a.output);
    } catch (const Interrupted&) {
        progress.finish();
        if (so_far.methods.empty()) throw Interrupted("interrupted; no method was finished");
        throw Interrupted("interrupted; " + a.output + "/metrics.json has the " +
                          std::to_string(so_far.methods.size()) + " of " + std::to_string(options.methods.size()) +
                          " methods that were finished");
    }
    progress.finish();
    if (a.verbose || shows_bar) {
        std::fprintf(stderr, "%s/report.html: %zu methods, %dx%d, %.1f s\n", a.output.c_str(), options.methods.size(),
                     view.crop.width(), view.crop.height(), total.seconds());
    }
}

}  // namespace burin
