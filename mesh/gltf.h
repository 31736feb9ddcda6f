#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mesh/polygon_soup.h"

namespace burin {

/// A glTF camera where its node puts it. It looks down its own -Z, with +Y up.
struct GltfCamera {
    std::string name;
    bool orthographic = false;
    double fov_deg = 0;  ///< vertical, perspective only
    double height = 0;   ///< full visible height in world units, orthographic only
    glm::dmat4 to_world{1.0};
};

/// A node that shows a mesh: an object.
struct GltfObject {
    std::string name;
    std::uint32_t mesh = 0;
    glm::dmat4 to_world{1.0};
};

/// The default scene of a glTF 2.0 file.
struct GltfScene {
    std::vector<PolygonSoup> meshes;  ///< one per glTF mesh; materials are numbers into `materials`
    std::vector<std::string> mesh_names;
    std::vector<Material> materials;  ///< the last one is the default material
    std::vector<GltfObject> objects;
    std::vector<GltfCamera> cameras;
    std::uint64_t skipped_primitives = 0;  ///< points and lines
    std::vector<std::string> buffer_files; ///< paths of the buffers that are files
};

/// Reads `.gltf` and `.glb`. Skins and morph targets stay in their rest pose; textures are not
/// looked at. Buffers may be embedded, data URIs, or files in the model's folder or below.
///
/// Everything is checked before use: numbers of nodes, meshes, accessors and views, the room in
/// buffers, node cycles. Throws InputError that names the place as glTF writes it,
/// "meshes[2].primitives[0].indices".
GltfScene read_gltf(const std::string& path);

}  // namespace burin
