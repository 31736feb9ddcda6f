#include "mesh/gltf_container.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "base/error.h"

namespace burin {
namespace {

static_assert(std::endian::native == std::endian::little, "GLB numbers are little-endian");

constexpr std::uint32_t kGlbMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kGlbJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kGlbBinaryChunk = 0x004E4942;

std::uint32_t load_u32(const char* p) {
    std::uint32_t value;
    std::memcpy(&value, p, sizeof value);
    return value;
}

}  // namespace

GltfContainer split_gltf_container(const std::string& path, std::string_view bytes) {
    if (bytes.size() < 4 || load_u32(bytes.data()) != kGlbMagic) return {bytes, {}};
    if (bytes.size() < 12 || load_u32(bytes.data() + 4) != 2) {
        throw InputError(path + ": only GLB version 2 is read; re-export the model as glTF 2.0");
    }
    const std::uint32_t size = load_u32(bytes.data() + 8);
    if (size > bytes.size()) {
        throw InputError(path + ": the file is shorter than its header says; " + "was it written completely?");
    }
    bytes = bytes.substr(0, std::max<std::size_t>(size, 12));
    GltfContainer container;
    std::size_t at = 12;
    while (bytes.size() - at >= 8) {
        const std::uint32_t length = load_u32(bytes.data() + at);
        const std::uint32_t type = load_u32(bytes.data() + at + 4);
        at += 8;
        if (length > bytes.size() - at) {
            throw InputError(path + ": a chunk is longer than the file; was it written completely?");
        }
        const std::string_view chunk = bytes.substr(at, length);
        if (type == kGlbJsonChunk && container.json.empty()) container.json = chunk;
        if (type == kGlbBinaryChunk && container.binary.empty()) container.binary = chunk;
        at += length;
    }
    if (container.json.empty()) throw InputError(path + ": the GLB has no JSON chunk; re-export it");
    return container;
}

}  // namespace burin
