#include "cli/commands.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "base/atomic_file.h"
#include "base/interrupt.h"
#include "base/json_writer.h"
#include "base/limit_error.h"
#include "base/lower_extension.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "cli/blur.h"
#include "cli/job.h"
#include "cli/output_options.h"
#include "cli/sheet_views.h"
#include "cli/vector_output.h"
#include "image/image_io.h"
#include "mesh/text_scan.h"
#include "methods/abuffer.h"
#include "methods/explain_strokes.h"
#include "methods/gbuffer/gbuffer.h"
#include "methods/patel/explain.h"
#include "methods/patel/patel.h"
#include "output/film_files.h"
#include "output/lines_file.h"
#include "render/close_cracks.h"
#include "render/copied_objects.h"
#include "render/layer_names.h"
#include "render/picture_notes.h"
#include "scene/plain_sheet.h"

namespace burin {
namespace {

struct StageTimes {
    double load_s = 0, write_s = 0, total_s = 0;
    RenderStats render;
    std::optional<VectorStats> paths;
};

/// The median of several renders, stage by stage.
RenderStats median_of(std::vector<RenderStats> runs) {
    RenderStats result = runs.back();
    for (double RenderStats::*stage : {&RenderStats::prepare_s, &RenderStats::raster_s, &RenderStats::resolve_s,
                                       &RenderStats::lines_s, &RenderStats::shade_s}) {
        const auto middle = runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2);
        std::nth_element(runs.begin(), middle, runs.end(),
                         [&](const auto& x, const auto& y) { return x.*stage < y.*stage; });
        result.*stage = (*middle).*stage;
    }
    return result;
}

double frame_seconds(const RenderStats& s) { return s.prepare_s + s.raster_s + s.resolve_s + s.lines_s + s.shade_s; }

std::string stats_json(const StageTimes& times, const Frame& frame, const Method& method) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    JsonWriter json;
    json.begin_object();
    json.key("method").value(method.name);
    json.key("width").value(frame.width).key("height").value(frame.height);
    json.key("threads").value(times.render.threads);
    json.key("triangles").value(times.render.triangles);
    json.key("fragments").value(times.render.fragments);
    json.key("peak_rss_bytes").value(std::uint64_t{1024} * static_cast<std::uint64_t>(usage.ru_maxrss));
    if (times.paths) add_counts(json, *times.paths);
    json.key("stages").begin_object();
    json.key("load").value(times.load_s);
    json.key("prepare").value(times.render.prepare_s);
    json.key("raster").value(times.render.raster_s);
    json.key("resolve").value(times.render.resolve_s);
    json.key("lines").value(times.render.lines_s);
    json.key("shade").value(times.render.shade_s);
    if (times.paths) add_stages(json, *times.paths);
    json.key("write").value(times.write_s);
    json.key("total").value(times.total_s);
    json.end_object().end_object();
    return json.text();
}

/// Refuses hidden lines that the command line asks for with a method that has none: only the A-buffer keeps the
/// surfaces behind the first. Returns whether the scene asks for hidden lines.
bool refuse_hidden_lines(const Arguments& a, const Method& method, Scene& scene) {
    const bool has_hidden_lines = scene.lines.style.hidden.style != HiddenStyle::none;
    if (method.name == "abuffer") return has_hidden_lines;
    if (a.hidden && *a.hidden != HiddenStyle::none) {
        throw UsageError("--hidden: method " + std::string(method.name) + " draws no hidden lines; use method abuffer");
    }
    scene.lines.style.hidden.style = HiddenStyle::none;
    return has_hidden_lines;
}

/// Only the A-buffer draws by style sheets.
void refuse_sheet(const Scene& scene, const std::string& what) {
    if (scene.sheet) throw UsageError("--style: " + what + "; draw with method abuffer, or remove the style sheet");
}

