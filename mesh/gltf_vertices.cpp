#include "mesh/gltf_vertices.h"

#include <algorithm>
#include <cmath>

namespace burin {

std::uint32_t GltfVertices::vertex_of(std::uint64_t element) const {
    if (used.empty()) return static_cast<std::uint32_t>(first + element);
    const auto at = std::lower_bound(used.begin(), used.end(), element);
    return static_cast<std::uint32_t>(first + static_cast<std::size_t>(at - used.begin()));
}

GltfAccessor GltfVertices::attribute(const char* name, std::string_view type, GltfBuffers& buffers) const {
    if (draco) {
        const auto compressed = draco->attributes.find(name);
        if (compressed != draco->attributes.end()) return compressed->second;
    }
    const JsonPlace reference = place.at("attributes").at(name);
    GltfAccessor accessor = buffers.accessor(reference, type, elements);
    if (accessor.count != elements) {
        reference.fail("has " + std::to_string(accessor.count) + " elements, but there are " +
                       std::to_string(elements) + " positions");
    }
    return accessor;
}

glm::dvec3 gltf_position(const GltfAccessor& accessor, std::uint64_t element, const JsonPlace& place) {
    const glm::dvec3 p(accessor.number(element, 0), accessor.number(element, 1), accessor.number(element, 2));
    if (!(std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate &&
          std::abs(p.z) <= kLargestCoordinate)) {
        place.fail("vertex " + std::to_string(element) + " is not finite or beyond 1e30");
    }
    return p;
}

}  // namespace burin
