#include "mesh/gltf_nodes.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace burin {
namespace {

class NodeWalk {
  public:
    explicit NodeWalk(const JsonPlace& root) : root_(root), count_(root.size_of("nodes")), visited_(count_, false) {
        result_.to_world.assign(count_, glm::dmat4(1.0));
    }

    GltfNodes walk() {
        const std::size_t scene_count = root_.size_of("scenes");
        if (scene_count > 0) {
            const std::uint32_t number = root_.has("scene") ? root_.at("scene").index_below(scene_count, "scene") : 0;
            const JsonPlace scene = root_.at("scenes").element(number);
            if (scene.has("nodes")) push_list(scene.at("nodes"), kNoParent, glm::dmat4(1.0), true);
        } else {
            push_roots();
        }
        visit_all();
        if (root_.size_of("skins") > 0) {  // joints may lie elsewhere
            in_scene_ = false;
            push_roots();
            visit_all();
        }
        result_.is_placed = std::move(visited_);
        return std::move(result_);
    }

  private:
    static constexpr std::uint32_t kNoParent = GltfPlacedNode::kNoParent;
    struct Pending {
        std::uint32_t node, parent_node;
        glm::dmat4 parent;
        bool is_visible;
    };

    /// Pushes all nodes without a parent.
    void push_roots() {
        std::vector<bool> is_child(count_, false);
        for (std::size_t i = 0; i < count_; ++i) {
            const JsonPlace node = root_.at("nodes").element(i);
            for (std::size_t k = 0; k < node.size_of("children"); ++k) {
                is_child[node.at("children").element(k).index_below(count_, "node")] = true;
            }
        }
        for (std::size_t i = count_; i-- > 0;) {
            if (is_child[i]) continue;
            pending_.push_back({static_cast<std::uint32_t>(i), kNoParent, glm::dmat4(1.0), true});
        }
    }

    void push_list(const JsonPlace& list, std::uint32_t parent_node, const glm::dmat4& parent, bool is_visible) {
        for (std::size_t i = list.size(); i-- > 0;) {  // the first one ends up on top
            pending_.push_back({list.element(i).index_below(count_, "node"), parent_node, parent, is_visible});
        }
    }

    /// Each node has one place in the tree: a second visit is a cycle, or a node with two parents,
    /// which glTF forbids.
    void visit_all() {
        while (!pending_.empty()) {
            const Pending next = pending_.back();
            pending_.pop_back();
            if (visited_[next.node]) {
                if (!in_scene_) continue;
                root_.at("nodes").element(next.node).fail(
                    "the node is reached twice: it is its own ancestor or has two parents");
            }
            visited_[next.node] = true;
            visit(next);
        }
    }

    void visit(const Pending& place) {
        const JsonPlace node = root_.at("nodes").element(place.node);
        const glm::dmat4 to_world = place.parent * read_gltf_transform(node).to_parent();
        if (!is_within_reason(to_world)) {
            node.fail("its transform, with those of its parents, is not finite or beyond 1e30");
        }
        result_.to_world[place.node] = to_world;
        result_.tree.push_back({place.node, place.parent_node});
        const bool is_visible = place.is_visible && is_visible_itself(node);
        if (in_scene_) show(place.node, node, to_world, is_visible);
        if (node.has("children")) push_list(node.at("children"), place.node, to_world, is_visible);
    }

    void show(std::uint32_t number, const JsonPlace& node, const glm::dmat4& to_world, bool is_visible) {
        const std::string name = node.text_or("name", "node" + std::to_string(number));
        if (node.has("mesh")) {
            const std::uint32_t mesh = node.at("mesh").index_below(root_.size_of("meshes"), "mesh");
            if (is_visible) {
                result_.mesh_nodes.push_back({number, mesh, name});
            } else {
                ++result_.invisible_mesh_nodes;
            }
        }
        if (node.has("camera")) read_camera(number, node, name, to_world);
    }

    static bool is_visible_itself(const JsonPlace& node) {
        if (!node.has_extension("KHR_node_visibility")) return true;
        const JsonPlace extension = node.extension("KHR_node_visibility");
        return !extension.has("visible") || extension.at("visible").boolean();
    }

    void read_camera(std::uint32_t node_number, const JsonPlace& node, const std::string& node_name,
                     const glm::dmat4& to_world) {
        const std::uint32_t number = node.at("camera").index_below(root_.size_of("cameras"), "camera");
        const JsonPlace place = root_.at("cameras").element(number);
        GltfCamera camera;
        camera.name = place.text_or("name", node_name);
        camera.to_world = to_world;
        camera.node = node_number;
        if (place.at("type").text() == "orthographic") {
            camera.orthographic = true;
            camera.height = 2 * place.at("orthographic").at("ymag").number();
        } else {
            camera.fov_deg = glm::degrees(place.at("perspective").at("yfov").number());
        }
        result_.cameras.push_back(camera);
    }

    const JsonPlace& root_;
    std::size_t count_;
    std::vector<bool> visited_;
    std::vector<Pending> pending_;
    bool in_scene_ = true;
    GltfNodes result_;
};

}  // namespace

glm::dmat4 GltfTransform::to_parent() const { return has_matrix ? matrix : gltf_matrix(translation, rotation, scale); }

GltfTransform read_gltf_transform(const JsonPlace& node) {
    GltfTransform transform;
    if (node.has("matrix")) {
        const JsonPlace numbers = node.at("matrix");
        if (numbers.size() != 16) numbers.fail("a matrix has 16 numbers");
        transform.has_matrix = true;
        for (std::size_t i = 0; i < 16; ++i) {
            transform.matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = numbers.element(i).number();
        }
        return transform;
    }
    const auto read = [&](const char* key, auto& value) {
        if (!node.has(key)) return;
        const JsonPlace numbers = node.at(key);
        const auto size = static_cast<std::size_t>(value.length());
        if (numbers.size() != size) numbers.fail("needs " + std::to_string(size) + " numbers");
        for (std::size_t i = 0; i < size; ++i) value[static_cast<int>(i)] = numbers.element(i).number();
    };
    read("translation", transform.translation);
    read("rotation", transform.rotation);
    read("scale", transform.scale);
    return transform;
}

GltfNodes read_gltf_nodes(const JsonPlace& root) { return NodeWalk(root).walk(); }

glm::dmat4 gltf_matrix(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale) {
    glm::dmat4 matrix = glm::mat4_cast(glm::dquat(rotation.w, rotation.x, rotation.y, rotation.z));
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= scale[axis];
    matrix[3] = glm::dvec4(translation, 1.0);
    return matrix;
}

bool is_within_reason(const glm::dmat4& matrix) {
    for (int i = 0; i < 16; ++i) {
        if (!(std::abs(matrix[i / 4][i % 4]) <= kLargestCoordinate)) return false;
    }
    return true;
}

}  // namespace burin
