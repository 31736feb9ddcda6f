#include "mesh/gltf.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <tuple>

#include "base/interrupt.h"
#include "base/mapped_file.h"
#include "mesh/gltf_animation.h"
#include "mesh/gltf_buffers.h"
#include "mesh/gltf_container.h"
#include "mesh/gltf_extensions.h"
#include "mesh/gltf_instances.h"
#include "mesh/gltf_json.h"
#include "mesh/gltf_materials.h"
#include "mesh/gltf_plan.h"
#include "mesh/gltf_pose.h"
#include "mesh/gltf_surface.h"
#include "mesh/model_path.h"

namespace burin {
namespace {

/// How a node shows a mesh.
struct Pose {
    std::optional<std::uint32_t> skin;
    std::vector<double> weights;                ///< of morph targets; empty: none is added
    std::optional<std::uint32_t> weights_node;  ///< itself, if its weights are animated

    auto operator<=>(const Pose&) const = default;
};

class GltfReader {
  public:
    GltfReader(const std::string& path, ModelBudget& budget, bool strict, const AttributeWish& attributes,
               const AnimationWish& animations)
        : path_(path),
          budget_(budget),
          strict_(strict),
          attributes_(attributes),
          animations_(animations),
          file_(path),
          container_(split_gltf_container(path, file_.bytes())),
          json_(parse_gltf_json(path, container_.json)),
          root_(path_, json_, "") {}

    GltfScene read() {
        check_version();
        check_gltf_extensions(path_, root_);
        buffers_.emplace(path_, root_, container_.binary, budget_);
        materials_ = read_gltf_materials(root_);
        plan_meshes();
        nodes_ = read_gltf_nodes(root_);
        if (nodes_.mesh_nodes.empty()) {
            throw InputError(path_ + ": no node shows a mesh; burin draws the lines of surfaces");
        }
        read_animations();
        plan_poses();
        count_memory();
        make_meshes();
        place_objects();
        scene_.materials = std::move(materials_.materials);
        move_cameras();
        scene_.cameras = std::move(nodes_.cameras);
        note_what_is_left_out();
        buffers_->check_are_whole();
        scene_.buffer_files = buffers_->files();
        add_pictures();
        return std::move(scene_);
    }

  private:
    /// Pictures are not looked at, whatever stands there.
    void add_pictures() {
        if (!root_.has("images") || !root_.at("images").json().is_array()) return;
        const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
        for (const auto& image : root_.at("images").json()) {
            if (!image.is_object() || !image.contains("uri") || !image["uri"].is_string()) continue;
            const std::string uri = decode_percent(image["uri"].get<std::string>());
            if (!uri.starts_with("data:") && uri.find('\0') == std::string::npos)
                scene_.picture_files.push_back((folder / uri).string());
        }
    }
    void check_version() const {
        if (!json_.is_object() || !root_.has("asset")) {
            throw InputError(path_ + ": this is no glTF file (it has no 'asset')");
        }
        const auto asset = root_.at("asset");
        // A text, but a number in some files of glTF 1.0.
        const std::string version = asset.has("version") ? asset.at("version").text_or_number() : "2.0";
        if (!version.starts_with("2")) {
            throw InputError(path_ + ": glTF version " + printable(version) +
                             " is not read; re-export the model as glTF 2.0");
        }
    }

    void plan_meshes() {
        std::map<std::string, std::uint32_t> known;
        for (std::size_t i = 0; i < root_.size_of("meshes"); ++i) {
            throw_if_interrupted();
            plans_.push_back(plan_gltf_mesh(root_.at("meshes").element(i), i, *buffers_, materials_, attributes_));
            const auto number = static_cast<std::uint32_t>(i);
            first_like_.push_back(known.try_emplace(std::move(plans_[i].key), number).first->second);
        }
        poses_.resize(plans_.size());
    }

    void read_animations() {
        using By = AnimationChoice::By;
        const AnimationChoice& choice = animations_.choice;
        const bool is_named = choice.by == By::name || choice.by == By::number;
        std::vector<std::string> faults;
        if (animations_.lists) scene_.animations = list_gltf_animations(root_, *buffers_, faults);
        if (animations_.plays || is_named) {
            const std::optional<std::uint32_t> number = chosen_gltf_animation(path_, root_, choice);
            if (number && animations_.plays) play(*number);
        }
        if (animations_.plays && choice.by == By::none) {
            for (std::uint32_t i = 0; i < root_.size_of("animations"); ++i) {
                try {
                    read_gltf_animation(root_, i, nodes_, *buffers_, budget_);
                } catch (const InputError& error) {
                    faults.emplace_back(error.what());
                }
            }
        }
        for (const std::string& fault : faults)  // without the path, which notes get later
            scene_.notes.push_back(fault.substr(fault.starts_with(path_ + ": ") ? path_.size() + 2 : 0));
    }

