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

SceneDescription read_description(const Arguments& a) {
    if (is_scene_file(a.input)) return read_scene_file(a.input, a.overrides, a.style);
    if (is_model_file(a.input)) return bare_model_scene(a.input, a.overrides, a.style);
    const bool is_stdin = a.input == "-" || a.input == "/dev/stdin";
    throw InputError(a.input +
                     (is_stdin ? ": standard input is not read, and the kind of an input is told by its suffix; burin "
                                 "reads .toml scenes and "
                               : ": unknown kind of input; burin reads .toml scenes and ") +
                     kModelExtensions + " models");
}

const CameraSettings& chosen_camera(const std::vector<CameraSettings>& cameras, const std::string& name) {
    if (name.empty()) return cameras.front();
    const auto it =
        std::find_if(cameras.begin(), cameras.end(), [&](const CameraSettings& c) { return c.name == name; });
    if (it != cameras.end()) return *it;
    std::string known;
    for (const CameraSettings& c : cameras) {
        if (!c.name.empty()) known += (known.empty() ? "" : ", ") + c.name;
    }
    throw UsageError("--camera: there is no camera '" + printable(name) + "'; " +
                     (known.empty() ? "the input names none" : "the input has " + known));
}

bool changes_view(const Arguments& a) { return a.eye || a.target || a.up || a.fov_deg || a.ortho_height; }