/// Refuses a shading that varies over surfaces where a method draws none.
void refuse_varied_shading(const Scene& scene, const Method& method) {
    if (!varies(scene.surfaces.shading) || method.name == "abuffer" || method.name == "reference") return;
    throw UsageError("[surfaces]: method " + std::string(method.name) +
                     " fills surfaces with paper, lambert or none only; draw with method abuffer or reference, or "
                     "choose another shading");
}

/// Notes lines of the input that are not drawn.
void note_loose_edges(const Frame& frame, const Method& method) {
    if (const std::string missing = note_on_missing_marks(frame); !missing.empty()) {
        const std::string draw_it =
            frame.scene->sheet
                ? ""
                : "; --lines " + to_string(frame.scene->lines.classes | LineClass::mark) + " has it, too";
        std::fprintf(stderr, "burin: note: %s%s\n", missing.c_str(), draw_it.c_str());
        return;
    }
    std::uint64_t count = 0;
    for (const SurfaceInstance& instance : frame.surfaces.instances) count += instance.mesh->loose_edges.size();
    if (count > 0 && !method.draws_loose_edges && method.draws.has(LineClass::mark)) {
        const std::string lines = count == 1 ? "1 line" : std::to_string(count) + " lines";
        std::fprintf(
            stderr,
            "burin: note: method %s draws edges of polygons only, and leaves out %s of the input; abuffer draws them\n",
            std::string(method.name).c_str(), lines.c_str());
    }
}

/// Notes what a user should know before the picture surprises.
void note_limits(const Arguments& a, const Frame& frame, const Method& method, bool has_hidden_lines,
                 const OutputOptions& output) {
    if (a.quiet) return;
    if (a.names_layers && output.format != OutputFormat::exr) {
        std::fputs("burin: note: only an EXR has --layers; this file gets the beauty layer\n", stderr);
    }
    if (a.has_vector_options && !is_vector(output.format)) {
        std::fputs("burin: note: --tolerance, --chord-sag, --dashes, --group, --ids and --merge are for vector files\n",
                   stderr);
    }
    if (output.format == OutputFormat::exr && (a.bits != Arguments().bits || !a.background.empty())) {
        std::fputs(
            "burin: note: --bits and --background are for PNG and TIFF; an EXR is half precision without paper\n",
            stderr);
    }
    if (is_vector(output.format) && frame.scene->surfaces.shading == SurfaceShading::lambert) {
        std::fputs("burin: note: a vector file has lines only; the surfaces are left out\n", stderr);
    }
    const auto note_if_unused = [&](bool is_given, const char* option, std::string_view user) {
        if (!is_given || method.name == user) return;
        std::fprintf(stderr, "burin: note: %s is for method %s and changes nothing here\n", option,
                     std::string(user).c_str());
    };
    note_if_unused(a.mask_bits.has_value(), "--mask", "patel");
    note_if_unused(a.samples_per_pixel.has_value(), "--samples", "abuffer");
    note_if_unused(a.gbuffer_operators.has_value(), "--operator", "gbuffer");
    note_if_unused(a.supersample.has_value(), "--supersample", "gbuffer");
    note_if_unused(has_hidden_lines, "lines.hidden", "abuffer");
    note_if_unused(has_transparent_surfaces(*frame.scene), "the opacity of materials", "abuffer");
    const LineSettings& lines = frame.scene->lines;
    note_loose_edges(frame, method);
    const auto missing = LineClassSet::from_bits(lines.classes.bits & ~unsigned{method.draws.bits});
    if (!missing.empty()) {
        std::fprintf(stderr, "burin: note: method %s cannot draw %s\n", std::string(method.name).c_str(),
                     to_string(missing).c_str());
    }
    if (lines.style.side != StrokeSide::both && method.name != "abuffer" && method.name != "patel" &&
        method.name != "reference") {
        std::fprintf(
            stderr,
            "burin: note: method %s draws strokes on both sides; lines.side is for abuffer, patel and reference\n",
            std::string(method.name).c_str());
    }
    note_if_unused(lines.style.filter != PixelFilter::box, "lines.filter", "abuffer");
    note_if_unused(lines.style.dash_px.has_value(), "lines.dash", "abuffer");
    note_if_unused(lines.contours != Contours::mesh, "lines.contours", "abuffer");
    if (lines.crease_fade_deg > 0 && method.name != "abuffer") {
        std::fprintf(stderr, "burin: note: method %s fades no creases; it draws them from %.4g degrees on\n",
                     std::string(method.name).c_str(), lines.crease_angle_deg);
    }
    const double wanted = lines.style.width_px;
    const double drawn = patel_line_width_px(frame.scene->patel.mask_bits, wanted);
    if (method.name == "patel" && std::abs(drawn - wanted) > 0.01 * wanted) {
        std::fprintf(stderr, "burin: note: method patel draws lines %.3g px wide with %d-bit masks, not %.3g px\n",
                     drawn, frame.scene->patel.mask_bits, wanted);
    }
    const double gbuffer_px = gbuffer_line_width_px(*frame.scene);
    if (method.name == "gbuffer" && std::abs(gbuffer_px - wanted) > 0.01 * wanted) {
        std::fprintf(stderr,
                     "burin: note: method gbuffer draws lines about %.3g px wide, by direction %.2g to %.2g px, "
                     "with --supersample %d, not %.3g px\n",
                     gbuffer_px, gbuffer_px / std::sqrt(2.0), gbuffer_px * std::sqrt(2.0),
                     frame.scene->gbuffer.supersample, wanted);
    }
}

