#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace burin {

/// What is asked for of the values that files give at vertices, and objects have not: a note for each, with their
/// names. `known`: the names that the models' files have.
std::vector<std::string> notes_on_missing_attributes(const Scene& scene, const AttributeWish& wish,
                                                     const std::vector<std::string>& known);

}  // namespace burin
