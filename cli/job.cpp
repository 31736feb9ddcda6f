#include "cli/job.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "base/error.h"
#include "base/lower_extension.h"
#include "cli/sheet_wishes.h"
#include "mesh/model.h"
#include "mesh/text_scan.h"
#include "render/picture_notes.h"
#include "scene/color.h"
#include "shading/sheet/style_sheet.h"

namespace burin {
namespace {

bool is_scene_file(const std::string& path) { return lower_extension(path) == ".toml"; }

SceneDescription describe_input(const Arguments& a) {
    if (is_scene_file(a.input)) return read_scene_file(a.input, a.overrides, a.style);
    if (is_model_file(a.input)) return bare_model_scene(a.input, a.overrides, a.style);
    const bool is_stdin = a.input == "-" || a.input == "/dev/stdin";
    throw InputError(a.input +
                     (is_stdin ? ": standard input is not read, and the kind of an input is told by its suffix; burin "
                                 "reads .toml scenes and "
                               : ": unknown kind of input; burin reads .toml scenes and ") +
                     kModelExtensions + " models");
}

const CameraSettings& chosen_camera(const Scene& scene, const std::string& name) {
    if (name.empty()) return scene.cameras.front();
    const auto it = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                 [&](const CameraSettings& c) { return c.name == name; });
    if (it != scene.cameras.end()) return *it;
    std::string known;
    for (const CameraSettings& c : scene.cameras) {
        if (!c.name.empty()) known += (known.empty() ? "" : ", ") + c.name;
    }
    throw UsageError("--camera: there is no camera '" + printable(name) + "'; " +
                     (known.empty() ? "the input names none" : "the input has " + known));
}

bool changes_view(const Arguments& a) { return a.eye || a.target || a.up || a.fov_deg || a.ortho_height; }

/// The scene's camera; what the command line says about the view replaces it.
CameraSettings camera_settings(const Scene& scene, const Arguments& a) {
    CameraSettings camera = chosen_camera(scene, a.camera);
    if (!changes_view(a)) return camera;
    if (camera.to_world) camera = CameraSettings{};
    if (a.eye) {
        camera.eye = a.eye;
        camera.direction.reset();
    }
    if (a.target) camera.target = a.target;
    if (a.up) camera.up = a.up;
    if (a.fov_deg) {
        camera.fov_deg = *a.fov_deg;
        camera.orthographic = false;
    }
    if (a.ortho_height) {
        camera.height = a.ortho_height;
        camera.orthographic = true;
    }
    return camera;
}

/// Whether a message begins with a place in a sheet.
bool names_sheet(std::string_view message, const StyleSheet& sheet) {
    return message.starts_with(sheet.sets.front().where.file + ":");
}

PixelRect crop_of(const Arguments& a, int width, int height) {
    if (!a.crop) return {0, 0, width, height};
    const auto [x0, y0, x1, y1] = *a.crop;
    if (!(0 <= x0 && x0 < x1 && x1 <= width && 0 <= y0 && y0 < y1 && y1 <= height)) {
        throw UsageError("--crop: must lie within the image of " + std::to_string(width) + "x" +
                         std::to_string(height) + " pixels, with X0 < X1 and Y0 < Y1");
    }
    return {x0, y0, x1, y1};
}

}  // namespace

Scene load_input(const Arguments& a, const std::vector<OutputFile>& outputs) {
    refuse_to_overwrite(outputs, {a.input});
    SceneDescription description = describe_input(a);
    std::vector<std::string> files;
    if (description.sheet) {
        if (!description.sheet->file.empty()) files.push_back(description.sheet->file);
        SheetContext context;
        context.height_px = a.size ? (*a.size)[1] : description.picture.height;
        context.px_per_mm = a.dpi.value_or(description.picture.dpi) / 25.4;
        use_sheet(description, sheet_as_wished(*description.sheet, a, context));
    }
    const std::vector<std::string> unread = description.unread_line_keys;
    for (const ObjectDescription& object : description.objects) {
        if (!object.file.empty()) files.push_back(object.file);
    }
    refuse_to_overwrite(outputs, files);
    files.clear();
    Scene scene = load_scene(std::move(description),
                             {.threads = a.threads, .strict = a.strict, .budget = a.model_budget}, &files);
    refuse_to_overwrite(outputs, files);
    if (!a.quiet && a.command != Command::info) {  // which prints them with the rest
        for (const std::string& note : scene.notes)
            std::fprintf(stderr, "burin: note: %s\n", printable(note, 4000).c_str());
    }
    if (a.size) {
        scene.picture.width = (*a.size)[0];
        scene.picture.height = (*a.size)[1];
    }
    if (a.background == "transparent") {
        scene.picture.transparent = true;
        scene.picture.background.reset();
    } else if (!a.background.empty()) {
        scene.picture.background = color_from_hex(a.background);
    }
    if (a.samples_per_pixel) scene.abuffer.samples = *a.samples_per_pixel;
    if (a.mask_bits) scene.patel.mask_bits = *a.mask_bits;
    if (a.gbuffer_operators) scene.gbuffer.operators = *a.gbuffer_operators;
    if (a.supersample) scene.gbuffer.supersample = *a.supersample;
    if (a.lines) scene.lines.classes = *a.lines;
    if (!scene.sheet) {
        if (a.hidden) scene.lines.style.hidden.style = *a.hidden;
        if (a.line_width_px) scene.lines.style.width_px = *a.line_width_px;
        if (!a.line_color.empty()) scene.lines.style.colors.fill(*color_from_hex(a.line_color));
    } else if (!unread.empty() && !a.quiet) {
        std::fprintf(stderr, "burin: note: %s\n", note_on_unread_keys(unread).c_str());
    }
    if (a.crease_angle_deg) scene.lines.set_crease_angle((*a.crease_angle_deg)[0], (*a.crease_angle_deg)[1]);
    if (a.finds_all && scene.sheet) {
        scene.finds_all = true;
        scene.lines.classes = LineClassSet::all();
    }
    if (a.frame) scene.frame.number = *a.frame;
    if (a.dpi) scene.picture.dpi = *a.dpi;
    return scene;
}

Camera camera_of(const Scene& scene, const Arguments& a) {
    const CameraSettings settings = camera_settings(scene, a);
    const std::string place = settings.where.line > 0 ? to_string(settings.where) : a.input;
    const double aspect = static_cast<double>(scene.picture.width) / scene.picture.height;
    try {
        return resolve_camera(settings, scene_points(scene), aspect);
    } catch (const InputError& error) {
        if (changes_view(a)) throw UsageError("--eye, --target, --up, --fov, --ortho: " + std::string(error.what()));
        throw InputError(place + ": " + error.what());
    }
}

Frame frame_of(const Scene& scene, const Camera& camera, const Arguments& a, const PreparedScene* prepared) {
    const int width = scene.picture.width, height = scene.picture.height;
    const PixelRect crop = crop_of(a, width, height);
    try {
        return make_frame(scene, camera, width, height, crop, prepared);
    } catch (const InputError& error) {
        if (scene.sheet && names_sheet(error.what(), *scene.sheet)) throw;
        throw InputError(a.input + ": " + error.what());
    }
}

}  // namespace burin
