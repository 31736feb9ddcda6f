#include "cli/frames/posed_scene.h"

#include <utility>

#include "methods/abuffer.h"
#include "render/close_cracks.h"
#include "render/copied_objects.h"

namespace burin {
namespace {

bool is_same_view(const Camera& a, const Camera& b) {
    return a.orthographic == b.orthographic && a.to_world == b.to_world && a.fov_deg == b.fov_deg &&
           a.height == b.height && a.area.low == b.area.low && a.area.high == b.area.high;
}

bool moves_anything(const SceneChange& change, const Scene& scene) {
    if (!change.meshes.empty()) return true;
    for (std::size_t i = 0; i < change.to_world.size(); ++i) {
        if (change.to_world[i] != scene.objects[i].to_world) return true;
    }
    return false;
}

}  // namespace

PosedScene::PosedScene(Scene scene, const Arguments& arguments, const Method& method, std::size_t frames)
    : scene_(std::move(scene)),
      arguments_(arguments),
      method_(method),
      keeps_(frames > 1),
      mesh_count_(scene_.meshes.size()) {
    if (!keeps_) return;
    for (const SceneObject& object : scene_.objects) meshes_of_objects_.push_back(object.mesh);
}

void PosedScene::pose(SceneChange&& change) {
    if (moves_anything(change, scene_)) {
        put_back();
        has_moved_ = true;
    }
    for (const auto& [number, mesh] : change.meshes) changed_.insert(number);
    apply(std::move(change), scene_);
}

void PosedScene::make_ready(const Camera& camera) {
    if (is_ready_ && is_same_view(camera, ready_for_)) return;
    put_back();
    ReplacedMeshes* const replaced = keeps_ ? &replaced_ : nullptr;
    empty_copied_objects(scene_, replaced);
    close_cracks(scene_, camera, scene_.picture.width, scene_.picture.height, arguments_.threads, replaced);
    for (const auto& [number, mesh] : replaced_) changed_.insert(number);
    if (method_.name == "abuffer") prepare();
    ready_for_ = camera;
    is_ready_ = true;
}

/// Undoes make_ready().
void PosedScene::put_back() {
    is_ready_ = false;
    if (!keeps_) return;
    for (; !replaced_.empty(); replaced_.pop_back()) {
        changed_.insert(replaced_.back().first);
        scene_.meshes[replaced_.back().first] = std::move(replaced_.back().second);
    }
    scene_.meshes.resize(mesh_count_);
    for (std::size_t i = 0; i < meshes_of_objects_.size(); ++i) scene_.objects[i].mesh = meshes_of_objects_[i];
}

void PosedScene::prepare() {
    const bool saves_memory = arguments_.memory_bytes > 0;
    if (!is_prepared_) {
        prepared_ = prepare_for_abuffer(scene_, arguments_.threads, saves_memory);
    } else if (has_moved_ || !changed_.empty() || prepared_.sharp_edges.size() != scene_.meshes.size()) {
        const std::vector<std::size_t> changed(changed_.begin(), changed_.end());
        prepare_changes_for_abuffer(scene_, changed, arguments_.threads, saves_memory, prepared_);
    }
    is_prepared_ = true;
    has_moved_ = false;
    changed_.clear();
}

}  // namespace burin
