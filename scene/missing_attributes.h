#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace burin {

/// Who asks for the values that files give at vertices.
struct AttributeReaders {
    AttributeWish sheet, surfaces;
};

/// What is asked for and objects have not: a note for each, with their names. `known`: the names that the models'
/// files have.
std::vector<std::string> notes_on_missing_attributes(const Scene& scene, const AttributeReaders& readers,
                                                     const std::vector<std::string>& known);

}  // namespace burin
