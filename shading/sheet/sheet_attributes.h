#pragma once

#include <string_view>

#include "mesh/vertex_attributes.h"
#include "shading/sheet/style_sheet.h"

namespace burin {

/// What the texts of a sheet name of the values that files give at vertices: what must be kept of models for it. Names
/// count wherever they stand, also in sets and styles that are not used.
AttributeWish attributes_named_in(const StyleSheet& sheet);

/// The same of one expression, added to what is there. A text that is none adds what stands before its fault.
void add_attributes_named_in(std::string_view expression, AttributeWish& wish);
/// The same of a value; constants name nothing.
void add_attributes_named_in(const StyleValue& value, AttributeWish& wish);

}  // namespace burin
