#include "mesh/gltf_deformation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/interrupt.h"
#include "mesh/gltf_pose.h"

namespace burin {
namespace {

template <typename T>
std::span<const T> part_of(const std::vector<T>& all, const std::vector<std::uint64_t>& ends, std::size_t i) {
    if (ends.empty()) return {};
    const std::uint64_t begin = i == 0 ? 0 : ends[i - 1];
    return {all.data() + begin, ends[i] - begin};
}

/// The order of two numbers that are not NaN: -1, 0, 1.
template <typename T>
int order_of(const T& a, const T& b) {
    return a < b ? -1 : (b < a ? 1 : 0);
}

}  // namespace

GltfDeformation::GltfDeformation(const GltfSurface& surface, std::size_t target_count, std::size_t joint_count,
                                 GltfBuffers& buffers)
    : place_(surface.soup.object_names.front()), base_(surface.soup.positions) {
    if (target_count > 0) delta_ends_.reserve(base_.size());
    if (joint_count > 0) influence_ends_.reserve(base_.size());
    std::vector<bool> is_used;
    if (joint_count > 0) is_used = used_vertices(surface.soup);
    for (const GltfVertices& vertices : surface.vertices) {
        if (vertices.size() == 0) continue;
        if (target_count > 0) add_targets_of(vertices, target_count, buffers);
        if (joint_count > 0) add_influences_of(vertices, joint_count, is_used, buffers);
    }
}

std::uint64_t GltfDeformation::most_bytes(std::uint64_t vertices, std::size_t target_count, bool has_skin) {
    constexpr std::uint64_t kSparseValue = 16;  // a copy of one that is sparse in the file
    const std::uint64_t per_vertex = sizeof(glm::dvec3) + target_count * (sizeof(Delta) + kSparseValue) +
                                     (has_skin ? 4 * sizeof(GltfInfluence) : 0) + 2 * sizeof(std::uint64_t);
    return saturating_product(vertices, per_vertex);
}

void GltfDeformation::add_targets_of(const GltfVertices& vertices, std::size_t target_count, GltfBuffers& buffers) {
    const std::size_t count = vertices.place.size_of("targets");
    if (count != target_count) {
        vertices.place.fail("has " + std::to_string(count) + " morph targets, but " + std::to_string(target_count) +
                            " weights are animated");
    }
    struct Target {
        std::uint32_t number;
        JsonPlace place;
        GltfAccessor deltas;
    };
    std::vector<Target> targets;
    for (std::size_t t = 0; t < count; ++t) {
        const JsonPlace target = vertices.place.at("targets").element(t);
        if (!target.has("POSITION")) continue;
        const JsonPlace place = target.at("POSITION");
        targets.push_back({static_cast<std::uint32_t>(t), place, gltf_target(vertices, place, buffers)});
    }
    for (std::uint64_t i = 0; i < vertices.size(); ++i) {
        if ((i & 0xFFFF) == 0) throw_if_interrupted();
        for (const Target& target : targets) {
            const glm::dvec3 by = gltf_position(target.deltas, vertices.element_of(i), target.place);
            if (by != glm::dvec3(0.0)) deltas_.push_back({target.number, by});
        }
        delta_ends_.push_back(deltas_.size());
    }
}

void GltfDeformation::add_influences_of(const GltfVertices& vertices, std::size_t joint_count,
                                        const std::vector<bool>& is_used, GltfBuffers& buffers) {
    GltfSkinWeights skin_weights(vertices, joint_count, buffers);
    for (std::uint64_t i = 0; i < vertices.size(); ++i) {
        if ((i & 0xFFFF) == 0) throw_if_interrupted();
        const std::vector<GltfInfluence>& own = skin_weights.of(vertices.element_of(i));
        if (own.empty() && is_used[vertices.first + i]) skin_weights.fail(vertices.element_of(i));
        influences_.insert(influences_.end(), own.begin(), own.end());
        influence_ends_.push_back(influences_.size());
    }
}

std::span<const GltfDeformation::Delta> GltfDeformation::deltas_of(std::size_t vertex) const {
    return part_of(deltas_, delta_ends_, vertex);
}

std::span<const GltfInfluence> GltfDeformation::influences_of(std::size_t vertex) const {
    return part_of(influences_, influence_ends_, vertex);
}

std::vector<glm::dvec3> GltfDeformation::positions(std::span<const double> weights,
                                                   std::span<const glm::dmat4> joint_matrices) const {
    std::vector<glm::dvec3> result = base_;
    for (std::size_t v = 0; v < result.size(); ++v) {
        if ((v & 0xFFFF) == 0) throw_if_interrupted();
        glm::dvec3& p = result[v];
        if (!weights.empty()) {
            for (const Delta& delta : deltas_of(v)) p += weights[delta.target] * delta.by;
        }
        if (const std::span<const GltfInfluence> influences = influences_of(v); !influences.empty()) {
            const glm::dvec4 at_rest(p, 1.0);
            p = glm::dvec3(0.0);
            for (const GltfInfluence& influence : influences)
                p += influence.weight * glm::dvec3(joint_matrices[influence.joint] * at_rest);
        }
        if (std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate &&
            std::abs(p.z) <= kLargestCoordinate) {
            continue;
        }
        throw InputError("the animation moves vertex " + std::to_string(v) + " of mesh '" + printable(place_) +
                         "' beyond 1e30; repair or re-export the file");
    }
    return result;
}

/// An order of vertices by all that moves them.
int GltfDeformation::compare(std::size_t a, std::size_t b) const {
    const std::span<const Delta> own = deltas_of(a), other = deltas_of(b);
    if (const int by_count = order_of(own.size(), other.size()); by_count != 0) return by_count;
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (const int by_target = order_of(own[i].target, other[i].target); by_target != 0) return by_target;
        for (int k = 0; k < 3; ++k) {
            if (const int by_delta = order_of(own[i].by[k], other[i].by[k]); by_delta != 0) return by_delta;
        }
    }
    const std::span<const GltfInfluence> mine = influences_of(a), others = influences_of(b);
    if (const int by_count = order_of(mine.size(), others.size()); by_count != 0) return by_count;
    for (std::size_t i = 0; i < mine.size(); ++i) {
        if (mine[i] < others[i]) return -1;
        if (others[i] < mine[i]) return 1;
    }
    return 0;
}

std::vector<std::uint32_t> GltfDeformation::kinds() const {
    std::vector<std::uint32_t> order(base_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return compare(a, b) < 0; });
    std::vector<std::uint32_t> kinds(base_.size());
    std::uint32_t kind = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && compare(order[i - 1], order[i]) != 0) ++kind;
        kinds[order[i]] = kind;
    }
    return kinds;
}

}  // namespace burin
