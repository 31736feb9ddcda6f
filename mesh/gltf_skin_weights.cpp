#include "mesh/gltf_skin_weights.h"

#include <algorithm>

namespace burin {
namespace {

std::string numbered(const char* prefix, int n) { return prefix + std::to_string(n); }

}  // namespace

GltfSkinWeights::GltfSkinWeights(const GltfVertices& vertices, std::size_t joint_count, GltfBuffers& buffers)
    : attributes_(vertices.place.at("attributes")), joint_count_(joint_count) {
    for (int n = 0; n == 0 || has("JOINTS_", n) || has("WEIGHTS_", n); ++n) {
        Set set;
        set.joints_name = numbered("JOINTS_", n);
        set.weights_name = numbered("WEIGHTS_", n);
        set.joints = vertices.attribute(set.joints_name.c_str(), "VEC4", buffers);
        set.weights = vertices.attribute(set.weights_name.c_str(), "VEC4", buffers);
        set.joints.normalized = false;
        const std::uint64_t joint = set.joints.component_type;
        if (joint != kGltfUnsignedByte && joint != kGltfUnsignedShort) {
            attributes_.at(set.joints_name.c_str()).fail("must be unsigned bytes or shorts");
        }
        const std::uint64_t weight = set.weights.component_type;
        if (weight != kGltfFloat && weight != kGltfUnsignedByte && weight != kGltfUnsignedShort) {
            attributes_.at(set.weights_name.c_str()).fail("must be floats, or normalized unsigned bytes or shorts");
        }
        set.weights.normalized = weight != kGltfFloat;
        sets_.push_back(std::move(set));
    }
}

const std::vector<GltfInfluence>& GltfSkinWeights::of(std::uint64_t element) {
    influences_.clear();
    for (const Set& set : sets_) {
        for (int c = 0; c < 4; ++c) add(set, element, c);
    }
    std::sort(influences_.begin(), influences_.end(), [](const GltfInfluence& a, const GltfInfluence& b) {
        return a.joint != b.joint ? a.joint < b.joint : a.weight < b.weight;
    });
    std::size_t count = 0;
    double sum = 0;
    for (const GltfInfluence influence : influences_) {
        sum += influence.weight;
        if (count > 0 && influences_[count - 1].joint == influence.joint) {
            influences_[count - 1].weight += influence.weight;
        } else {
            influences_[count++] = influence;
        }
    }
    influences_.resize(count);
    for (GltfInfluence& influence : influences_) influence.weight /= sum;
    return influences_;
}

void GltfSkinWeights::fail(std::uint64_t element) const {
    attributes_.at("WEIGHTS_0").fail("the weights of vertex " + std::to_string(element) + " sum to 0");
}

bool GltfSkinWeights::has(const char* prefix, int n) const { return attributes_.has(numbered(prefix, n).c_str()); }

void GltfSkinWeights::add(const Set& set, std::uint64_t element, int component) {
    const double weight = set.weights.number(element, component);
    if (weight == 0) return;
    if (!(weight > 0 && weight <= kLargestCoordinate)) {
        attributes_.at(set.weights_name.c_str())
            .fail("vertex " + std::to_string(element) + " has a weight that is below 0 or not finite");
    }
    const auto joint = static_cast<std::uint32_t>(set.joints.number(element, component));
    if (joint >= joint_count_) {
        attributes_.at(set.joints_name.c_str())
            .fail("vertex " + std::to_string(element) + " has joint " + std::to_string(joint) + ", but its skin has " +
                  std::to_string(joint_count_));
    }
    influences_.push_back({joint, weight});
}

}  // namespace burin
