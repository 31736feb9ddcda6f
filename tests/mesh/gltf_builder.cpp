#include "tests/mesh/gltf_builder.h"

#include <cstdint>

#include "tests/mesh/model_files.h"

namespace burin::test {

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = i; k < i + 3; ++k) {
            bits = bits << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
        }
    }
    return text;
}

std::string data_uri(std::string_view bytes) { return "data:application/octet-stream;base64," + base64(bytes); }

std::string glb(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const std::size_t binary_chunk = binary.empty() ? 0 : 8 + binary.size();
    ByteWriter head;
    head.add<std::uint32_t>({0x46546C67, 2, static_cast<std::uint32_t>(20 + json.size() + binary_chunk),
                             static_cast<std::uint32_t>(json.size()), 0x4E4F534A});
    std::string bytes = head.bytes() + json;
    if (binary.empty()) return bytes;
    ByteWriter chunk;
    chunk.add<std::uint32_t>({static_cast<std::uint32_t>(binary.size()), 0x004E4942});
    return bytes + chunk.bytes() + binary;
}

std::string square_positions() { return ByteWriter().add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}).bytes(); }

std::string square_indices() { return ByteWriter().add<std::uint16_t>({0, 1, 2, 0, 2, 3}).bytes(); }

std::string GltfParts::json() const {
    std::string text = "{\n";
    const auto add = [&](const char* key, const std::string& value) {
        if (value.empty()) return;
        if (text.size() > 2) text += ",\n";
        text += "\"" + std::string(key) + "\": " + value;
    };
    add("asset", asset);
    add("extensionsRequired", required);
    add("scene", scene);
    add("scenes", scenes);
    add("nodes", nodes);
    add("cameras", cameras);
    add("skins", skins);
    add("animations", animations);
    add("meshes", meshes);
    add("materials", materials);
    add("accessors", accessors);
    add("bufferViews", buffer_views);
    add("buffers", !buffers.empty() ? buffers
                                    : "[{\"byteLength\": " + std::to_string(binary.size()) + ", \"uri\": \"" +
                                          data_uri(binary) + "\"}]");
    return text + "\n}\n";
}

std::string GltfParts::as_glb() const {
    GltfParts parts = *this;
    if (parts.buffers.empty()) {
        parts.buffers = "[{\"byteLength\": " + std::to_string(binary.size()) + "}]";
    }
    return glb(parts.json(), binary);
}

int GltfAccessors::add_view(const std::string& bytes) {
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    views_ += std::string(views_.empty() ? "" : ", ") +
              "{\"buffer\": 0, \"byteOffset\": " + std::to_string(binary_.size()) +
              ", \"byteLength\": " + std::to_string(bytes.size()) + "}";
    binary_ += bytes;
    return view_count_++;
}

int GltfAccessors::add_object(const std::string& object) {
    accessors_ += (accessors_.empty() ? "" : ", ") + object;
    return accessor_count_++;
}

int GltfAccessors::add(const std::string& bytes, const char* type, int component_type, std::size_t count,
                       const std::string& more) {
    const int view = add_view(bytes);
    return add_object("{\"bufferView\": " + std::to_string(view) + ", \"type\": \"" + type +
                      "\", \"componentType\": " + std::to_string(component_type) +
                      ", \"count\": " + std::to_string(count) + (more.empty() ? "" : ", ") + more + "}");
}

int GltfAccessors::add_positions(std::initializer_list<float> numbers) {
    return add(ByteWriter().add<float>(numbers).bytes(), "VEC3", 5126, numbers.size() / 3);
}

int GltfAccessors::add_indices(std::initializer_list<std::uint16_t> numbers) {
    return add(ByteWriter().add<std::uint16_t>(numbers).bytes(), "SCALAR", 5123, numbers.size());
}

void GltfAccessors::put_into(GltfParts& parts) const {
    parts.binary = binary_;
    parts.buffer_views = "[" + views_ + "]";
    parts.accessors = "[" + accessors_ + "]";
}

GltfParts gltf_of(const GltfAccessors& accessors, const std::string& primitives) {
    GltfParts parts;
    accessors.put_into(parts);
    parts.meshes = "[{\"primitives\": [" + primitives + "]}]";
    parts.nodes = R"([{"mesh": 0}])";
    return parts;
}

}  // namespace burin::test
