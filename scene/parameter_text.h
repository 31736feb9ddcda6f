#pragma once

#include <string>

#include "shading/sheet/style_sheet.h"

namespace burin {

/// The value of a parameter of a style sheet as it is shown and typed: "1.6", "0.35mm", "#101010".
std::string text_of_parameter(const SheetParameter& parameter);

}  // namespace burin