    void play(std::uint32_t number) {
        GltfMotion& motion = scene_.motion.emplace();
        motion.rig.animation = read_gltf_animation(root_, number, nodes_, *buffers_, budget_);
        scene_.notes.insert(scene_.notes.end(), motion.rig.animation.notes.begin(), motion.rig.animation.notes.end());
        if (motion.rig.animation.channels.empty()) {
            scene_.motion.reset();
            return;
        }
        for (std::size_t i = 0; i < root_.size_of("nodes"); ++i)
            motion.rig.transforms.push_back(read_gltf_transform(root_.at("nodes").element(i)));
        motion.rig.tree = nodes_.tree;
        is_moved_ = motion.rig.moved_nodes();
    }

    void move_cameras() {
        if (!scene_.motion) return;
        for (const GltfCamera& camera : nodes_.cameras) scene_.motion->cameras.push_back(camera.node);
    }

    /// Whether the vertices of a mesh move in this pose.
    bool deforms(const Pose& pose) const {
        if (pose.weights_node) return true;
        if (!pose.skin || is_moved_.empty()) return false;
        const JsonPlace joints = root_.at("skins").element(*pose.skin).at("joints");
        for (std::size_t i = 0; i < joints.size(); ++i) {
            if (is_moved_[joints.element(i).index_below(is_moved_.size(), "node")]) return true;
        }
        return false;
    }

    /// How many morph targets a mesh has that deforms.
    std::size_t target_count(const Pose& pose) const {
        return pose.weights_node ? scene_.motion->rig.weights_of(*pose.weights_node)->width : pose.weights.size();
    }

    /// What moves the vertices of a mesh that deforms. `skin`: nullptr: it has none.
    GltfMover mover_of(const Pose& pose, const GltfSurface& surface, const GltfSkin* skin) {
        GltfMover mover{{surface, target_count(pose), skin == nullptr ? 0 : skin->joints.size(), *buffers_},
                        pose.weights,
                        pose.weights_node.value_or(GltfMover::kNoNode),
                        {},
                        {}};
        if (skin != nullptr) {
            mover.joints = skin->joints;
            mover.inverse_binds = skin->inverse_binds;
        }
        return mover;
    }

    JsonPlace node(const GltfMeshNode& shown) const { return root_.at("nodes").element(shown.node); }

    Pose pose_of(const GltfMeshNode& shown) const {
        const JsonPlace place = node(shown);
        Pose pose;
        pose.weights = gltf_morph_weights(place, root_.at("meshes").element(shown.mesh));
        if (place.has("skin")) {
            pose.skin = place.at("skin").index_below(root_.size_of("skins"), "skin");
        }
        if (scene_.motion && scene_.motion->rig.weights_of(shown.node) != nullptr) pose.weights_node = shown.node;
        return pose;
    }

    /// Plans in which poses nodes show each mesh. A mesh that no node shows is read as it is.
    void plan_poses() {
        for (const GltfMeshNode& shown : nodes_.mesh_nodes) {
            const std::uint32_t mesh = first_like_[shown.mesh];
            auto& poses = poses_[mesh];
            const auto [pose, is_new] = poses.try_emplace(pose_of(shown), poses.size());
            shown_pose_.push_back(pose->second);
        }
        for (std::uint32_t i = 0; i < plans_.size(); ++i) {
            if (first_like_[i] == i && poses_[i].empty()) poses_[i].try_emplace(Pose(), 0);
        }
    }

    void count_memory() {
        GltfExpansion expansion;
        std::uint64_t moving_bytes = 0;
        for (std::uint32_t i = 0; i < plans_.size(); ++i) {
            expansion.add_mesh(plans_[i], poses_[i].size());
            for (const auto& [pose, number] : poses_[i]) {
                if (!deforms(pose)) continue;
                const std::uint64_t bytes =
                    GltfDeformation::most_bytes(plans_[i].vertex_count(), target_count(pose), pose.skin.has_value());
                moving_bytes += std::min(bytes, UINT64_MAX - moving_bytes);
            }
        }
        // What the file has once takes four times its room in it at most.
        const std::uint64_t own_bytes = saturating_product(buffers_->size_bytes(), 4);
        budget_.add(moving_bytes > own_bytes ? moving_bytes - own_bytes : 0, path_ + ": what moves its vertices");
        for (const GltfMeshNode& shown : nodes_.mesh_nodes) {
            expansion.add_instances(gltf_instance_count(node(shown), *buffers_).value_or(0));
        }
        budget_.add(expansion.beyond(buffers_->size_bytes()),
                    path_ + ": what it makes of its accessors, which it uses again and again,");
    }

    void make_meshes() {
        std::vector<std::optional<GltfSkin>> skins(root_.size_of("skins"));
        for (std::uint32_t i = 0; i < plans_.size(); ++i) {
            first_soup_.push_back(scene_.meshes.size());
            if (first_like_[i] != i) continue;
            std::vector<const Pose*> poses(poses_[i].size());
            for (const auto& [pose, number] : poses_[i]) poses[number] = &pose;
            GltfSurface surface = expand_gltf_mesh(plans_[i], *buffers_, attributes_);
            for (const Pose* pose : poses) {
                throw_if_interrupted();
                const GltfSkin* skin = nullptr;
                if (pose->skin) {
                    std::optional<GltfSkin>& known = skins[*pose->skin];
                    if (!known) {
                        known = read_gltf_skin(root_.at("skins").element(*pose->skin), nodes_, *buffers_);
                    }
                    skin = &*known;
                }
                GltfSurface posed = pose == poses.back() ? std::move(surface) : surface;
                if (deforms(*pose)) {
                    scene_.motion->movers.emplace_back(static_cast<std::uint32_t>(scene_.meshes.size()),
                                                       mover_of(*pose, posed, skin));
                }
                if (skin != nullptr || !pose->weights.empty()) {
                    pose_gltf_mesh(posed, pose->weights, skin, *buffers_);
                }
                scene_.meshes.push_back(std::move(posed.soup));
                scene_.mesh_names.push_back(plans_[i].name);
            }
        }
    }

