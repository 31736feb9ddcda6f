#pragma once

#include <string>

#include "mesh/gltf_json.h"

namespace burin {

/// Throws InputError if the file requires an extension that may change the shape and that is not read. Extensions about
/// looks, sound, metadata and behaviour may be ignored.
void check_gltf_extensions(const std::string& path, const JsonPlace& root);

}  // namespace burin
