#pragma once

#include <cstdint>

#include "scene/toml_reader.h"

namespace burin {

/// A hash of what a scene's tables say of all frames. What says where things are in one frame (cameras, the transforms
/// and keys of objects, the list of frames) is not in it: who wants to know that asks the frame.
std::uint64_t hash_of_scene_tables(const toml::table& tables);

}  // namespace burin
