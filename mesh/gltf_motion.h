#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "mesh/gltf_animation.h"
#include "mesh/gltf_deformation.h"
#include "mesh/gltf_nodes.h"

// How an animation moves what a glTF file shows: nodes, and the vertices of meshes that deform.

namespace burin {

/// Nodes and what moves them.
struct GltfRig {
    GltfAnimation animation;
    std::vector<GltfTransform> transforms;  ///< per node, at rest
    std::vector<GltfPlacedNode> tree;       ///< each node behind its parent

    /// Per node its matrix to the model's space. Throws InputError if one is not finite or beyond 1e30.
    std::vector<glm::dmat4> to_world(double time_s) const;
    /// Per node whether it, or a node that it lies in, is moved.
    std::vector<bool> moved_nodes() const;
    /// The keys of a node's morph weights; nullptr: they are not animated.
    const GltfSampler* weights_of(std::uint32_t node) const;
};

/// What moves the vertices of a mesh.
struct GltfMover {
    static constexpr std::uint32_t kNoNode = 0xFFFFFFFFu;

    GltfDeformation deformation;
    std::vector<double> weights;           ///< of morph targets, at rest; empty: all 0, or there are none
    std::uint32_t weights_node = kNoNode;  ///< whose weights are animated
    std::vector<std::uint32_t> joints;     ///< nodes; empty: it has no skin
    std::vector<glm::dmat4> inverse_binds;

    /// Where the vertices are at a time. `to_world`: of the nodes then.
    std::vector<glm::dvec3> positions(const GltfRig& rig, const std::vector<glm::dmat4>& to_world, double time_s) const;
};

/// Where a node puts an object; one with a skin stands where its joints are.
struct RiggedObject {
    std::uint32_t node = 0;
    bool has_skin = false;
    glm::dmat4 to_node{1.0};

    /// Its place at a time. `to_world`: of the nodes then. Throws InputError if that is not finite or beyond 1e30.
    glm::dmat4 to_model(const std::vector<glm::dmat4>& to_world) const;
};

/// The motion of all that a file shows.
struct GltfMotion {
    GltfRig rig;
    std::vector<RiggedObject> objects;
    std::vector<std::uint32_t> cameras;                       ///< nodes
    std::vector<std::pair<std::uint32_t, GltfMover>> movers;  ///< of meshes that deform, with their numbers
};

}  // namespace burin
