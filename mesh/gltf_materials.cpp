#include "mesh/gltf_materials.h"

#include <algorithm>

namespace burin {

GltfMaterials read_gltf_materials(const JsonPlace& root) {
    GltfMaterials result;
    for (std::size_t i = 0; i < root.size_of("materials"); ++i) {
        const JsonPlace place = root.at("materials").element(i);
        Material material;
        material.name = place.text_or("name", "material" + std::to_string(i));
        material.color = glm::vec3(1.0f);
        double alpha = 1;
        if (place.has("pbrMetallicRoughness") && place.at("pbrMetallicRoughness").has("baseColorFactor")) {
            const JsonPlace color = place.at("pbrMetallicRoughness").at("baseColorFactor");
            for (int c = 0; c < 3; ++c) {
                const double value = color.element(static_cast<std::size_t>(c)).number();
                material.color[c] = static_cast<float>(std::clamp(value, 0.0, 1.0));
            }
            if (color.size() > 3) alpha = std::clamp(color.element(3).number(), 0.0, 1.0);
        }
        const std::string mode = place.text_or("alphaMode", "OPAQUE");
        if (mode == "BLEND") material.opacity = static_cast<float>(alpha);
        const double cutoff = place.number_or("alphaCutoff", 0.5);
        if (cutoff < 0) place.at("alphaCutoff").fail("must be 0 or more");
        result.is_cut_out.push_back(mode == "MASK" && alpha < cutoff);
        result.materials.push_back(material);
    }
    result.materials.push_back(Material{.name = "default"});
    result.is_cut_out.push_back(false);
    return result;
}

}  // namespace burin
