#include "mesh/gltf_extensions.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace burin {
namespace {

/// These are read.
constexpr std::array<std::string_view, 7> kRead = {
    "KHR_mesh_quantization",    "KHR_node_visibility",     "KHR_draco_mesh_compression",
    "EXT_mesh_gpu_instancing",  "EXT_meshopt_compression", "EXT_mesh_primitive_edge_visibility",
    "CESIUM_primitive_outline",
};

/// These do not change what is where while nothing moves.
constexpr std::array<std::string_view, 17> kHarmless = {
    "EXT_feature_metadata",
    "EXT_instance_features",
    "EXT_mesh_features",
    "EXT_mesh_manifold",
    "EXT_structural_metadata",
    "GODOT_single_root",
    "KHR_animation_pointer",
    "KHR_audio_emitter",
    "KHR_interactivity",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "MSFT_lod",
    "MSFT_packing_normalRoughnessMetallic",
    "MSFT_packing_occlusionRoughnessMetallic",
    "VRMC_vrm",
};

/// "KHR_materials_unlit" and the like, of any vendor: about looks.
bool is_about_looks(std::string_view name) {
    const std::size_t vendor = name.find('_');
    if (vendor == std::string_view::npos) return false;
    const std::string_view rest = name.substr(vendor + 1);
    return rest.starts_with("materials_") || rest.starts_with("texture_") || rest.starts_with("lights_");
}

bool may_be_required(std::string_view name) {
    return std::find(kRead.begin(), kRead.end(), name) != kRead.end() ||
           std::find(kHarmless.begin(), kHarmless.end(), name) != kHarmless.end() || is_about_looks(name);
}

}  // namespace

void check_gltf_extensions(const std::string& path, const JsonPlace& root) {
    for (std::size_t i = 0; i < root.size_of("extensionsRequired"); ++i) {
        const std::string name = root.at("extensionsRequired").element(i).text();
        if (may_be_required(name)) continue;
        throw InputError(path + ": needs the glTF extension " + printable(name, 80) +
                         ", which burin cannot read; re-export the model without it");
    }
}

}  // namespace burin
