#include "burin/scene_for_frame.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "base/error.h"
#include "methods/abuffer.h"
#include "render/close_cracks.h"
#include "render/copied_objects.h"
#include "render/picture_notes.h"
#include "scene/paper_camera.h"
#include "scene/plain_sheet.h"

namespace burin {

SceneForFrame::SceneForFrame(burin_scene& state, const burin_view& view, const OptionsInput& options) : state_(state) {
    const SceneDescription& settings = state.settings.description();
    scene_.materials = state.materials;
    scene_.picture = settings.picture;
    scene_.frame = settings.frame;
    scene_.lines = settings.lines;
    scene_.sheet = settings.sheet;
    scene_.line_shaders = state.line_shaders;
    if (options.for_paths) {
        if (!scene_.sheet) scene_.sheet = std::make_shared<const StyleSheet>(plain_sheet(scene_.lines));
        scene_.names_lines = true;
    }
    if (options.finds_all) {
        scene_.finds_all = true;
        scene_.lines.classes = LineClassSet::all();
    }
    scene_.surfaces = settings.surfaces;
    scene_.lights = settings.lights;
    scene_.abuffer = settings.abuffer;
    scene_.crypto = settings.crypto;
    scene_.cameras = !settings.cameras.empty() ? settings.cameras : state.file_cameras;
    scene_.camera_is_default = scene_.cameras.empty();
    if (scene_.camera_is_default) scene_.cameras.emplace_back();
    take_meshes();
    try {
        make_frame_of(view, options);
    } catch (...) {
        give_meshes_back();
        throw;
    }
}

std::vector<std::string> SceneForFrame::notes() const {
    std::vector<std::string> notes;
    if (std::string unread = note_on_unread_keys(state_.settings.description().unread_line_keys); !unread.empty())
        notes.push_back(std::move(unread));
    const bool has_shutter = state_.settings.description().shutter.has_value();
    if (std::string blur = note_on_missing_blur(has_shutter, frame_.camera, "the library"); !blur.empty())
        notes.push_back(std::move(blur));
    if (std::string missing = note_on_missing_marks(frame_); !missing.empty()) {
        if (!scene_.sheet)
            missing += "; lines.draw=" + to_string(scene_.lines.classes | LineClass::mark) + " has it, too";
        notes.push_back(std::move(missing));
    }
    return notes;
}

SceneForFrame::~SceneForFrame() { give_meshes_back(); }

void SceneForFrame::take_meshes() {
    std::map<const MeshGroup*, std::uint32_t> first_mesh;
    std::size_t mesh_count = 0;
    for (const auto& [number, object] : state_.objects) {
        for (const ObjectPart& part : object.parts) {
            const auto [at, is_new] = first_mesh.try_emplace(part.group.get(), static_cast<std::uint32_t>(mesh_count));
            if (is_new) {
                groups_.push_back(part.group);
                mesh_count += part.group->meshes.size();
            }
            scene_.objects.push_back(
                {part.name, at->second + static_cast<std::uint32_t>(part.mesh), part.to_world, part.materials});
        }
    }
    own_mesh_count_ = mesh_count;
    scene_.meshes.reserve(mesh_count);
    for (const auto& group : groups_) {  // nothing fails any more
        std::move(group->meshes.begin(), group->meshes.end(), std::back_inserter(scene_.meshes));
    }
}

void SceneForFrame::give_meshes_back() noexcept {
    for (; !replaced_.empty(); replaced_.pop_back()) {
        scene_.meshes[replaced_.back().first] = std::move(replaced_.back().second);
    }
    auto mesh = scene_.meshes.begin();
    for (const auto& group : groups_) {
        for (Mesh& own : group->meshes) own = std::move(*mesh++);
    }
    groups_.clear();
    if (keeps_preparation_) state_.preparation.made = std::move(prepared_);
}

void SceneForFrame::prepare(const OptionsInput& options) {
    const bool saves_memory = options.memory_bytes > 0;
    Preparation& kept = state_.preparation;
    std::vector<std::size_t> replaced;
    for (const auto& [number, mesh] : replaced_) replaced.push_back(number);
    for (std::size_t i = own_mesh_count_; i < scene_.meshes.size(); ++i) replaced.push_back(i);
    // Copies that are emptied are the same ones until something moves; cracks are closed for one camera.
    const bool is_known = !saves_memory && kept.revision == state_.revision;
    const bool is_unchanged = is_known && kept.placement == state_.placement && !closes_cracks_ && !kept.closes_cracks;
    PreparedScene made = std::exchange(kept.made, {});
    if (is_known) prepared_ = std::move(made);
    std::vector<std::size_t> changed = replaced;
    changed.insert(changed.end(), kept.replaced.begin(), kept.replaced.end());
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    kept.revision = 0;  // until it is there again
    if (!is_unchanged)
        kept.meshes_made += prepare_changes_for_abuffer(scene_, changed, options.threads, saves_memory, prepared_);
    if (saves_memory) return;
    kept.revision = state_.revision;
    kept.placement = state_.placement;
    kept.replaced = std::move(replaced);
    kept.closes_cracks = closes_cracks_;
    keeps_preparation_ = true;
}

void SceneForFrame::make_frame_of(const burin_view& view, const OptionsInput& options) {
    draw_lines_without_polygons(scene_);
    const ViewInput input = checked_view(view, scene_.picture, scene_.cameras);
    scene_.picture.width = input.width;
    scene_.picture.height = input.height;
    fit_to_paper(scene_.picture);
    if (scene_.picture.width != input.width || scene_.picture.height != input.height) {
        // The view has proportions of its own.
        scene_.picture.width = input.width;
        scene_.picture.height = input.height;
        scene_.picture.paper.size_mm.reset();
    }
    if (input.samples) scene_.abuffer.samples = input.samples;
    if (input.frame && state_.moves) {
        throw UsageError(
            "view.frame: the scene moves, and the library shows it at rest in this version; `burin render -f " +
            std::to_string(view.frame) + "` draws this frame");
    }
    if (input.frame) scene_.frame.number = *input.frame;
    const double aspect = static_cast<double>(input.width) / input.height;
    Camera camera;
    try {
        CameraSettings settings = input.camera;
        see_on_paper(scene_.picture, settings);
        camera = resolve_camera(settings, scene_points(scene_), aspect);
    } catch (const InputError& error) {
        throw UsageError("view: " + std::string(error.what()));
    }
    empty_copied_objects(scene_, &replaced_);
    const std::size_t replaced_for_all = replaced_.size();
    close_cracks(scene_, camera, input.width, input.height, options.threads, &replaced_);
    closes_cracks_ = replaced_.size() != replaced_for_all;
    prepare(options);
    frame_ = make_frame(scene_, camera, input.width, input.height, input.crop, &prepared_);
}

}  // namespace burin
