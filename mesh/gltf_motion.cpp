#include "mesh/gltf_motion.h"

#include <span>
#include <string>

#include "base/error.h"

namespace burin {
namespace {

void check_is_within_reason(const glm::dmat4& matrix, std::uint32_t node) {
    if (is_within_reason(matrix)) return;
    throw InputError("the animation moves node " + std::to_string(node) +
                     " to where it is not finite or beyond 1e30; repair or re-export the file");
}

}  // namespace

std::vector<glm::dmat4> GltfRig::to_world(double time_s) const {
    std::vector<GltfTransform> moved = transforms;
    for (const GltfChannel& channel : animation.channels) {
        GltfTransform& transform = moved[channel.node];
        if (channel.path == GltfPath::rotation) {
            transform.rotation = channel.sampler.sample_rotation(time_s);
        } else if (channel.path != GltfPath::weights) {
            glm::dvec3& value = channel.path == GltfPath::scale ? transform.scale : transform.translation;
            channel.sampler.sample(time_s, std::span(&value.x, 3));
        }
    }
    std::vector<glm::dmat4> result(transforms.size(), glm::dmat4(1.0));
    for (const auto& [node, parent] : tree) {
        result[node] = moved[node].to_parent();
        if (parent != GltfPlacedNode::kNoParent) result[node] = result[parent] * result[node];
        check_is_within_reason(result[node], node);
    }
    return result;
}

std::vector<bool> GltfRig::moved_nodes() const {
    std::vector<bool> is_moved(transforms.size(), false);
    for (const GltfChannel& channel : animation.channels) {
        if (channel.path != GltfPath::weights) is_moved[channel.node] = true;
    }
    for (const auto& [node, parent] : tree) {
        if (parent != GltfPlacedNode::kNoParent && is_moved[parent]) is_moved[node] = true;
    }
    return is_moved;
}

const GltfSampler* GltfRig::weights_of(std::uint32_t node) const {
    for (const GltfChannel& channel : animation.channels) {
        if (channel.path == GltfPath::weights && channel.node == node) return &channel.sampler;
    }
    return nullptr;
}

std::vector<glm::dvec3> GltfMover::positions(const GltfRig& rig, const std::vector<glm::dmat4>& to_world,
                                             double time_s) const {
    std::vector<double> now = weights;
    if (const GltfSampler* const keys = rig.weights_of(weights_node)) {
        now.resize(keys->width);
        keys->sample(time_s, now);
    }
    std::vector<glm::dmat4> joint_matrices;
    for (std::size_t i = 0; i < joints.size(); ++i) joint_matrices.push_back(to_world[joints[i]] * inverse_binds[i]);
    return deformation.positions(now, joint_matrices);
}

glm::dmat4 RiggedObject::to_model(const std::vector<glm::dmat4>& to_world) const {
    const glm::dmat4 matrix = has_skin ? to_node : to_world[node] * to_node;
    check_is_within_reason(matrix, node);
    return matrix;
}

}  // namespace burin
