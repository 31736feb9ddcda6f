#include "scene/animation/scene_animation.h"

#include <algorithm>

#include "scene/animation/frame_list.h"
#include "scene/animation/placeable.h"

namespace burin {
namespace {

bool is_moved(const SceneAnimation::Place& place) {
    return place.keys != SceneAnimation::kNone || place.model != SceneAnimation::kNone;
}

/// All that places of one frame are made of, each once.
struct Moved {
    std::vector<glm::dmat4> keys;
    std::vector<ModelMotion::Pose> poses;

    glm::dmat4 place_of(const SceneAnimation::Place& place,
                        const std::vector<glm::dmat4> ModelMotion::Pose::*parts) const {
        const glm::dmat4& object = place.keys == SceneAnimation::kNone ? place.object : keys[place.keys];
        const glm::dmat4* own = &place.own;
        if (place.model != SceneAnimation::kNone) {
            const std::vector<glm::dmat4>& posed = poses[place.model].*parts;
            if (place.part < posed.size()) own = &posed[place.part];
        }
        return object * place.instance * *own;
    }
};

}  // namespace

FrameError::FrameError(double frame, const std::string& what)
    : InputError("frame " + text_of_frame(frame) + ": " + what), frame_(frame) {}

bool SceneAnimation::has_moving_objects() const { return std::any_of(objects.begin(), objects.end(), is_moved); }

bool SceneAnimation::has_moving_cameras() const {
    return std::any_of(cameras.begin(), cameras.end(),
                       [](const MovingCamera& camera) { return !camera.keys.empty() || is_moved(camera.place); });
}

SceneChange SceneAnimation::at(double frame) const { return change_at(frame, true); }
SceneChange SceneAnimation::places_at(double frame) const { return change_at(frame, false); }

SceneChange SceneAnimation::change_at(double frame, bool asks_models) const {
    SceneChange change;
    change.frame = frame;
    Moved moved;
    for (const ObjectKeys& one : keys) moved.keys.push_back(one.at(frame));
    for (const MovingModel& model : models) {
        ModelMotion::Pose& pose = moved.poses.emplace_back();
        if (asks_models) pose = model.motion->at(frame);
        for (auto& [number, mesh] : pose.meshes) change.meshes.emplace_back(model.first_mesh + number, std::move(mesh));
        for (std::string& note : pose.notes) change.notes.push_back(std::move(note));
    }
    if (has_moving_objects()) {
        change.to_world.reserve(objects.size());
        for (const Place& object : objects) {
            change.to_world.push_back(moved.place_of(object, &ModelMotion::Pose::parts));
            if (!is_placeable(change.to_world.back())) throw InputError(not_placeable(object.name));
        }
    }
    if (has_moving_cameras()) {
        for (const MovingCamera& camera : cameras) {
            CameraSettings& settings = change.cameras.emplace_back(camera.keys.at(frame, camera.rest));
            if (is_moved(camera.place)) settings.to_world = moved.place_of(camera.place, &ModelMotion::Pose::cameras);
        }
    }
    return change;
}

std::vector<std::string> SceneAnimation::files_at(double frame) const {
    std::vector<std::string> files;
    for (const MovingModel& model : models) {
        for (std::string& file : model.motion->files_at(frame)) files.push_back(std::move(file));
    }
    return files;
}

void apply(SceneChange&& change, Scene& scene) {
    scene.frame.number = change.frame;
    for (std::size_t i = 0; i < change.to_world.size(); ++i) scene.objects[i].to_world = change.to_world[i];
    if (!change.cameras.empty()) scene.cameras = std::move(change.cameras);
    for (auto& [number, mesh] : change.meshes) scene.meshes[number] = std::move(mesh);
}

}  // namespace burin
