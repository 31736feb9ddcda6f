#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "mesh/gltf_buffers.h"
#include "mesh/gltf_json.h"

// A node may show its mesh many times; each time is an object.

namespace burin {

/// How many instances of its mesh a node shows by EXT_mesh_gpu_instancing; none: it has no such
/// list, and shows its mesh once.
std::optional<std::uint64_t> gltf_instance_count(const JsonPlace& node, GltfBuffers& buffers);

/// The matrices of the instances, to the space of the node.
std::vector<glm::dmat4> read_gltf_instances(const JsonPlace& node, GltfBuffers& buffers);

}  // namespace burin