    void place_objects() {
        for (std::size_t i = 0; i < nodes_.mesh_nodes.size(); ++i) {
            const GltfMeshNode& shown = nodes_.mesh_nodes[i];
            const JsonPlace place = node(shown);
            const std::size_t mesh = first_soup_[first_like_[shown.mesh]] + shown_pose_[i];
            // The transform of a node with a skin means nothing.
            const bool has_skin = place.has("skin");
            GltfObject object{shown.name, static_cast<std::uint32_t>(mesh),
                              has_skin ? glm::dmat4(1.0) : nodes_.to_world[shown.node]};
            const auto count = gltf_instance_count(place, *buffers_);
            if (!count) {
                if (scene_.motion) scene_.motion->objects.push_back({shown.node, has_skin, glm::dmat4(1.0)});
                scene_.objects.push_back(std::move(object));
                continue;
            }
            if (has_skin) place.fail("a node with a skin cannot have instances");
            const std::vector<glm::dmat4> matrices = read_gltf_instances(place, *buffers_);
            place_instances(object, matrices, place);
            if (!scene_.motion) continue;
            for (const glm::dmat4& matrix : matrices) scene_.motion->objects.push_back({shown.node, false, matrix});
        }
    }

    void place_instances(const GltfObject& object, const std::vector<glm::dmat4>& matrices, const JsonPlace& place) {
        for (std::size_t i = 0; i < matrices.size(); ++i) {
            GltfObject instance = object;
            if (matrices.size() > 1) instance.name += "#" + std::to_string(i + 1);
            instance.to_world = object.to_world * matrices[i];
            if (!is_within_reason(instance.to_world)) {
                place.fail("the transform of instance " + std::to_string(i) + " is not finite or beyond 1e30");
            }
            scene_.objects.push_back(std::move(instance));
        }
    }

    void note_what_is_left_out() {
        std::uint64_t points = 0, without_positions = 0, polygons = 0, lines = 0;
        for (const GltfMeshPlan& plan : plans_) {
            points += plan.skipped_points;
            without_positions += plan.skipped_without_positions;
            polygons += plan.cut_out_polygons;
            lines += plan.cut_out_lines;
        }
        scene_.skipped_primitives = points + without_positions;
        const auto note = [&](std::uint64_t count, const char* one, const char* more, bool is_unreadable = false) {
            if (count == 0) return;
            const std::string what = std::to_string(count) + " " + (count == 1 ? one : more);
            if (is_unreadable && strict_) {
                throw InputError(path_ + ": " + what +
                                 ", which cannot be drawn; re-export the model without, or leave out --strict");
            }
            scene_.notes.push_back("left out " + what);
        };
        note(points, "primitive of points", "primitives of points", true);
        note(without_positions, "primitive without positions", "primitives without positions", true);
        note(polygons, "polygon that its alphaCutoff makes invisible",
             "polygons that their alphaCutoff makes invisible");
        note(lines, "line that its alphaCutoff makes invisible", "lines that their alphaCutoff makes invisible");
        note(nodes_.invisible_mesh_nodes, "node with a mesh that is not visible",
             "nodes with a mesh that are not visible");
    }

    std::string path_;
    ModelBudget& budget_;
    bool strict_;
    const AttributeWish& attributes_;
    const AnimationWish& animations_;
    MappedFile file_;
    GltfContainer container_;
    nlohmann::json json_;
    JsonPlace root_;
    std::optional<GltfBuffers> buffers_;
    GltfMaterials materials_;
    std::vector<GltfMeshPlan> plans_;        // per glTF mesh
    std::vector<std::uint32_t> first_like_;  // per glTF mesh, the first one that holds the same
    GltfNodes nodes_;
    std::vector<bool> is_moved_;                      // per node, by the animation; empty: there is none
    std::vector<std::map<Pose, std::size_t>> poses_;  // per glTF mesh, numbered as nodes show them
    std::vector<std::size_t> shown_pose_;             // per node that shows a mesh: the number of its pose
    std::vector<std::size_t> first_soup_;             // per glTF mesh: its first pose in the scene
    GltfScene scene_;
};

}  // namespace

GltfScene read_gltf(const std::string& path, ModelBudget& budget, bool strict, const AttributeWish& attributes,
                    const AnimationWish& animations) {
    return GltfReader(path, budget, strict, attributes, animations).read();
}

GltfScene read_gltf(const std::string& path) {
    ModelBudget budget;
    return read_gltf(path, budget);
}

}  // namespace burin
