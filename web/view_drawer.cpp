#include "web/view_drawer.h"

#include <exception>
#include <utility>

#include "base/byte_sink.h"
#include "base/error.h"
#include "base/stopwatch.h"
#include "methods/abuffer.h"
#include "methods/explain_strokes.h"
#include "methods/patel/explain.h"
#include "methods/seen_surfaces.h"
#include "output/film_files.h"
#include "output/paths/make_paths.h"
#include "output/paths/surface_regions.h"
#include "output/vector_files.h"
#include "render/close_cracks.h"
#include "render/replaced_meshes.h"
#include "scene/plain_sheet.h"
#include "shading/ink/ink_lines.h"

namespace burin {
namespace {

const LayerSet kBeautyAlone{true, false, false, false, false, false, false, false};
constexpr int kPreviewSamples = 2;

/// Puts meshes back that were replaced for one picture.
class PutBack {
  public:
    explicit PutBack(Scene& scene) : scene_(scene) {}
    ~PutBack() {
        for (; !replaced.empty(); replaced.pop_back())
            scene_.meshes[replaced.back().first] = std::move(replaced.back().second);
    }
    PutBack(const PutBack&) = delete;
    PutBack& operator=(const PutBack&) = delete;

    ReplacedMeshes replaced;

  private:
    Scene& scene_;
};

}  // namespace

ViewDrawer::ViewDrawer(ViewedScene& scene) : viewed_(scene) { set_look(scene.tables().first_look()); }

void ViewDrawer::set_look(const Look& look) {
    SceneDescription settings = viewed_.tables().described(look);
    settings.objects.clear();
    look_ = look;
    settings_ = std::move(settings);
    prepared_.reset();
}

void ViewDrawer::put_look_into(Scene& scene, const View& view, const Wishes& wishes) const {
    scene.picture = settings_.picture;
    scene.picture.width = view.width;
    scene.picture.height = view.height;
    scene.picture.paper = {};
    scene.lines = settings_.lines;
    scene.sheet = settings_.sheet;
    scene.names_lines = false;
    scene.surfaces = settings_.surfaces;
    scene.lights = settings_.lights;
    scene.abuffer = settings_.abuffer;
    if (wishes.is_preview) scene.abuffer.samples = kPreviewSamples;
    draw_lines_without_polygons(scene);
    if (!wishes.is_for_paths) return;
    if (!scene.sheet) scene.sheet = std::make_shared<const StyleSheet>(plain_sheet(scene.lines));
    scene.names_lines = true;
}

void ViewDrawer::with_frame(const View& view, const Wishes& wishes, const Use& use) {
    const std::lock_guard lock(viewed_.mutex());
    Scene& scene = viewed_.scene();
    put_look_into(scene, view, wishes);
    CameraSettings settings = view.camera();
    settings.shift = viewed_.shift();
    const double aspect = static_cast<double>(view.width) / view.height;
    const Camera camera = resolve_camera(settings, scene_points(scene), aspect);
    PutBack meshes(scene);
    close_cracks(scene, camera, view.width, view.height, viewed_.threads(), &meshes.replaced);
    // What was made for the meshes as they are is of no use for others.
    const bool is_as_loaded = meshes.replaced.empty();
    if (is_as_loaded && !prepared_) prepared_ = prepare_for_abuffer(scene, viewed_.threads());
    const PreparedScene own = is_as_loaded ? PreparedScene{} : prepare_for_abuffer(scene, viewed_.threads());
    use(make_frame(scene, camera, view.width, view.height, {0, 0, view.width, view.height},
                   is_as_loaded ? &*prepared_ : &own));
}

Film& ViewDrawer::film_for(const Frame& frame) {
    const PixelRect whole{0, 0, frame.width, frame.height};
    const auto is_as_large = [&](const PixelRect& a) { return a.x1 == whole.x1 && a.y1 == whole.y1; };
    if (!film_ || !is_as_large(film_->display())) {
        film_.reset();  // before there is another one
        film_.emplace(whole, whole, kBeautyAlone, frame.criteria.classes);
    }
    return *film_;
}

DrawnView ViewDrawer::draw(const View& view, bool is_full) {
    DrawnView drawn;
    with_frame(view, {!is_full, false}, [&](const Frame& frame) {
        Stopwatch watch;
        Film& film = film_for(frame);
        RenderStats stats = render_abuffer(frame, {viewed_.threads()}, film);
        drawn.notes = std::move(stats.notes);
        drawn.draw_s = watch.lap();
        drawn.picture = encoder_.encode(film.image(), frame.scene->picture);
        drawn.encode_s = watch.lap();
    });
    return drawn;
}

ExplainedPixel ViewDrawer::explain(const View& view, int x, int y, int reach_px) {
    ExplainedPixel explained;
    with_frame(view, {false, true}, [&](const Frame& frame) {
        const ExplainedPlace place = explain_strokes_near(frame, x, y, reach_px, viewed_.threads());
        explained.x = place.x;
        explained.y = place.y;
        explained.reasons = reasons_of(place.strokes);
        if (settings_.sheet) explained.lines = text_of(place);
    });
    with_frame(view, {}, [&](const Frame& frame) {
        explained.fragments = explain_pixel(frame, explained.x, explained.y);
        if (!settings_.sheet) explained.fragments += drawn_by_abuffer(frame, explained.x, explained.y);
    });
    return explained;
}

std::string ViewDrawer::png(const View& view) {
    MemorySink file;
    with_frame(view, {}, [&](const Frame& frame) {
        Film& film = film_for(frame);
        render_abuffer(frame, {viewed_.threads()}, film);
        write_output(file, frame.scene->picture, film.image(), {}, {"picture.png", OutputFormat::png});
    });
    return {reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()};
}

std::string ViewDrawer::svg(const View& view, std::vector<std::string>& notes) {
    std::string text;
    with_frame(view, {false, true}, [&](const Frame& frame) {
        RenderStats stats;
        const FoundLines lines = find_styled_lines(frame, {viewed_.threads()}, film_for(frame), stats);
        InkedLines inked = ink_lines(lines, *frame.sheet, viewed_.threads(), notes, {true, false});
        VectorOptions options;
        options.crop = frame.crop;
        VectorStats counts;
        VectorDrawing drawing = vector_drawing_of(std::move(inked), lines, options, counts);
        if (std::string means = note_on_means(counts); !means.empty()) notes.push_back(std::move(means));
        if (surfaces_have_look(*frame.scene)) {
            const SurfaceGrid seen =
                seen_surfaces(viewed_.scene(), frame.camera, frame.crop, {.threads = viewed_.threads()});
            add_surface_regions(seen, drawing);
            if (std::string means = note_on_means(seen); !means.empty()) notes.push_back(std::move(means));
        }
        drawing.paper = frame.scene->picture.background;
        if (!drawing.paper && !frame.scene->picture.transparent) drawing.paper = glm::vec3(1.0f);
        text = vector_file_of(drawing, OutputFormat::svg, {}, notes);
    });
    return text;
}

}  // namespace burin
