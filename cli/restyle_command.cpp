#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/json_writer.h"
#include "base/stopwatch.h"
#include "base/stream_store.h"
#include "cli/commands.h"
#include "cli/output_files.h"
#include "cli/output_options.h"
#include "cli/sheet_wishes.h"
#include "cli/vector_output.h"
#include "mesh/text_scan.h"
#include "methods/abuffer.h"
#include "output/film_files.h"
#include "output/lines_file.h"
#include "render/layer_names.h"
#include "render/sheet_context.h"
#include "scene/color.h"
#include "scene/sheet_library.h"
#include "shading/ink/found_needs.h"
#include "shading/sheet/compiled_sheet.h"

namespace burin {
namespace {

/// The scene that the lines were found in, as far as drawing them asks.
Scene scene_of(const LinesFile& file, const Arguments& a) {
    Scene scene;
    scene.picture.width = file.lines.width_px;
    scene.picture.height = file.lines.height_px;
    scene.picture.dpi = file.lines.dpi;
    scene.frame.number = file.lines.frame;
    scene.frame.fps = file.lines.fps;
    scene.picture.transparent = a.background == "transparent";
    if (!a.background.empty() && !scene.picture.transparent) scene.picture.background = color_from_hex(a.background);
    for (const ObjectOfLines& object : file.lines.objects) {
        SceneObject named;
        named.name = object.name;
        scene.objects.push_back(std::move(named));
    }
    for (std::size_t i = 0; i < file.lines.materials.size(); ++i)
        scene.materials.push_back({file.lines.materials[i], file.lines.material_colors[i]});
    return scene;
}

LayerSet layers_for(const Arguments& a, const Scene& scene, const OutputOptions& output, const LinesFile& file) {
    if (output.format != OutputFormat::exr) return {true, false, false, false, false, false, false, false, {}};
    const bool has_surface = !file.surface.pixels.empty();
    if (!a.names_layers) {
        LayerSet layers = layers_of(scene, std::nullopt);
        layers.depth = layers.normal = layers.ids = false;
        layers.surface = has_surface;
        return layers;
    }
    if (a.layers.depth || a.layers.normal || a.layers.ids)
        throw UsageError("--layers: a file of lines has no Z, N and ids; render has them");
    if (a.layers.crypto.has_any() || a.layers.line || a.layers.motion)
        throw UsageError("--layers: a file of lines has no crypto, line and motion; render has them");
    if (a.layers.surface && !has_surface)
        throw UsageError("--layers: the lines were saved without surfaces; render again with --save-surface");
    try {
        return layers_of(scene, a.layers);
    } catch (const UsageError& error) {
        throw UsageError("--layers: " + std::string(error.what()));
    }
}

/// Puts the surfaces that were kept, or none.
void put_surfaces(const KeptSurface& surface, const Frame& frame, Film& film) {
    for (int y = frame.crop.y0; y < frame.crop.y1; ++y) {
        film.put_background(frame.crop.x0, frame.crop.x1, y);
        if (surface.pixels.empty()) continue;
        finish_stream_stores();
        for (int x = frame.crop.x0; x < frame.crop.x1; ++x) {
            const std::size_t i =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(surface.width) + static_cast<std::size_t>(x);
            const auto& p = surface.pixels[i];
            film.replace_surface(x, y, {p[0], p[1], p[2], p[3]});
        }
    }
    finish_stream_stores();
}

/// Only render draws surfaces.
std::vector<std::string> notes_on_surfaces(const Arguments& a, bool has_saved_ones) {
    std::vector<std::string> notes;
    for (const Override& o : a.overrides) {
        if (o.key != "style.surfaces" && !o.key.starts_with("style.surfaces.")) continue;
        notes.push_back("--set " + o.key + " changes nothing: " +
                        (has_saved_ones ? "surfaces stay as they were saved; render draws them again"
                                        : "the lines were saved without surfaces; render draws them"));
    }
    return notes;
}

}  // namespace

void run_restyle(const Arguments& a) {
    const OutputOptions output = output_options(a);
    std::vector<OutputFile> outputs = {{"--output", output.path}};
    if (writes_stats_file(a)) outputs.push_back({"--stats", a.stats});
    const auto source = find_sheet(a.style, {});
    if (!source) throw UsageError("--style: " + no_such_sheet(a.style));
    std::vector<std::string> inputs = {a.input};
    if (!source->file.empty()) inputs.push_back(source->file);
    refuse_to_overwrite(outputs, inputs);
    for (const OutputFile& file : outputs) check_output_file(file.path);
    const bool has_paths = is_vector(output.format);
    if (output.format != OutputFormat::exr && !has_paths) check_display_writer(output.path);
    for (const Override& o : a.overrides) {
        if (!o.key.starts_with("style."))
            throw UsageError("--set " + printable(o.key) + ": only values of the style sheet can be set here");
    }
    Stopwatch watch, total;
    LinesFile file = read_lines_file(a.input);
    const double load_s = watch.lap();
    Scene scene = scene_of(file, a);
    Frame frame;
    frame.scene = &scene;
    frame.width = file.lines.width_px;
    frame.height = file.lines.height_px;
    frame.crop = {0, 0, frame.width, frame.height};
    if (a.crop) {
        const auto [x0, y0, x1, y1] = *a.crop;
        if (x0 < 0 || y0 < 0 || x1 > frame.width || y1 > frame.height || x0 >= x1 || y0 >= y1)
            throw UsageError("--crop: must be a part of the picture of " + std::to_string(frame.width) + "x" +
                             std::to_string(frame.height) + " pixels");
        frame.crop = {x0, y0, x1, y1};
    }
    frame.surfaces.projection = file.lines.projection;
    frame.camera.to_world = file.lines.camera_to_world;
    frame.camera.orthographic = file.lines.projection.orthographic;
    scene.frame = {file.lines.frame, file.lines.fps};
    scene.sheet = sheet_as_wished(read_sheet(*source, a.overrides), a, sheet_context_of(frame));
    scene.lines.style.filter = scene.sheet->filter.value_or(file.lines.filter);
    file.lines.light = scene.sheet->light;
    frame.sheet = std::make_shared<CompiledSheet>(*scene.sheet, sheet_context_of(frame));
    frame.criteria.classes = file.lines.classes;
    if (const std::string missing = missing_for(*scene.sheet, frame.sheet->needs(), file.lines); !missing.empty()) {
        const SheetNeeds& needs = frame.sheet->needs();
        const std::string again = find_all_keeps(*scene.sheet, needs, file.lines)
                                      ? "render again with this sheet, or with --find all, and --save-lines"
                                      : "render again with this sheet and --save-lines";
        throw InputError(a.input + ": the file lacks what the style sheet needs: " + missing + "; " + again);
    }
    const PixelRect display{0, 0, frame.width, frame.height};
    Film film(display, frame.crop, layers_for(a, scene, output, file), frame.criteria.classes);
    if (film.channels().empty())
        throw UsageError("--layers: coverage has a channel per line class, and no class is drawn");
    put_surfaces(file.surface, frame, film);
    std::vector<std::string> notes = notes_on_surfaces(a, !file.surface.pixels.empty());
    VectorDrawing drawing;
    VectorStats paths;
    if (has_paths) {
        drawing = draw_paths(file.lines, frame, a, paths, notes);
        finish_drawing(scene.picture, a, drawing, paths, notes);
        if (!file.lines.has_chains)
            notes.push_back(
                "the lines were saved beside pixels, which need no chains of visible lines, so some paths are divided "
                "otherwise than those of render; save lines beside a vector file, or with --find all");
        if (!file.surface.pixels.empty())
            notes.push_back(
                "surfaces were saved as pixels, which a vector file has none of; render has them as regions");
    } else {
        draw_found_lines(frame, file.lines, output.threads, film, notes);
    }
    const double draw_s = watch.lap();
    if (!a.quiet) {
        for (const std::string& note : notes) std::fprintf(stderr, "burin: note: %s\n", printable(note, 4000).c_str());
    }
    if (has_paths) {
        write_vector(drawing, a, output);
    } else {
        write_output(frame, film, output);
    }
    const double write_s = watch.lap();
    if (!a.stats.empty()) {
        JsonWriter json;
        json.begin_object().key("width").value(frame.width).key("height").value(frame.height);
        json.key("threads").value(output.threads);
        if (has_paths) add_counts(json, paths);
        json.key("stages").begin_object();
        json.key("load").value(load_s).key("lines").value(draw_s);
        if (has_paths) add_stages(json, paths);
        json.key("write").value(write_s);
        json.key("total").value(total.seconds()).end_object().end_object();
        write_stats(a.stats, json.text());
    }
    if (a.verbose)
        std::fprintf(stderr, "%s: %dx%d, %.2f s\n", output.path.c_str(), frame.width, frame.height, total.seconds());
}

}  // namespace burin
