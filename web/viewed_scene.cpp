#include "web/viewed_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "base/error.h"
#include "render/copied_objects.h"
#include "scene/animation/scene_animation.h"
#include "scene/scene_description.h"

namespace burin {
namespace {

std::string name_of_input(const ViewedInput& input) { return std::filesystem::path(input.path).stem().string(); }

std::optional<double> first_frame(const SceneDescription& scene) {
    if (scene.frame_range.empty()) return std::nullopt;
    return scene.frame_range.front();
}

/// Loads a scene as `burin render` does for one picture.
Scene load(SceneDescription description, const ViewedSceneOptions& options) {
    const std::optional<double> frame = first_frame(description);
    const bool is_at_rest = description.frame_range.empty();
    AnimatedScene loaded = load_animated_scene(
        std::move(description),
        {.threads = options.threads, .keeps_attributes = true, .budget = options.budget, .first_frame = frame});
    if (loaded.animation.moves() && !is_at_rest) {
        apply(loaded.animation.at(*frame), loaded.scene);
    } else {
        loaded.scene.frame.number = frame.value_or(0);
    }
    return std::move(loaded.scene);
}

/// What is not drawn as `burin render` would.
std::string note_on_blur(const SceneDescription& scene) {
    const bool has_lens = !scene.cameras.empty() && scene.cameras.front().lens_radius > 0;
    if (!scene.shutter && !has_lens) return {};
    return "motion blur and depth of field are not shown, and are not in the files of this view";
}

}  // namespace

ViewedScene::ViewedScene(ViewedInput input, const ViewedSceneOptions& options)
    : tables_(input), name_(name_of_input(input)), threads_(options.threads) {
    SceneDescription description = tables_.described(tables_.first_look());
    const std::string blur = note_on_blur(description);
    scene_ = load(std::move(description), options);
    notes_ = tables_.notes();
    notes_.insert(notes_.end(), scene_.notes.begin(), scene_.notes.end());
    if (!blur.empty()) notes_.push_back(blur);
    first_camera_ = scene_.cameras.front();
    first_camera_.lens_radius = 0;
    shift_ = first_camera_.shift;
    box_ = box_of(scene_points(scene_));
    empty_copied_objects(scene_);
    try {
        home(1, 1);
    } catch (const InputError& error) {  // before anybody looks
        throw InputError(tables_.camera_place(), error.what());
    }
}

View ViewedScene::view_of(const CameraSettings& settings, int width, int height) const {
    const std::lock_guard lock(mutex_);
    const Camera camera = resolve_camera(settings, scene_points(scene_), static_cast<double>(width) / height);
    View view;
    view.width = width;
    view.height = height;
    view.eye = camera.eye();
    const glm::dvec3 back(camera.to_world[2]);
    const glm::dvec3 center = 0.5 * (box_.low + box_.high);
    const double radius = std::max(0.5 * glm::distance(box_.low, box_.high), 1e-9);
    double distance = glm::dot(view.eye - center, back);
    if (settings.eye && settings.target && !settings.to_world)
        distance = glm::distance(*settings.eye, *settings.target);
    view.target = view.eye - std::max(distance, 0.01 * radius) * back;
    view.up = settings.to_world ? glm::dvec3(camera.to_world[1]) : settings.up.value_or(glm::dvec3(0, 1, 0));
    view.fov_deg = camera.fov_deg;
    if (camera.orthographic) view.height_of_view = camera.height;
    return view;
}

glm::dvec3 ViewedScene::axis() const {
    const glm::dvec3 y(0, 1, 0);
    return first_camera_.to_world ? y : first_camera_.up.value_or(y);
}

View ViewedScene::home(int width, int height) const { return view_of(first_camera_, width, height); }

View ViewedScene::fitted(const View& view) const {
    CameraSettings settings = view.camera();
    settings.direction = view.eye - view.target;
    settings.eye.reset();
    settings.target.reset();
    settings.height.reset();
    return view_of(settings, view.width, view.height);
}

}  // namespace burin