LayerSet layers_for(const Scene& scene, const Arguments& a) {
    try {
        return layers_of(scene, a.names_layers ? std::optional(a.layers) : std::nullopt);
    } catch (const UsageError& error) {
        throw UsageError("--layers: " + std::string(error.what()));
    }
}

/// Paths are made of what a style sheet draws; the look of [lines] is one, too.
void draw_by_sheet(Scene& scene) {
    if (!scene.sheet) scene.sheet = std::make_shared<const StyleSheet>(plain_sheet(scene.lines));
    scene.names_lines = true;
}

Film make_film(const Frame& frame, const LayerSet& layers, bool in_bands, const std::string& path) {
    try {
        const PixelRect display{0, 0, frame.width, frame.height};
        Film film = in_bands ? Film::in_bands(display, frame.crop, layers, frame.criteria.classes)
                             : Film(display, frame.crop, layers, frame.criteria.classes);
        if (!film.channels().empty()) return film;
    } catch (const InputError& error) {
        throw InputError(path + ": " + error.what());
    }
    throw UsageError("--layers: coverage has a channel per line class, and no class is drawn");
}

}  // namespace

void run_render(const Arguments& a) {
    const OutputOptions output = output_options(a);
    std::vector<OutputFile> outputs = {{"--output", output.path}};
    if (writes_stats_file(a)) outputs.push_back({"--stats", a.stats});
    if (!a.save_lines.empty()) outputs.push_back({"--save-lines", a.save_lines});
    refuse_to_overwrite(outputs, {a.input});
    for (const OutputFile& file : outputs) check_output_file(file.path);
    const bool has_paths = is_vector(output.format);
    if (output.format != OutputFormat::exr && !has_paths) check_display_writer(output.path);
    const Method& method = a.method.empty() ? methods().front() : *find_method(a.method);

    if (has_paths && method.name != "abuffer") {
        throw UsageError("--output: method " + std::string(method.name) +
                         " makes pixels only; draw a vector file with method abuffer");
    }
    if (a.memory_bytes > 0 && method.name != "abuffer") {
        throw UsageError("--memory: method " + std::string(method.name) + " cannot render in pieces; abuffer can");
    }

    const bool shows_bar = !a.quiet && isatty(STDERR_FILENO) != 0;
    Progress progress(a.alf_progress ? ProgressStyle::alf : (shows_bar ? ProgressStyle::bar : ProgressStyle::none));
    Stopwatch total, watch;
    StageTimes times;
    Scene scene = load_input(a, outputs);
    if (method.name != "abuffer") refuse_sheet(scene, "method " + std::string(method.name) + " draws no style sheets");
    refuse_varied_shading(scene, method);
    if (!scene.sheet && (!a.save_lines.empty() || a.finds_all)) {
        throw UsageError((a.save_lines.empty() ? std::string("--find") : std::string("--save-lines")) +
                         ": lines are found for a style sheet; give one with --style");
    }
    const bool has_hidden_lines = refuse_hidden_lines(a, method, scene);
    if (has_paths) draw_by_sheet(scene);
    const std::vector<ViewOnSheet> views = views_of(scene, a);
    const Camera camera = views.empty() ? camera_of(scene, a) : views.front().camera;
    empty_copied_objects(scene);
    close_cracks(scene, camera, scene.picture.width, scene.picture.height);
    PreparedScene prepared;
    if (method.name == "abuffer") prepared = prepare_for_abuffer(scene, a.threads, a.memory_bytes > 0);
    const Frame frame = frame_of(scene, camera, a, &prepared);
    times.load_s = watch.lap();
    note_limits(a, frame, method, has_hidden_lines, output);

    const Blur blur = blur_of(scene, camera, a, false, has_paths);
    const MomentAt moment_at = [&](double, MomentUse) { return Moment{&scene, camera, &prepared}; };
    const int sub_frames = sub_frame_count(blur, moment_at, frame.width, frame.height);
    LayerSet layers = layers_for(scene, a);
    if (output.format != OutputFormat::exr) layers = LayerSet{true, false, false, false, false, false, false, false};
    // An EXR is compressed while it is drawn; but not when times are taken.
    const bool in_bands = output.format == OutputFormat::exr && a.repeat == 0 && views.empty() && sub_frames == 1 &&
                          method.finishes_in_bands != nullptr && method.finishes_in_bands(frame);
    Film film = make_film(frame, layers, in_bands, output.path);
    RunOptions run{a.threads, &progress, a.memory_bytes};
    std::optional<BandWriter> writer;
    if (in_bands) {
        writer.emplace(film, output);
        run.finished_band = [&writer](std::size_t band) { writer->write(band); };
    }
    if (!a.save_lines.empty()) {
        run.found_lines = [&a](const FoundLines& lines, const Film& surfaces) {
            AtomicFile file(a.save_lines);
            write_lines_file(file, lines, a.saves_surface ? kept_surface(surfaces) : KeptSurface{});
            file.commit();
        };
    }
    VectorDrawing drawing;
    const SheetViews sheet{scene, a, views, &prepared};
    const auto blurred = [&] {
        if (run.progress != nullptr) progress.plan(sub_frames_drawn(sub_frames, run, film));
        return render_blurred(method, blur, sub_frames, moment_at, frame.width, frame.height, run, film, [&] {
            if (run.progress != nullptr) progress.next_part("rendering", 1);
        });
    };
    const auto draw = [&] {
        if (sub_frames > 1) return blurred();
        if (!has_paths) return views.empty() ? method.render(frame, run, film) : sheet.draw(method, run, film);
        RenderStats stats;
        if (VectorStats& paths = times.paths.emplace(); views.empty()) {
            const FoundLines lines = find_styled_lines(frame, run, film, stats);
            drawing = draw_paths(lines, frame, a, paths, stats.notes);
        } else {
            stats = sheet.draw_as_paths(run, film, drawing, paths);
        }
        finish_drawing(scene.picture, a, drawing, *times.paths, stats.notes);
        return stats;
    };
    try {
        times.render = draw();
    } catch (const LimitError& error) {
        throw InputError(a.input + ": --memory: " + error.what());
    } catch (const InputError& error) {
        if (writer && writer->has_failed()) throw;
        const std::string message = error.what();  // begins with the file where it has a place
        throw InputError(message.starts_with(a.input + ":") ? message : a.input + ": " + message);
    }
    run.found_lines = nullptr;
    if (a.repeat > 0) {
        run.progress = nullptr;
        std::vector<RenderStats> runs;
        for (int i = 0; i < a.repeat; ++i) runs.push_back(draw());
        times.render = median_of(std::move(runs));
    }
    watch.lap();
    const bool counts = (method.name == "abuffer" || method.name == "patel") && !a.crop;
    const bool has_lines = std::any_of(scene.meshes.begin(), scene.meshes.end(),
                                       [](const Mesh& mesh) { return !mesh.loose_edges.empty(); });
    if (counts && times.render.fragments == 0 && !has_lines && !a.quiet)
        std::fprintf(stderr, "burin: note: %s\n", kNoSurfaceIsSeen);
    if (!a.quiet) {
        for (const std::string& note : times.render.notes)
            std::fprintf(stderr, "burin: note: %s\n", printable(note, 4000).c_str());
    }
    if (writer) {
        writer->finish();
    } else if (has_paths) {
        write_vector(drawing, a, output);
    } else {
        write_output(frame, film, output);
    }
    times.write_s = times.render.write_s + watch.lap();
    progress.finish();
    times.total_s = a.repeat > 0 ? times.load_s + frame_seconds(times.render) + times.write_s : total.seconds();
    if (!a.stats.empty()) write_stats(a.stats, stats_json(times, frame, method));
    if (a.verbose || shows_bar) {
        std::fprintf(stderr, "%s: %dx%d, %llu triangles, %.2f s (read %.2f, draw %.2f, write %.2f)\n",
                     output.path.c_str(), frame.crop.width(), frame.crop.height(),
                     static_cast<unsigned long long>(times.render.triangles), total.seconds(), times.load_s,
                     frame_seconds(times.render), times.write_s);
    }
}

