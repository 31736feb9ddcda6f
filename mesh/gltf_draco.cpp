#include "mesh/gltf_draco.h"

#include <memory>

#include "base/module.h"
#include "mesh/draco_module.h"

namespace burin {
namespace {

/// Whether it says where a vertex is.
bool is_needed(const std::string& name) {
    return name == "POSITION" || name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
}

}  // namespace

DracoGeometry decode_draco(const GltfPrimitive& primitive, GltfBuffers& buffers) {
    const JsonPlace place = primitive.place.extension(kDracoExtension);
    if (primitive.mode != 4) place.fail("only triangles (mode 4) are read from Draco's data");
    if (primitive.corners % 3 != 0) {
        primitive.place.at("indices").fail("triangles have three numbers each");
    }
    DracoGeometry geometry;
    geometry.indices.resize(primitive.corners);
    std::vector<BurinDracoAttribute> wanted;
    const JsonPlace ids = place.at("attributes");
    for (const auto& [name, id] : ids.json().items()) {
        if (!is_needed(name)) continue;
        GltfAccessor accessor = buffers.without_sparse(primitive.place.at("attributes").at(name.c_str()),
                                                       name == "POSITION" ? "VEC3" : "VEC4", primitive.vertices);
        if (accessor.count != primitive.vertices) {
            primitive.place.at("attributes")
                .at(name.c_str())
                .fail("the accessors of a primitive must have as many elements each");
        }
        auto room = std::make_shared<std::string>(accessor.count * accessor.element_size, '\0');
        wanted.push_back({ids.at(name.c_str()).index_below(0xFFFFFFFFu, "attribute"),
                          static_cast<unsigned>(accessor.components), static_cast<unsigned>(accessor.component_type),
                          room->data()});
        accessor.data = room->data();
        accessor.stride = accessor.element_size;
        accessor.owned = std::move(room);
        geometry.attributes.emplace(name, std::move(accessor));
    }
    const std::string_view bytes = buffers.view(place);
    static auto* const decode = reinterpret_cast<decltype(&burin_draco_decode)>(
        module_function("burin_draco.so", "burin_draco_decode", "reads glTF that Draco compressed",
                        "export the model without KHR_draco_mesh_compression"));
    const char* const failure = decode(bytes.data(), bytes.size(), primitive.vertices, primitive.corners / 3,
                                       geometry.indices.data(), wanted.data(), static_cast<unsigned>(wanted.size()));
    if (failure != nullptr) {
        place.fail("the compressed data are broken or not as the accessors say: " + std::string(failure));
    }
    return geometry;
}

}  // namespace burin
