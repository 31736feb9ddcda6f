#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/gltf_buffers.h"
#include "mesh/gltf_plan.h"
#include "mesh/gltf_vertices.h"

// Marked edges of a glTF come from lines, line strips and two extensions.

namespace burin {

/// The vertex numbers of a primitive in order, checked.
class GltfCorners {
  public:
    GltfCorners(const GltfPrimitive& primitive, const DracoGeometry* draco, GltfBuffers& buffers);

    std::uint64_t count() const { return count_; }
    /// An element of the primitive's accessors.
    std::uint64_t operator[](std::uint64_t i) const;

  private:
    const GltfPrimitive& primitive_;
    const DracoGeometry* draco_;
    GltfAccessor indices_;
    std::uint64_t count_;
};

/// The corners of triangle `t` in glTF's order (3.7.2.1), counted in the primitive.
std::array<std::uint64_t, 3> gltf_triangle(std::uint64_t mode, std::uint64_t t);

/// Appends pairs of vertices: the segments of a primitive of lines, or those edges of triangles
/// that EXT_mesh_primitive_edge_visibility or CESIUM_primitive_outline name as always visible.
void append_gltf_marks(const GltfPrimitive& primitive, const GltfCorners& corners, const GltfVertices& vertices,
                       GltfBuffers& buffers, std::vector<std::array<std::uint32_t, 2>>& marks);

}  // namespace burin
