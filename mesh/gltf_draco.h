#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mesh/gltf_buffers.h"
#include "mesh/gltf_plan.h"

// Primitives that Draco compressed are decoded by the module burin_draco.so.

namespace burin {

/// What Draco compressed of a primitive.
struct DracoGeometry {
    std::vector<std::uint32_t> indices;              ///< three per triangle
    std::map<std::string, GltfAccessor> attributes;  ///< by glTF's names
};

/// Decompresses the positions, joints and weights of a primitive that is_draco(), and the attributes asked for. Loads
/// the module burin_draco.so. Throws InputError if the data are broken or are not as the accessors say.
DracoGeometry decode_draco(const GltfPrimitive& primitive, GltfBuffers& buffers, const AttributeWish& attributes);

}  // namespace burin
