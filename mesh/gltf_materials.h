#pragma once

#include <vector>

#include "mesh/gltf_json.h"
#include "mesh/polygon_soup.h"

// Colours and opacities of a glTF file become materials of the model.

namespace burin {

/// The materials of a glTF file, and then the default material.
struct GltfMaterials {
    std::vector<Material> materials;
    /// Per material, whether nothing with it can be seen: its alpha lies below its alphaCutoff.
    std::vector<bool> is_cut_out;
};

/// `root` is the whole JSON. Textures are not looked at: they can only lower an alpha.
GltfMaterials read_gltf_materials(const JsonPlace& root);

}  // namespace burin
