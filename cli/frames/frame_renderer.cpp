#include "cli/frames/frame_renderer.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <set>
#include <utility>

#include "base/atomic_file.h"
#include "base/limit_error.h"
#include "base/stopwatch.h"
#include "cli/frames/depth_fit.h"
#include "cli/render_notes.h"
#include "cli/sheet_refusal.h"
#include "cli/sheet_views.h"
#include "cli/vector_output.h"
#include "mesh/text_scan.h"
#include "methods/abuffer.h"
#include "methods/seen_surfaces.h"
#include "output/lines_file.h"
#include "render/layer_names.h"
#include "render/mattes.h"
#include "render/motion.h"
#include "render/picture_notes.h"
#include "render/sub_frames.h"
#include "scene/animation/frame_list.h"
#include "scene/plain_sheet.h"

namespace burin {
namespace {

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

/// Refuses a shading that varies over surfaces where a method draws none.
void refuse_varied_shading(const Scene& scene, const Method& method) {
    if (!varies(scene.surfaces.shading) || method.name == "abuffer" || method.name == "reference") return;
    throw UsageError("[surfaces]: method " + std::string(method.name) +
                     " fills surfaces with paper, lambert or none only; draw with method abuffer or reference, or "
                     "choose another shading");
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

/// Has a scene drawn by a sheet, and then as before.
class SheetForPaths {
  public:
    explicit SheetForPaths(Scene& scene) : scene_(scene), sheet_(scene.sheet), names_lines_(scene.names_lines) {
        draw_by_sheet(scene);
    }
    ~SheetForPaths() {
        scene_.sheet = sheet_;
        scene_.names_lines = names_lines_;
    }
    SheetForPaths(const SheetForPaths&) = delete;
    SheetForPaths& operator=(const SheetForPaths&) = delete;

  private:
    Scene& scene_;
    std::shared_ptr<const StyleSheet> sheet_;
    bool names_lines_;
};

/// Refuses layers that only the A-buffer has, of one view.
void refuse_layers(const LayerSet& layers, const Method& method, std::size_t view_count) {
    if (!layers.crypto.has_any() && !layers.line && !layers.motion) return;
    if (method.name != "abuffer")
        throw UsageError("--layers: method " + std::string(method.name) +
                         " has no layers crypto, line and motion; use method abuffer");
    if (view_count > 0) throw UsageError("--views: cannot stand beside layers crypto, line and motion; remove one");
}

/// `may_be_empty`: none of its pixels is asked for.
Film make_film(const Frame& frame, const LayerSet& layers, bool in_bands, bool may_be_empty, const std::string& path) {
    try {
        const PixelRect display{0, 0, frame.width, frame.height};
        Film film = in_bands ? Film::in_bands(display, frame.crop, layers, frame.criteria.classes)
                             : Film(display, frame.crop, layers, frame.criteria.classes);
        if (may_be_empty || !film.channels().empty() || film.mattes() != nullptr) return film;
    } catch (const InputError& error) {
        throw InputError(path + ": " + error.what());
    }
    throw UsageError("--layers: coverage has a channel per line class, and no class is drawn");
}

/// Refuses what a method cannot draw, and has the scene drawn by a style sheet where paths are made. Returns whether
/// the scene asks for hidden lines.
bool settle_look(const Arguments& a, const Method& method, bool has_paths, Scene& scene) {
    if (method.name != "abuffer") refuse_sheet(scene, "method " + std::string(method.name) + " draws no style sheets");
    refuse_varied_shading(scene, method);
    if (!scene.sheet && (!a.save_lines.empty() || a.finds_all)) {
        throw UsageError((a.save_lines.empty() ? std::string("--find") : std::string("--save-lines")) +
                         ": lines are found for a style sheet; give one with --style");
    }
    const bool has_hidden_lines = refuse_hidden_lines(a, method, scene);
    if (has_paths) draw_by_sheet(scene);
    scene.draws_one_sheet = a.save_lines.empty();
    return has_hidden_lines;
}

/// What becomes of frames that cannot be read where cameras and depths are fitted to all: they end the job, or are left
/// out, each with a note.
UnreadableFrame frames_left_out(const Arguments& a) {
    if (!a.keeps_going) return {};
    return [is_quiet = a.quiet, noted = std::make_shared<std::set<double>>()](const FrameError& error) {
        if (!noted->insert(error.frame()).second || is_quiet) return;
        std::fprintf(stderr, "burin: note: %s; what is fitted is fitted to the other frames\n",
                     printable(error.what(), 4000).c_str());
    };
}

/// A text without its numbers.
std::string without_numbers(std::string text) {
    std::erase_if(text, [](char c) { return c >= '0' && c <= '9'; });
    return text;
}

}  // namespace

void DrawnFrame::write(const Arguments& a) {
    Stopwatch watch;
    std::optional<WrittenFilm> written;  // the first EXR counts
    std::size_t band_file = 0;
    for (const OutputOptions& output : outputs) {
        if (output.is_deep) {
            if (!is_deep_written) deep->write_all(output.threads);
            deep->finish();
        } else if (is_vector(output.format)) {
            write_vector(drawing, a, output);
        } else {
            const WrittenFilm now =
                band_file < bands.size() ? bands[band_file++]->finish() : write_output(frame, *film, *channels, output);
            if (!written && output.format == OutputFormat::exr) written = now;
        }
    }
    if (film && film->layers().crypto.has_any() && written) times.crypto_dropped = written->crypto_dropped;
    times.write_s = times.render.write_s + watch.lap();
    times.total_s = times.load_s + drawing_seconds(times.render) + times.write_s;
}

FrameRenderer::FrameRenderer(const Arguments& a, const Method& method, LoadedInput input, const FramePlan& plan,
                             const std::vector<OutputOptions>& outputs)
    : arguments_(a),
      method_(method),
      plan_(plan),
      outputs_(outputs),
      animation_(std::move(input.animation)),
      fingerprints_(plan.is_sequence || a.skips_existing ? std::optional<Fingerprints>(std::in_place, a, input)
                                                         : std::nullopt),
      moves_(!plan.is_at_rest && (animation_.moves() || input.turntable)),
      is_blurred_(a.shutter || input.scene.shutter),
      posed_(std::move(input.scene), a, method, plan.frames.size() + (is_blurred_ ? 1 : 0)) {
    const Stopwatch watch;
    Scene& scene = posed_.scene();
    scene.frame.is_of_sequence = plan.is_sequence;
    has_hidden_lines_ = settle_look(a, method, has_paths() && !has_pixels(), scene);
    first_cameras_ = scene.cameras;
    const UnreadableFrame unreadable = frames_left_out(a);
    const PointSource points = points_of_frames(scene, animation_, input.frame_range, unreadable);
    views_ = views_of(scene, points, a);
    if (views_.empty()) {
        const std::vector<CameraSettings> first = cameras_to_fit(scene, animation_, input.frame_range, unreadable);
        job_camera_.emplace(scene, first, points, input.turntable, a);
        camera_ = job_camera_->at(first, scene.picture, plan.frames.front());
        // Only these look at depth in steps.
        const std::vector<double> seen = frames_to_fit(input.frame_range, input.turntable);
        if (plan.is_sequence && moves_ && method.name != "abuffer" && !seen.empty())
            fit_depth_ranges(animation_, seen, *job_camera_, unreadable, scene);
    }
    blur_ = blur_of(scene, camera_, a, moves_, has_paths());
    if (!views_.empty()) blur_ = {};  // it was refused if it is more than one sub-frame
    pose_s_ = watch.seconds();
}

/// The frames at which the layer `motion` looks for where surfaces go: none without that layer. A blurred frame may
/// turn out to need no blur, so both are named.
std::vector<double> FrameRenderer::next_frames_of(double frame) const {
    const bool has_flat_exr = std::any_of(outputs_.begin(), outputs_.end(), [](const OutputOptions& output) {
        return output.format == OutputFormat::exr && !output.is_deep;
    });
    if (!has_flat_exr || !moves_ || !layers_for(scene(), arguments_).motion) return {};
    const double middle = blur_.shutter ? middle_sub_frame(&*blur_.shutter).time : 0;
    if (middle == 0) return {frame + 1};
    return {frame + 1, frame + middle + 1};
}

std::vector<OutputOptions> FrameRenderer::outputs_of(double frame, const FrameFingerprint& fingerprint) const {
    std::vector<OutputOptions> outputs = outputs_;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        outputs[i].has_beauty = !arguments_.names_layers || arguments_.layers.beauty;
        outputs[i].path = plan_.outputs[i].path_of(frame);
        outputs[i].fingerprint = fingerprint.of(outputs[i].format);
        outputs[i].frame = scene().frame;
    }
    return outputs;
}

SceneChange FrameRenderer::change_at(double frame) const {
    if (animation_.moves() && !plan_.is_at_rest) return animation_.at(frame);
    SceneChange change;
    change.frame = frame;
    return change;
}

void FrameRenderer::pose(SceneChange&& change) {
    const Stopwatch watch;
    const std::vector<std::string> notes = std::move(change.notes);
    posed_.pose(std::move(change));
    for (const std::string& text : notes) note(text);
    camera_ = views_.empty() ? job_camera_->at(scene()) : views_.front().camera;
    posed_.make_ready(camera_);
    pose_s_ += watch.seconds();
}

LayerSet FrameRenderer::layers_of_picture(const Frame& frame, bool& in_bands) const {
    LayerSet all{false, false, false, false, false, false, false, false};
    bool are_exr = true;
    for (const OutputOptions& output : outputs_) {
        are_exr = are_exr && output.format == OutputFormat::exr;
        if (output.is_deep) {
            all.deep = true;
            all.deep_hidden = scene().deep.has_lines_behind;
            continue;
        }
        const LayerSet layers = layers_for(scene(), arguments_);
        refuse_layers(layers, method_, views_.size());
        if (output.format != OutputFormat::exr) {  // paths are made without pixels
            all.beauty = all.beauty || !is_vector(output.format) || arguments_.saves_surface;
            continue;
        }
        const LayerSet others = std::exchange(all, layers);
        all.beauty = all.beauty || others.beauty;
        all.deep = others.deep;
        all.deep_hidden = others.deep_hidden;
    }
    // An EXR is compressed while it is drawn; but not when times are taken.
    in_bands = are_exr && arguments_.repeat == 0 && views_.empty() && method_.finishes_in_bands != nullptr &&
               method_.finishes_in_bands(frame);
    return all;
}

Moment FrameRenderer::moment_at(double number, double time, MomentUse use) {
    if (blur_.shutter) {
        if (use == MomentUse::extent) posed_.put_back();
        SceneChange change = change_at(number + time);
        for (const std::string& text : change.notes) note(text);
        posed_.pose(std::move(change));
        camera_ = job_camera_->at(scene());
        posed_.scene().frame.number = number;  // looks are those of one frame
        if (use == MomentUse::drawing) posed_.make_ready(camera_);
    }
    return {&scene(), camera_, &posed_.prepared()};
}

/// Begins what is written while it is drawn.
void FrameRenderer::begin_files(RunOptions& run, bool in_bands, DrawnFrame& drawn,
                                std::atomic<bool>& has_write_failed) {
    bool has_flat = false;
    for (const OutputOptions& output : drawn.outputs) {
        if (output.is_deep) {
            drawn.deep = std::make_unique<DeepWriter>(drawn.frame, *drawn.film, output);
        } else {
            has_flat = has_flat || !is_vector(output.format);
            if (in_bands) drawn.bands.push_back(std::make_unique<BandWriter>(drawn.frame, *drawn.film, output));
        }
    }
    if (!in_bands) {
        if (has_flat) drawn.channels = std::make_unique<FilmChannels>(drawn.frame, *drawn.film);
        return;
    }
    drawn.is_deep_written = drawn.deep != nullptr;
    run.finished_band = [&drawn, &has_write_failed](std::size_t band) {
        try {
            if (drawn.deep) drawn.deep->write(band);
            for (const auto& file : drawn.bands) file->write(band);
        } catch (...) {
            has_write_failed = true;
            throw;
        }
        drawn.film->close(band);
    };
}

DrawnFrame FrameRenderer::draw(const std::vector<OutputOptions>& outputs, Progress* progress) {
    Stopwatch watch;
    DrawnFrame drawn;
    drawn.number = scene().frame.number;
    drawn.outputs = outputs;
    const MomentAt moments = [this, number = drawn.number](double time, MomentUse use) {
        return moment_at(number, time, use);
    };
    const PictureSettings& picture = scene().picture;
    drawn.sub_frames = sub_frame_count(blur_, moments, picture.width, picture.height);
    // What the frame says of itself is that of the middle.
    if (blur_.shutter) {
        moments(drawn.sub_frames > 1 ? middle_sub_frame(&*blur_.shutter).time : 0, MomentUse::drawing);
    }
    drawn.frame = frame_of(scene(), camera_, arguments_, &posed_.prepared());
    drawn.times.load_s = std::exchange(pose_s_, 0) + watch.lap();
    bool in_bands = false;
    const LayerSet layers = layers_of_picture(drawn.frame, in_bands);
    make_ready(drawn.frame, layers, 0);
    const Frame& frame = drawn.frame;
    const OutputOptions& first = outputs.front();
    if (is_first_) note_limits(arguments_, frame, method_, has_hidden_lines_, outputs);
    in_bands = in_bands && drawn.sub_frames == 1;
    drawn.film = std::make_unique<Film>(make_film(frame, layers, in_bands, !has_pixels(), first.path));
    RunOptions run{arguments_.threads, progress, arguments_.memory_bytes};
    run.depth_limit = arguments_.depth_limit;
    std::atomic<bool> has_write_failed = false;
    begin_files(run, in_bands, drawn, has_write_failed);
    if (plan_.lines) {
        run.found_lines = [&](const FoundLines& lines, const Film& surfaces) {
            AtomicFile file(plan_.lines->path_of(drawn.number));
            write_lines_file(file, lines, arguments_.saves_surface ? kept_surface(surfaces) : KeptSurface{},
                             first.fingerprint);
            file.commit();
        };
    }
    try {
        drawn.times.render = draw_picture(frame, run, *drawn.film, drawn);
    } catch (const LimitError& error) {
        throw InputError(arguments_.input + ": --memory: " + error.what());
    } catch (const InputError& error) {
        if (has_write_failed) throw;
        const std::string message = error.what();  // begins with the file where it has a place
        throw InputError(message.starts_with(arguments_.input + ":") ? message : arguments_.input + ": " + message);
    }
    run.found_lines = nullptr;
    run.finished_band = nullptr;
    if (arguments_.repeat > 0) {
        run.progress = nullptr;
        std::vector<RenderStats> runs;
        for (int i = 0; i < arguments_.repeat; ++i) runs.push_back(draw_picture(frame, run, *drawn.film, drawn));
        drawn.times.render = median_of(std::move(runs));
    }
    const bool counts = (method_.name == "abuffer" || method_.name == "patel") && !arguments_.crop;
    const bool has_lines = std::any_of(scene().meshes.begin(), scene().meshes.end(),
                                       [](const Mesh& mesh) { return !mesh.loose_edges.empty(); });
    if (counts && drawn.times.render.fragments == 0 && !has_lines) note(kNoSurfaceIsSeen);
    for (const std::string& text : drawn.times.render.notes) note(text);
    is_first_ = false;
    drawn.frame.next = nullptr;
    return drawn;
}

/// Has a frame know what layers ask for; `time`: of it, from the frame's own.
void FrameRenderer::make_ready(Frame& frame, const LayerSet& layers, double time) {
    // For line.qi and qi. It changes no picture; a sheet asks for what it needs.
    if ((layers.line || layers.deep) && !scene().sheet) frame.needs.tells_invisibility = frame.needs.behind();
    if (layers.motion) find_next(frame, scene().frame.number + time + 1);
}

/// Finds where the surfaces of a frame are at another one.
void FrameRenderer::find_next(Frame& frame, double number) {
    if (!moves_) return;
    try {
        next_change_ = animation_.at(number);
    } catch (const InputError& error) {
        note("the layer motion is 0, for the next frame cannot be read: " + std::string(error.what()));
        return;
    }
    const bool has_cameras = !next_change_.cameras.empty();
    const Camera camera = job_camera_->at(has_cameras ? next_change_.cameras : first_cameras_, scene().picture, number);
    std::vector<const Mesh*> meshes(scene().objects.size(), nullptr);
    for (const auto& [changed, mesh] : next_change_.meshes) {
        for (std::size_t object = 0; object < meshes.size(); ++object) {
            if (posed_.mesh_as_loaded(object) == changed) meshes[object] = &mesh;
        }
    }
    next_surfaces_ = surfaces_later(frame, next_change_.to_world, meshes, camera);
    frame.next = &next_surfaces_;
}

RenderStats FrameRenderer::draw_picture(const Frame& frame, const RunOptions& run, Film& film, DrawnFrame& drawn) {
    if (!has_pixels()) return draw_as_paths(frame, run, film, drawn);
    RenderStats stats = draw_pixels(frame, run, film, drawn);
    if (has_paths()) add(draw_as_paths_too(run, drawn), stats);
    return stats;
}

RenderStats FrameRenderer::draw_pixels(const Frame& frame, const RunOptions& run, Film& film, DrawnFrame& drawn) {
    if (drawn.sub_frames > 1) {
        const MomentAt moments = [this, number = drawn.number](double time, MomentUse use) {
            return moment_at(number, time, use);
        };
        const ReadyFrame ready = [&](Frame& sub_frame, bool is_middle) {
            LayerSet layers = film.layers();
            layers.motion = layers.motion && is_middle;
            make_ready(sub_frame, layers, blur_.shutter ? middle_sub_frame(&*blur_.shutter).time : 0);
        };
        return render_blurred(method_, blur_, drawn.sub_frames, moments, frame.width, frame.height, run, film, ready);
    }
    if (views_.empty()) return method_.render(frame, run, film);
    return SheetViews{posed_.scene(), arguments_, views_, &posed_.prepared()}.draw(method_, run, film);
}

RenderStats FrameRenderer::draw_as_paths(const Frame& frame, const RunOptions& run, Film& film, DrawnFrame& drawn) {
    RenderStats stats;
    if (VectorStats& paths = drawn.times.paths.emplace(); views_.empty()) {
        const FoundLines lines = find_styled_lines(frame, run, film, stats);
        drawn.drawing = draw_paths(lines, frame, arguments_, paths, stats.notes, run.progress);
        if (draws_regions(scene(), arguments_)) {
            draw_regions(seen_surfaces(posed_.scene(), frame.camera, frame.crop, run), drawn.drawing, paths,
                         stats.notes);
        }
    } else {
        const SheetViews sheet{posed_.scene(), arguments_, views_, &posed_.prepared()};
        stats = sheet.draw_as_paths(run, film, drawn.drawing, paths);
    }
    finish_drawing(scene().picture, arguments_, drawn.drawing, *drawn.times.paths, stats.notes);
    return stats;
}

/// Beside pixels, whose bytes must be those that they have without paths: lines are found once more.
RenderStats FrameRenderer::draw_as_paths_too(const RunOptions& run, DrawnFrame& drawn) {
    const SheetForPaths sheet(posed_.scene());
    const Frame frame = frame_of(scene(), camera_, arguments_, &posed_.prepared());
    Film film = make_film(frame, {false, false, false, false, false, false, false, false}, false, true, {});
    RunOptions own = run;
    own.found_lines = nullptr;
    own.finished_band = nullptr;
    return draw_as_paths(frame, own, film, drawn);
}

/// Says what the user should know of a frame. Of a sequence, what other frames have, too, is said once.
void FrameRenderer::note(const std::string& text) {
    if (arguments_.quiet) return;
    std::string prefix;
    if (plan_.is_sequence) {
        std::string kind = without_numbers(text);
        if (std::find(noted_.begin(), noted_.end(), kind) != noted_.end()) return;
        noted_.push_back(std::move(kind));
        prefix = "frame " + text_of_frame(scene().frame.number) + ": ";
    }
    std::fprintf(stderr, "burin: note: %s%s\n", prefix.c_str(), printable(text, 4000).c_str());
}

}  // namespace burin
