#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/scene_description.h"

namespace burin {

/// Notes for values of --set that have no effect, because an option that says the same is stronger. `options`: the long
/// names of those that were given.
std::vector<std::string> notes_of_doubled_settings(const std::vector<std::string>& options,
                                                   std::span<const Override> overrides);

}  // namespace burin