void run_explain(const Arguments& a) {
    if (!a.method.empty() && a.method != "abuffer" && a.method != "patel") {
        throw UsageError("--method: only the masks of abuffer and patel can be explained, not those of " + a.method);
    }
    Scene scene = load_input(a);
    if (a.method == "patel") refuse_sheet(scene, "method patel draws no style sheets");
    const Camera camera = camera_of(scene, a);
    empty_copied_objects(scene);
    close_cracks(scene, camera, scene.picture.width, scene.picture.height);
    const Frame frame = frame_of(scene, camera, a);
    const auto [x, y] = *a.pixel;
    if (x < 0 || y < 0 || x >= frame.width || y >= frame.height) {
        throw UsageError("--pixel: must lie within the image of " + std::to_string(frame.width) + "x" +
                         std::to_string(frame.height) + " pixels");
    }
    if (a.json) {
        if (!frame.sheet) throw UsageError("--json: has the strokes of a style sheet; give one with --style");
        std::fputs(json_of(explain_strokes(frame, x, y), x, y).c_str(), stdout);
        return;
    }
    std::fputs(explain_pixel(frame, x, y).c_str(), stdout);
    if (frame.sheet) {
        std::fputs(text_of(explain_strokes(frame, x, y)).c_str(), stdout);
    } else if (a.method != "patel") {
        std::fputs(drawn_by_abuffer(frame, x, y).c_str(), stdout);
    }
}

void run_methods(const Arguments& a) {
    if (!a.json) {
        for (const Method& m : methods()) {
            std::printf("%-16s %s\n%-16s draws %s\n", std::string(m.name).c_str(), std::string(m.source).c_str(), "",
                        to_string(m.draws).c_str());
        }
        return;
    }
    JsonWriter json;
    json.begin_object().key("methods").begin_array();
    for (const Method& m : methods()) {
        json.begin_object();
        json.key("name").value(m.name);
        json.key("source").value(m.source);
        json.key("draws").begin_array();
        for (std::size_t c = 0; c < kLineClassCount; ++c) {
            if (m.draws.has(static_cast<LineClass>(c))) json.value(kLineClassNames[c]);
        }
        json.end_array().end_object();
    }
    json.end_array().end_object();
    std::fputs(json.text().c_str(), stdout);
}

}  // namespace burin
