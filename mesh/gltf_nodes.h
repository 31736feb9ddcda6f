#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "mesh/gltf_json.h"

// Nodes of a glTF are walked from their roots, and give matrices to meshes and cameras.

namespace burin {

/// A glTF camera where its node puts it. It looks down its own -Z, with +Y up.
struct GltfCamera {
    std::string name;
    bool orthographic = false;
    double fov_deg = 0;  ///< vertical, perspective only
    double height = 0;   ///< full visible height in world units, orthographic only
    glm::dmat4 to_world{1.0};
    std::uint32_t node = 0;
};

/// A node of the default scene that shows a mesh.
struct GltfMeshNode {
    std::uint32_t node = 0;
    std::uint32_t mesh = 0;
    std::string name;
};

/// How a node lies in its parent: a matrix, or parts that animations may move.
struct GltfTransform {
    bool has_matrix = false;
    glm::dmat4 matrix{1.0};  ///< if it has one
    glm::dvec3 translation{0.0};
    glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0};  ///< a quaternion: x, y, z, w
    glm::dvec3 scale{1.0};

    glm::dmat4 to_parent() const;
};
GltfTransform read_gltf_transform(const JsonPlace& node);

/// A node in the tree.
struct GltfPlacedNode {
    static constexpr std::uint32_t kNoParent = 0xFFFFFFFFu;
    std::uint32_t node = 0;
    std::uint32_t parent = kNoParent;
};

/// The nodes of a glTF file where the file puts them.
struct GltfNodes {
    std::vector<GltfMeshNode> mesh_nodes;  ///< in the order of the tree; only visible ones
    std::vector<GltfCamera> cameras;
    std::vector<glm::dmat4> to_world;  ///< per node; if there are skins, outside the scene too
    std::vector<bool> is_placed;       ///< per node, whether it has a matrix there
    std::vector<GltfPlacedNode> tree;  ///< those nodes, each behind its parent
    std::uint64_t invisible_mesh_nodes = 0;
};

/// `root` is the whole JSON. Each node must have one place in the tree.
GltfNodes read_gltf_nodes(const JsonPlace& root);

/// The matrix of a translation, a rotation by a quaternion (x, y, z, w), and a scale before both.
glm::dmat4 gltf_matrix(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale);

/// Whether all numbers of a matrix are finite and within 1e30.
bool is_within_reason(const glm::dmat4& matrix);

}  // namespace burin