/// The scene's camera; what the command line says about the view replaces it.
CameraSettings viewing_camera(const std::vector<CameraSettings>& cameras, const Arguments& a) {
    CameraSettings camera = chosen_camera(cameras, a.camera);
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
CameraSettings camera_settings(const std::vector<CameraSettings>& cameras, const PictureSettings& picture,
                               const Arguments& a) {
    CameraSettings camera = viewing_camera(cameras, a);
    set_lens(a, camera);
    const PaperSettings& paper = picture.paper;
    if (paper.scale && a.ortho_height)
        throw UsageError("--ortho: cannot stand beside picture.scale, which says the same; remove one");
    try {
        see_on_paper(picture, camera);
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

/// A scene that fills less than this of the space on paper is hardly seen: its unit may be another one.
constexpr double kTiny = 0.05;

void note_if_tiny(double scale, double fitting_scale) {
    if (scale >= kTiny * fitting_scale) return;
    std::fprintf(stderr,
                 "burin: note: at %s the drawing fills less than a twentieth of the paper's width and height; %s would "
                 "fit (--unit says the unit of the scene)\n",
                 text_of_scale(scale).c_str(), text_of_scale(round_scale_down(fitting_scale)).c_str());
}

/// Notes a scene that does not fit on the paper at the scale that is wanted, or is lost on it.
void note_on_scale(const Scene& scene, const PointSource& points, CameraSettings camera, double aspect) {
    if (!scene.picture.paper.scale || camera.to_world) return;
    const double height = *camera.height;
    camera.height.reset();
    const double needed = camera.fit * resolve_camera(camera, points, aspect).height;
    const double fitting = *scene.picture.paper.scale * height / needed;
    note_if_tiny(*scene.picture.paper.scale, fitting);
    if (needed <= height || camera.eye) return;  // a view from a given place may be one of a detail
    std::fprintf(stderr, "burin: note: at %s the view reaches beyond the %s; %s would fit\n",
                 text_of_scale(*scene.picture.paper.scale).c_str(),
                 scene.picture.paper.margin_mm == std::array<double, 4>{} ? "paper" : "margins",
                 text_of_scale(round_scale_down(fitting)).c_str());
}

/// Whether a message begins with a place in a sheet.
bool names_sheet(std::string_view message, const StyleSheet& sheet) {
    return message.starts_with(sheet.sets.front().where.file + ":");
}

}  // namespace

DescribedInput describe_input(const Arguments& a) {
    DescribedInput input{read_description(a), {}};
    SceneDescription& description = input.description;
    set_picture_size(a, description);
    if (a.fps) description.frame.fps = *a.fps;
    if (a.turntable_frames) {
        if (!description.turntable) description.turntable.emplace();
        description.turntable->frames = *a.turntable_frames;
    }
    if (description.sheet) {
        if (!description.sheet->file.empty()) input.files.push_back(description.sheet->file);
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
    for (const ObjectDescription& object : description.objects) {
        if (!object.file.empty()) input.files.push_back(object.file);
    }
    return input;
}

namespace {

/// The first frame that may be drawn; none: the scene is drawn at rest.
std::optional<double> first_frame(const Arguments& a, const SceneDescription& scene) {
    if (!a.frame_list.empty()) return a.frame_list.front();
    if (a.frame) return *a.frame;
    if (!scene.frame_range.empty()) return scene.frame_range.front();
    return scene.turntable ? std::optional(scene.turntable->first) : std::nullopt;
}

/// The frames whose models may stand for those of the first one.
std::vector<double> frames_instead(const Arguments& a, const SceneDescription& scene) {
    if (!a.keeps_going) return {};
    return scene.frame_range.empty() ? a.frame_list : scene.frame_range;
}

}  // namespace

LoadedInput load_input(DescribedInput input, const Arguments& a, const std::vector<OutputFile>& outputs) {
    SceneDescription& description = input.description;
    const std::vector<std::string> unread = description.unread_line_keys;
    const bool sheet_surfaces_unread = description.sheet_surfaces_unread;
    LoadedInput loaded{{}, {}, description.frame_range, description.turntable, {}, description.hash};
    if (description.sheet && !description.sheet->file.empty()) loaded.files.push_back(description.sheet->file);
    refuse_to_overwrite(outputs, input.files);
    const LoadOptions options{.threads = a.threads,
                              .strict = a.strict,
                              .budget = a.model_budget,
                              .first_frame = first_frame(a, description),
                              .frames_instead = frames_instead(a, description),
                              .lists_animations = a.command == Command::info};
    AnimatedScene animated = load_animated_scene(std::move(description), options, &loaded.files);
    refuse_to_overwrite(outputs, loaded.files);
    refuse_to_overwrite(outputs, animated.pictures);
    loaded.animation = std::move(animated.animation);
    Scene& scene = loaded.scene = std::move(animated.scene);
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
    if (sheet_surfaces_unread && !a.quiet) std::fprintf(stderr, "burin: note: %s\n", kSheetSurfacesAreUnread);
    if (a.crease_angle_deg) scene.lines.set_crease_angle((*a.crease_angle_deg)[0], (*a.crease_angle_deg)[1]);
    if (a.finds_all && scene.sheet) {
        scene.finds_all = true;
        scene.lines.classes = LineClassSet::all();
    }
    return loaded;
}

double still_frame(const Arguments& a, const std::vector<double>& range, const std::optional<Turntable>& turntable) {
    if (a.frame) return *a.frame;
    if (!range.empty()) return range.front();
    return turntable ? turntable->first : 0;
}

namespace {

/// Puts a scene that is at rest into the frame of a still.
void pose_still(const Arguments& a, LoadedInput& input) {
    const double frame = still_frame(a, input.frame_range, input.turntable);
    const bool is_at_rest = !a.frame && input.frame_range.empty();
    if (input.animation.moves() && !is_at_rest) {
        apply(input.animation.at(frame), input.scene);
    } else {
        input.scene.frame.number = frame;
    }
}

}  // namespace

Scene load_scene_of(const Arguments& a, const std::vector<OutputFile>& outputs,
                    std::vector<AnimationsOfFile>* animations) {
    refuse_to_overwrite(outputs, {a.input});
    LoadedInput input = load_input(describe_input(a), a, outputs);
    if (animations != nullptr) *animations = std::move(input.animation.file_animations);
    pose_still(a, input);
    return std::move(input.scene);
}

namespace {

/// Calls resolve() for a camera; what it throws gets the camera's place, or the options that say it.
template <typename Resolve>
auto naming_camera(const CameraSettings& settings, const Arguments& a, const Resolve& resolve) {
    try {
        return resolve();
    } catch (const FrameError&) {
        throw;
    } catch (const InputError& error) {
        if (changes_view(a)) throw UsageError("--eye, --target, --up, --fov, --ortho: " + std::string(error.what()));
        throw InputError((settings.where.line > 0 ? to_string(settings.where) : a.input) + ": " + error.what());
    }
}

FittedCamera fitted_camera(const Scene& scene, const std::vector<CameraSettings>& first, const PointSource& points,
                           const std::optional<Turntable>& turntable, const Arguments& a) {
    const CameraSettings settings = camera_settings(first, scene.picture, a);
    const double aspect = static_cast<double>(scene.picture.width) / scene.picture.height;
    return naming_camera(settings, a, [&] {
        if (!a.quiet) note_on_scale(scene, points, settings, aspect);
        return FittedCamera(settings, points, aspect, turntable);
    });
}

}  // namespace

JobCamera::JobCamera(const Scene& scene, const std::vector<CameraSettings>& first, const PointSource& points,
                     const std::optional<Turntable>& turntable, const Arguments& a)
    : arguments_(a), fitted_(fitted_camera(scene, first, points, turntable, a)) {}

Camera JobCamera::at(const std::vector<CameraSettings>& cameras, const PictureSettings& picture, double frame) const {
    const CameraSettings settings = camera_settings(cameras, picture, arguments_);
    return naming_camera(settings, arguments_, [&] { return fitted_.at(settings, frame); });
}

std::vector<CameraSettings> cameras_to_fit(const Scene& scene, const SceneAnimation& animation,
                                           const std::vector<double>& range, const UnreadableFrame& unreadable) {
    if (!animation.moves()) return scene.cameras;
    for (const double frame : range) {
        try {
            std::vector<CameraSettings> first = animation.at(frame).cameras;
            return first.empty() ? scene.cameras : first;
        } catch (const InputError& error) {
            const FrameError of_frame(frame, error.what());
            if (!unreadable) throw of_frame;
            unreadable(of_frame);
        }
    }
    return scene.cameras;
}

Still load_still(const Arguments& a, const std::vector<OutputFile>& outputs) {
    refuse_to_overwrite(outputs, {a.input});
    LoadedInput input = load_input(describe_input(a), a, outputs);
    std::optional<JobCamera> camera;
    {
        const PointSource points = points_of_frames(input.scene, input.animation, input.frame_range);
        camera.emplace(input.scene, cameras_to_fit(input.scene, input.animation, input.frame_range), points,
                       input.turntable, a);
    }
    pose_still(a, input);
    const Camera seen = camera->at(input.scene);
    return {std::move(input.scene), seen};
}

std::vector<ViewOnSheet> views_of(const Scene& scene, const PointSource& points, const Arguments& a) {
    if (a.views.empty()) return {};
    const glm::dvec3 up = a.up.value_or(scene.cameras.front().up.value_or(glm::dvec3(0, 1, 0)));
    if (!(glm::length(up) > 0)) throw UsageError("--up: the vector is zero; give a direction");
    try {
        double fitting_scale = 0;
        std::vector<ViewOnSheet> views =
            views_on_sheet(a.views, a.view_projection, scene.picture, up, points, &fitting_scale);
        if (scene.picture.paper.scale && !a.quiet) note_if_tiny(*scene.picture.paper.scale, fitting_scale);
        bool has_hidden_lines = false;
        for (std::size_t i = 0; i < views.size(); ++i) {
            views[i].has_hidden_lines = a.hidden_in_views[i];
            has_hidden_lines = has_hidden_lines || a.hidden_in_views[i];
        }
        if (!has_hidden_lines && a.hidden && *a.hidden != HiddenStyle::none && !a.quiet)
            std::fprintf(stderr,
                         "burin: note: --hidden draws nothing: iso leaves hidden lines out; iso+hidden has them\n");
        return views;
    } catch (const FrameError&) {
        throw;
    } catch (const InputError& error) {
        throw InputError(a.input + ": " + error.what());
    }
}

PixelRect crop_of(const Arguments& a, int width, int height) {
    const int beside = a.overscan_px;
    if (!a.crop) return {-beside, -beside, width + beside, height + beside};
    const auto [x0, y0, x1, y1] = *a.crop;
    if (!(0 <= x0 && x0 < x1 && x1 <= width && 0 <= y0 && y0 < y1 && y1 <= height)) {
        throw UsageError("--crop: must lie within the image of " + std::to_string(width) + "x" +
                         std::to_string(height) + " pixels, with X0 < X1 and Y0 < Y1");
    }
    return {x0, y0, x1, y1};
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
