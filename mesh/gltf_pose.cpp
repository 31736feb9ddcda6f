#include "mesh/gltf_pose.h"

#include <algorithm>
#include <cmath>

#include "base/interrupt.h"
#include "mesh/gltf_skin_weights.h"

namespace burin {
namespace {

/// Adds the targets of some vertices.
void add_targets(const GltfVertices& vertices, const std::vector<double>& weights, GltfBuffers& buffers,
                 std::vector<glm::dvec3>& positions) {
    const std::size_t count = vertices.place.size_of("targets");
    if (count != weights.size()) {
        vertices.place.fail("has " + std::to_string(count) + " morph targets, but there are " +
                            std::to_string(weights.size()) + " weights");
    }
    for (std::size_t t = 0; t < count; ++t) {
        const JsonPlace target = vertices.place.at("targets").element(t);
        if (weights[t] == 0 || !target.has("POSITION")) continue;
        throw_if_interrupted();
        const JsonPlace reference = target.at("POSITION");
        const GltfAccessor deltas = gltf_target(vertices, reference, buffers);
        for (std::uint64_t i = 0; i < vertices.size(); ++i) {
            positions[vertices.first + i] += weights[t] * gltf_position(deltas, vertices.element_of(i), reference);
        }
    }
}

void apply_skin(const GltfVertices& vertices, const GltfSkin& skin, const std::vector<bool>& is_used,
                GltfBuffers& buffers, std::vector<glm::dvec3>& positions) {
    GltfSkinWeights skin_weights(vertices, skin.joint_matrices.size(), buffers);
    for (std::uint64_t i = 0; i < vertices.size(); ++i) {
        if ((i & 0xFFFF) == 0) throw_if_interrupted();
        const std::size_t v = vertices.first + i;
        const std::vector<GltfInfluence>& influences = skin_weights.of(vertices.element_of(i));
        if (influences.empty()) {
            if (is_used[v]) skin_weights.fail(vertices.element_of(i));
            continue;
        }
        const glm::dvec4 at_rest(positions[v], 1.0);
        glm::dvec3 moved(0.0);
        for (const GltfInfluence& influence : influences) {
            moved += influence.weight * glm::dvec3(skin.joint_matrices[influence.joint] * at_rest);
        }
        positions[v] = moved;
    }
}

}  // namespace

std::vector<bool> used_vertices(const PolygonSoup& soup) {
    std::vector<bool> is_used(soup.positions.size(), false);
    for (const std::uint32_t v : soup.corners) is_used[v] = true;
    for (const auto& [a, b] : soup.marked_edges) is_used[a] = is_used[b] = true;
    return is_used;
}

GltfAccessor gltf_target(const GltfVertices& vertices, const JsonPlace& reference, GltfBuffers& buffers) {
    GltfAccessor deltas = buffers.accessor(reference, "VEC3", vertices.elements);
    if (deltas.count != vertices.elements) {
        reference.fail("has " + std::to_string(deltas.count) + " elements, but there are " +
                       std::to_string(vertices.elements) + " positions");
    }
    return deltas;
}

GltfSkin read_gltf_skin(const JsonPlace& skin, const GltfNodes& nodes, GltfBuffers& buffers) {
    GltfSkin result;
    const JsonPlace joints = skin.at("joints");
    if (joints.size() == 0) joints.fail("a skin needs a joint");
    GltfAccessor matrices;
    if (skin.has("inverseBindMatrices")) {
        const JsonPlace place = skin.at("inverseBindMatrices");
        matrices = buffers.accessor(place, "MAT4");
        if (matrices.component_type != kGltfFloat) place.fail("must be floats");
        if (matrices.count < joints.size()) {
            place.fail("has " + std::to_string(matrices.count) + " matrices for " + std::to_string(joints.size()) +
                       " joints");
        }
    }
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const JsonPlace joint = joints.element(i);
        const std::uint32_t node = joint.index_below(nodes.to_world.size(), "node");
        if (!nodes.is_placed[node]) joint.fail("the node is its own ancestor");
        glm::dmat4 inverse_bind(1.0);
        if (matrices.count > 0) {
            for (int k = 0; k < 16; ++k) inverse_bind[k / 4][k % 4] = matrices.number(i, k);
        }
        result.joints.push_back(node);
        result.inverse_binds.push_back(inverse_bind);
        result.joint_matrices.push_back(nodes.to_world[node] * inverse_bind);
        if (is_within_reason(inverse_bind) && is_within_reason(result.joint_matrices.back())) {
            continue;
        }
        joint.fail("its matrix, with the inverse bind matrix, is not finite or beyond 1e30");
    }
    return result;
}

std::vector<double> gltf_morph_weights(const JsonPlace& node, const JsonPlace& mesh) {
    const JsonPlace& owner = node.has("weights") ? node : mesh;
    std::vector<double> weights;
    bool is_moved = false;
    for (std::size_t i = 0; i < owner.size_of("weights"); ++i) {
        weights.push_back(owner.at("weights").element(i).number());
        is_moved |= weights.back() != 0;
    }
    return is_moved ? weights : std::vector<double>();
}

void pose_gltf_mesh(GltfSurface& surface, const std::vector<double>& weights, const GltfSkin* skin,
                    GltfBuffers& buffers) {
    std::vector<glm::dvec3>& positions = surface.soup.positions;
    std::vector<bool> is_used;
    if (skin != nullptr) is_used = used_vertices(surface.soup);
    for (const GltfVertices& vertices : surface.vertices) {
        if (vertices.size() == 0) continue;
        if (!weights.empty()) add_targets(vertices, weights, buffers, positions);
        if (skin != nullptr) apply_skin(vertices, *skin, is_used, buffers, positions);
        for (std::uint64_t i = 0; i < vertices.size(); ++i) {
            const glm::dvec3& p = positions[vertices.first + i];
            if (std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate &&
                std::abs(p.z) <= kLargestCoordinate) {
                continue;
            }
            vertices.place.fail("morph targets or joints move vertex " + std::to_string(vertices.element_of(i)) +
                                " beyond 1e30");
        }
    }
}

}  // namespace burin
