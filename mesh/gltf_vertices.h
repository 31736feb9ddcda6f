#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/gltf_buffers.h"
#include "mesh/gltf_draco.h"
#include "mesh/gltf_plan.h"

// The vertices of a glTF mesh are read once, however many primitives share them.

namespace burin {

/// Where a run of a mesh's vertices comes from: elements of the accessors of a primitive.
struct GltfVertices {
    explicit GltfVertices(const JsonPlace& primitive) : place(primitive) {}

    JsonPlace place;                             ///< of the primitive
    std::size_t first = 0;                       ///< number of the first one in the mesh
    std::uint64_t elements = 0;                  ///< of each accessor
    std::vector<std::uint32_t> used;             ///< the elements that are vertices; empty: all
    std::shared_ptr<const DracoGeometry> draco;  ///< if it is compressed so
    std::vector<std::uint32_t> first_rows;       ///< per attribute of the soup: of the first vertex; or kNoRow

    std::uint64_t size() const { return used.empty() ? elements : used.size(); }
    std::uint64_t element_of(std::uint64_t vertex) const { return used.empty() ? vertex : used[vertex]; }
    /// The vertex, counted in the mesh, that is an element. It must be one that is used.
    std::uint32_t vertex_of(std::uint64_t element) const;
    /// An accessor that must have as many elements: "JOINTS_0".
    GltfAccessor attribute(const char* name, std::string_view type, GltfBuffers& buffers) const;
};

/// A position that must be finite and within 1e30: an element of `accessor`, which stands at
/// `place`.
glm::dvec3 gltf_position(const GltfAccessor& accessor, std::uint64_t element, const JsonPlace& place);

}  // namespace burin
