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
constexpr int kMaxJsonDepth = 256;

std::uint32_t load_u32(const char* p) {
    std::uint32_t value;
    std::memcpy(&value, p, sizeof value);
    return value;
}

/// How deep lists and objects stand in each other.
int nesting_depth(std::string_view text) {
    int depth = 0, deepest = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') ++i;
            in_string = c != '"';
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            deepest = std::max(deepest, ++depth);
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return deepest;
}

}  // namespace

GltfContainer split_gltf_container(const std::string& path, std::string_view bytes) {
    if (bytes.size() < 4 || load_u32(bytes.data()) != kGlbMagic) return {bytes, {}};
    if (bytes.size() < 12 || load_u32(bytes.data() + 4) != 2) {
        throw InputError(path + ": only GLB version 2 is read; re-export the model as glTF 2.0");
    }
    const std::uint32_t size = load_u32(bytes.data() + 8);
    if (size > bytes.size()) {
        throw InputError(path + ": the file is shorter than its header says; " +
                         "was it written completely?");
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

nlohmann::json parse_gltf_json(const std::string& path, std::string_view text) {
    // Not by the parser's callback, which takes time in the square of a list's length.
    if (nesting_depth(text) > kMaxJsonDepth) throw InputError(path + ": the JSON is nested too deeply");
    try {
        return nlohmann::json::parse(text.begin(), text.end());
    } catch (const nlohmann::json::parse_error& error) {
        const std::size_t at = std::min<std::size_t>(error.byte, text.size());
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        throw InputError({path, static_cast<std::size_t>(line)},
                         "the JSON breaks off or is malformed at byte " + std::to_string(at) +
                             "; was the file written completely?");
    } catch (const nlohmann::json::exception&) {
        throw InputError(path + ": the JSON holds a number that no computer can hold; repair the file");
    }
}

}  // namespace burin
