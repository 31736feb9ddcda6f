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

bool is_wanted(const std::string& name, const JsonPlace& of_primitive, const AttributeWish& attributes,
               const GltfBuffers& buffers) {
    if (!is_wanted_attribute(name, attributes) || !of_primitive.has(name.c_str())) return false;
    return !name.starts_with('_') || buffers.type_of(of_primitive.at(name.c_str())) == "SCALAR";
}

std::string type_of(const std::string& name, const JsonPlace& reference, const GltfBuffers& buffers) {
    if (is_needed(name)) return name == "POSITION" ? "VEC3" : "VEC4";
    return buffers.type_of(reference);
}

}  // namespace

DracoGeometry decode_draco(const GltfPrimitive& primitive, GltfBuffers& buffers, const AttributeWish& attributes) {
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
        if (!is_needed(name) && !is_wanted(name, primitive.place.at("attributes"), attributes, buffers)) continue;
        const JsonPlace reference = primitive.place.at("attributes").at(name.c_str());
        GltfAccessor accessor =
            buffers.without_sparse(reference, type_of(name, reference, buffers), primitive.vertices);
        if (accessor.count != primitive.vertices) {
            reference.fail("the accessors of a primitive must have as many elements each");
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
