#pragma once

#include <string>
#include <string_view>

// The JSON and the binary chunk of a .gltf or .glb are found and checked.

namespace burin {

/// What a glTF file holds: the two chunks of a GLB (glTF 2.0, 4.4), or the text of a .gltf. They lie in
/// the file's own bytes.
struct GltfContainer {
    std::string_view json;
    std::string_view binary;
};

/// `path` is for messages. Throws InputError when it is cut off or no glTF 2.0.
GltfContainer split_gltf_container(const std::string& path, std::string_view bytes);

}  // namespace burin
