#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "mesh/animation_choice.h"
#include "mesh/build_meshes.h"
#include "mesh/mesh.h"
#include "mesh/other_files.h"
#include "mesh/polygon_soup.h"

// A model is what a file or a shape gives to a scene: meshes, objects, materials, cameras, and notes about how it was
// read.

namespace burin {

class ModelPlayer;

/// A mesh at its place in the model: an object.
struct ModelObject {
    std::string name;
    std::uint32_t mesh = 0;
    glm::dmat4 to_world{1.0};
};

/// A camera of the file. It looks down its own -Z, with +Y up.
struct ModelCamera {
    std::string name;
    bool orthographic = false;
    double fov_deg = 0;  ///< vertical, perspective only
    double height = 0;   ///< full visible height in world units, orthographic only
    glm::dmat4 to_world{1.0};
};

/// All that one file holds. Several objects may show one mesh (instances).
struct Model {
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<ModelObject> objects;
    std::vector<ModelCamera> cameras;
    std::uint64_t skipped_primitives = 0;   ///< of a glTF: points, and what has no positions
    std::uint64_t non_finite_polygons = 0;  ///< left out, of an STL
    std::vector<std::string> notes;  ///< what the user should know of how the file was read: "path: what", a line each
    std::vector<std::string> attribute_names;  ///< of the values at vertices that have names, if any were asked for
    OtherFiles other_files;
    std::shared_ptr<const ModelPlayer> player;  ///< how it moves; nullptr: it does not, or nobody asks
    std::vector<AnimationSummary> animations;   ///< of the file, if they were asked for
};

/// The extensions of the formats that read_model can read, as messages list them.
inline constexpr const char* kModelExtensions = ".obj .ply .stl .off .gltf .glb";

/// True if the extension names a format that read_model can read.
bool is_model_file(const std::string& path);

/// Reads a file of the format that its extension says (in any case).
/// Throws InputError when the file cannot be read or no polygon with an area is in it; if `options` are strict, also
/// where there would be a note. `animations`: what is wanted of them.
Model read_model(const std::string& path, const MeshOptions& options, const AnimationWish& animations = {});

}  // namespace burin
