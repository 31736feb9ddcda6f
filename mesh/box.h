#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "mesh/mesh.h"

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

/// Around a mesh's positions, as seen from its origin.
inline Box box_of(const Mesh& mesh) {
    Box box;
    for (const glm::vec3& p : mesh.positions) box.add(glm::dvec3(p));
    return box;
}

}  // namespace burin
