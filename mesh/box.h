#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/glm.hpp>
#include <limits>
#include <span>

#include "mesh/mesh.h"

// Bounds of points are wanted everywhere: of meshes, of polygons, of views.

namespace burin {

/// The smallest box around points; empty without any.
struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    bool is_empty() const { return low.x > high.x; }
    template <typename Visit>
    void for_each_corner(const Visit& visit) const {
        for (int i = 0; i < 8; ++i) {
            visit(glm::dvec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z));
        }
    }
};

/// Around positions. Four are compared at a time, number by number.
inline Box box_of(std::span<const glm::vec3> positions) {
    constexpr std::size_t kNumbers = 12;
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    float low[kNumbers], high[kNumbers];
    std::fill_n(low, kNumbers, std::numeric_limits<float>::infinity());
    std::fill_n(high, kNumbers, -std::numeric_limits<float>::infinity());
    std::size_t i = 0;
    for (; i + 4 <= positions.size(); i += 4) {
        const float* const p = &positions[i].x;
        for (std::size_t k = 0; k < kNumbers; ++k) {
            low[k] = p[k] < low[k] ? p[k] : low[k];
            high[k] = p[k] > high[k] ? p[k] : high[k];
        }
    }
    Box box;
    for (std::size_t k = 0; k < kNumbers; k += 3) {
        box.low = glm::min(box.low, glm::dvec3(low[k], low[k + 1], low[k + 2]));
        box.high = glm::max(box.high, glm::dvec3(high[k], high[k + 1], high[k + 2]));
    }
    for (; i < positions.size(); ++i) box.add(glm::dvec3(positions[i]));
    return box;
}
/// Around a mesh's positions, as seen from its origin.
inline Box box_of(const Mesh& mesh) {
    Box box = box_of(mesh.positions);
    if (mesh.has_residuals()) {
        box = {};
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) box.add(mesh.local_position(v));
    }
    return box;
}

}  // namespace burin
