#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/model_budget.h"
#include "mesh/animation_choice.h"
#include "mesh/gltf_motion.h"
#include "mesh/gltf_nodes.h"
#include "mesh/polygon_soup.h"

// A glTF file becomes a Model: meshes where their nodes put them, materials, cameras.

namespace burin {

/// A node that shows a mesh, or one of its instances: an object.
struct GltfObject {
    std::string name;
    std::uint32_t mesh = 0;
    glm::dmat4 to_world{1.0};
};

/// The default scene of a glTF 2.0 file.
struct GltfScene {
    /// One per glTF mesh, and per pose in which nodes show it; materials are numbers into
    /// `materials`. Meshes that hold the same are there once.
    std::vector<PolygonSoup> meshes;
    std::vector<std::string> mesh_names;
    std::vector<Material> materials;  ///< the last one is the default material
    std::vector<GltfObject> objects;
    std::vector<GltfCamera> cameras;
    std::uint64_t skipped_primitives = 0;      ///< of points, or without positions
    std::vector<std::string> notes;            ///< these, and what the file itself makes invisible, a line each
    std::vector<std::string> buffer_files;     ///< paths of the buffers that are files
    std::vector<std::string> picture_files;    ///< paths of pictures, which are not read and may be missing
    std::optional<GltfMotion> motion;          ///< of what is above; none: nothing moves, or nobody asks
    std::vector<AnimationSummary> animations;  ///< if they were asked for
};

/// Reads `.gltf` and `.glb`. Morph targets have the weights of the file, skins stand where the
/// nodes of the file put their joints, lines are marked edges; textures are not looked at, and
/// animations as far as `animations` asks. Buffers may be embedded, data URIs, or files in the
/// model's folder or below.
///
/// Everything is checked before use: numbers of nodes, meshes, accessors and views, the room in
/// buffers, node cycles. Throws InputError that names the place as glTF writes it,
/// "meshes[2].primitives[0].indices". What the file makes of its data by naming them again and
/// again, or has compressed, is counted in `budget` before it is expanded. `strict` refuses a file
/// with skipped primitives. `attributes`: what to keep of TEXCOORD_0, COLOR_0, and numbers whose names begin with "_".
GltfScene read_gltf(const std::string& path, ModelBudget& budget, bool strict = false,
                    const AttributeWish& attributes = {}, const AnimationWish& animations = {});
GltfScene read_gltf(const std::string& path);

}  // namespace burin
