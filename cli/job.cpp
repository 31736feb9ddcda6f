#include "cli/job.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "base/error.h"
#include "base/lower_extension.h"
#include "cli/blur.h"
#include "cli/sheet_wishes.h"
#include "mesh/model.h"
#include "mesh/text_scan.h"
#include "render/picture_notes.h"
#include "scene/color.h"
#include "scene/paper_camera.h"
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
CameraSettings viewing_camera(const Scene& scene, const Arguments& a) {
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

/// That camera with the area of the paper that the view fills, and the height that its scale says.
CameraSettings camera_settings(const Scene& scene, const Arguments& a) {
    CameraSettings camera = viewing_camera(scene, a);
    set_lens(a, camera);
    const PaperSettings& paper = scene.picture.paper;
    if (paper.scale && a.ortho_height)
        throw UsageError("--ortho: cannot stand beside picture.scale, which says the same; remove one");
    try {
        see_on_paper(scene.picture, camera);
    } catch (const InputError& error) {
        if (a.scale) throw UsageError("--scale: " + std::string(error.what()));
        throw InputError(a.input + ": [picture] scale: " + error.what());
    }
    return camera;
}

/// Whether all that a scene shows comes from glTF files, which are in metres.
bool is_all_gltf(const SceneDescription& scene) {
    return std::all_of(scene.objects.begin(), scene.objects.end(), [](const ObjectDescription& object) {
        const std::string suffix = lower_extension(object.file);
        return suffix == ".glb" || suffix == ".gltf";
    });
}

/// What the command line says about size and paper replaces what the scene says.
void set_picture_size(const Arguments& a, SceneDescription& scene) {
    PictureSettings& picture = scene.picture;
    PaperSettings& paper = picture.paper;
    const Page& page = page_of(a.page);
    if (a.page != PagePreset::none && !paper.size_mm) paper.size_mm = paper_named(page.paper);
    if (a.page != PagePreset::none && paper.margin_mm == std::array<double, 4>{}) paper.margin_mm = page.margin_mm;
    if (a.paper_mm) paper.size_mm = a.paper_mm;
    if (a.margin_mm) paper.margin_mm = *a.margin_mm;
    if (a.scale) paper.scale = a.scale;
    if (a.unit_mm) paper.unit_mm = a.unit_mm;
    if (!paper.unit_mm) paper.unit_mm = is_all_gltf(scene) ? 1000 : 1;
    if (a.dpi && paper.size_mm) {
        throw UsageError("--dpi: cannot stand beside paper, whose size and that in pixels (-r) say it; remove one");
    }
    if (a.size_is_longer_side && !paper.size_mm) {
        throw UsageError("--size: must be WIDTHxHEIGHT in pixels, got '" + std::to_string(a.size->front()) +
                         "'; one number is enough with --paper");
    }
    if (a.size) {
        picture.width = (*a.size)[0];
        picture.height = (*a.size)[1];
    }
    if (a.dpi) picture.dpi = *a.dpi;
    fit_to_paper(picture);
    try {
        size_within_margins_mm(picture);
    } catch (const InputError& error) {
        if (a.margin_mm || a.paper_mm || a.page != PagePreset::none)
            throw UsageError("--margin: " + std::string(error.what()));
        throw InputError(a.input + ": [picture] margin: " + error.what());
    }
}

/// Notes a scene that does not fit on the paper at the scale that is wanted.
void note_if_cut_off(const Scene& scene, CameraSettings camera, double aspect) {
    if (!scene.picture.paper.scale || camera.to_world || camera.eye) return;
    const double height = *camera.height;
    camera.height.reset();
    const double needed = camera.fit * resolve_camera(camera, scene_points(scene), aspect).height;
    if (needed <= height) return;
    const double fitting = *scene.picture.paper.scale * height / needed;
    std::fprintf(stderr, "burin: note: at %s the view reaches beyond the %s; %s would fit\n",
                 text_of_scale(*scene.picture.paper.scale).c_str(),
                 scene.picture.paper.margin_mm == std::array<double, 4>{} ? "paper" : "margins",
                 text_of_scale(round_scale_down(fitting)).c_str());
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
    set_picture_size(a, description);
    std::vector<std::string> files;
    if (description.sheet) {
        if (!description.sheet->file.empty()) files.push_back(description.sheet->file);
        SheetContext context;
        context.height_px = description.picture.height;
        context.px_per_mm = description.picture.dpi / 25.4;
        Arguments wished = a;
        // ISO 128: thicker lines on sheets above A2.
        constexpr double kLongerSideOfA2 = 594, kThickMm = 0.7;
        const glm::dvec2 paper = size_in_mm(description.picture);
        if (a.page == PagePreset::iso128 && a.has_style_of_page && !a.line_width_px &&
            std::max(paper.x, paper.y) > kLongerSideOfA2)
            wished.line_width_px = kThickMm * context.px_per_mm;
        use_sheet(description, sheet_as_wished(*description.sheet, wished, context));
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
    return scene;
}

Camera camera_of(const Scene& scene, const Arguments& a) {
    const CameraSettings settings = camera_settings(scene, a);
    const std::string place = settings.where.line > 0 ? to_string(settings.where) : a.input;
    const double aspect = static_cast<double>(scene.picture.width) / scene.picture.height;
    try {
        if (!a.quiet) note_if_cut_off(scene, settings, aspect);
        return resolve_camera(settings, scene_points(scene), aspect);
    } catch (const InputError& error) {
        if (changes_view(a)) throw UsageError("--eye, --target, --up, --fov, --ortho: " + std::string(error.what()));
        throw InputError(place + ": " + error.what());
    }
}

std::vector<ViewOnSheet> views_of(const Scene& scene, const Arguments& a) {
    if (a.views.empty()) return {};
    const glm::dvec3 up = a.up.value_or(scene.cameras.front().up.value_or(glm::dvec3(0, 1, 0)));
    if (!(glm::length(up) > 0)) throw UsageError("--up: the vector is zero; give a direction");
    try {
        return views_on_sheet(a.views, a.view_projection, scene.picture, up, scene_points(scene));
    } catch (const InputError& error) {
        throw InputError(a.input + ": " + error.what());
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
