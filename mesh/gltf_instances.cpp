#include "mesh/gltf_instances.h"

#include <cmath>

#include "base/interrupt.h"
#include "mesh/gltf_nodes.h"

namespace burin {
namespace {

constexpr const char* kExtension = "EXT_mesh_gpu_instancing";

/// One of the lists of a node; none if it is not there.
class InstanceList {
  public:
    InstanceList(const JsonPlace& attributes, const char* key, std::string_view type, GltfBuffers& buffers) {
        if (!attributes.has(key)) return;
        place_ = attributes.at(key);
        accessor_ = buffers.accessor(*place_, type);
        const std::uint64_t number = accessor_.component_type;
        const bool is_small = type == "VEC4" && accessor_.normalized && (number == kGltfByte || number == kGltfShort);
        if (number != kGltfFloat && !is_small) {
            place_->fail(type == "VEC4" ? "must be floats, or normalized bytes or shorts" : "must be floats");
        }
    }

    glm::dvec4 operator()(std::uint64_t i, glm::dvec4 value) const {
        if (!place_) return value;
        for (int c = 0; c < accessor_.components; ++c) {
            value[c] = accessor_.number(i, c);
            if (!(std::abs(value[c]) <= kLargestCoordinate)) {
                place_->fail("entry " + std::to_string(i) + " is not finite or beyond 1e30");
            }
        }
        return value;
    }

  private:
    std::optional<JsonPlace> place_;
    GltfAccessor accessor_;
};

}  // namespace

std::optional<std::uint64_t> gltf_instance_count(const JsonPlace& node, GltfBuffers& buffers) {
    if (!node.has_extension(kExtension)) return std::nullopt;
    const JsonPlace attributes = node.extension(kExtension).at("attributes");
    std::optional<std::uint64_t> count;
    for (const char* key : {"TRANSLATION", "ROTATION", "SCALE"}) {
        if (!attributes.has(key)) continue;
        const std::string_view type = std::string_view(key) == "ROTATION" ? "VEC4" : "VEC3";
        const std::uint64_t own = buffers.without_sparse(attributes.at(key), type).count;
        if (count && own != *count) {
            attributes.at(key).fail("has " + std::to_string(own) + " entries, and not " + std::to_string(*count) +
                                    " as those before it");
        }
        count = own;
    }
    return count;  // lists of other names place nothing
}

std::vector<glm::dmat4> read_gltf_instances(const JsonPlace& node, GltfBuffers& buffers) {
    const std::uint64_t count = gltf_instance_count(node, buffers).value_or(0);
    const JsonPlace attributes = node.extension(kExtension).at("attributes");
    const InstanceList translations(attributes, "TRANSLATION", "VEC3", buffers);
    const InstanceList rotations(attributes, "ROTATION", "VEC4", buffers);
    const InstanceList scales(attributes, "SCALE", "VEC3", buffers);
    std::vector<glm::dmat4> matrices;
    matrices.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        if ((i & 0xFFFF) == 0) throw_if_interrupted();
        glm::dvec4 rotation = rotations(i, glm::dvec4(0.0, 0.0, 0.0, 1.0));
        // Small integers make it longer or shorter, and that would be a scale.
        const double length = glm::length(rotation);
        if (length == 0) {
            attributes.at("ROTATION").fail("entry " + std::to_string(i) + " is no rotation");
        }
        if (length != 1) rotation /= length;
        matrices.push_back(gltf_matrix(glm::dvec3(translations(i, glm::dvec4(0.0))), rotation,
                                       glm::dvec3(scales(i, glm::dvec4(1.0)))));
    }
    return matrices;
}

}  // namespace burin
