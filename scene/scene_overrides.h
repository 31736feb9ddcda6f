#pragma once

#include "scene/scene_description.h"
#include "scene/toml_reader.h"

namespace burin {

/// Puts an override's value in its place, making tables on the way as needed. A number in the key
/// counts into an array: object.0.subdivide.
void apply_override(toml::table& root, const Override& o);

}  // namespace burin
