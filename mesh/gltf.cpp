#include "mesh/gltf.h"

#include <map>
#include <optional>
#include <tuple>

#include "base/interrupt.h"
#include "base/mapped_file.h"
#include "mesh/gltf_buffers.h"
#include "mesh/gltf_container.h"
#include "mesh/gltf_extensions.h"
#include "mesh/gltf_instances.h"
#include "mesh/gltf_json.h"
#include "mesh/gltf_materials.h"
#include "mesh/gltf_plan.h"
#include "mesh/gltf_pose.h"
#include "mesh/gltf_surface.h"

namespace burin {
namespace {

/// How a node shows a mesh.
struct Pose {
    std::optional<std::uint32_t> skin;
    std::vector<double> weights;  ///< of morph targets; empty: none is added

    auto operator<=>(const Pose&) const = default;
};

class GltfReader {
  public:
    GltfReader(const std::string& path, ModelBudget& budget, bool strict, const AttributeWish& attributes)
        : path_(path),
          budget_(budget),
          strict_(strict),
          attributes_(attributes),
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
        plan_poses();
        count_memory();
        make_meshes();
        place_objects();
        scene_.materials = std::move(materials_.materials);
        scene_.cameras = std::move(nodes_.cameras);
        note_what_is_left_out();
        buffers_->check_are_whole();
        scene_.buffer_files = buffers_->files();
        return std::move(scene_);
    }

  private:
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

    JsonPlace node(const GltfMeshNode& shown) const { return root_.at("nodes").element(shown.node); }

    Pose pose_of(const GltfMeshNode& shown) const {
        const JsonPlace place = node(shown);
        Pose pose;
        pose.weights = gltf_morph_weights(place, root_.at("meshes").element(shown.mesh));
        if (place.has("skin")) {
            pose.skin = place.at("skin").index_below(root_.size_of("skins"), "skin");
        }
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
        for (std::uint32_t i = 0; i < plans_.size(); ++i) {
            expansion.add_mesh(plans_[i], poses_[i].size());
        }
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
                scene_.objects.push_back(std::move(object));
                continue;
            }
            if (has_skin) place.fail("a node with a skin cannot have instances");
            place_instances(object, read_gltf_instances(place, *buffers_), place);
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
    MappedFile file_;
    GltfContainer container_;
    nlohmann::json json_;
    JsonPlace root_;
    std::optional<GltfBuffers> buffers_;
    GltfMaterials materials_;
    std::vector<GltfMeshPlan> plans_;        // per glTF mesh
    std::vector<std::uint32_t> first_like_;  // per glTF mesh, the first one that holds the same
    GltfNodes nodes_;
    std::vector<std::map<Pose, std::size_t>> poses_;  // per glTF mesh, numbered as nodes show them
    std::vector<std::size_t> shown_pose_;             // per node that shows a mesh: the number of its pose
    std::vector<std::size_t> first_soup_;             // per glTF mesh: its first pose in the scene
    GltfScene scene_;
};

}  // namespace

GltfScene read_gltf(const std::string& path, ModelBudget& budget, bool strict, const AttributeWish& attributes) {
    return GltfReader(path, budget, strict, attributes).read();
}

GltfScene read_gltf(const std::string& path) {
    ModelBudget budget;
    return read_gltf(path, budget);
}

}  // namespace burin
