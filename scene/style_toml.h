#pragma once

#include <vector>

#include "scene/sheet_values.h"
#include "scene/toml_reader.h"
#include "shading/sheet/style_sheet.h"

// Styles of a sheet are read here.

namespace burin {

/// The styles of the table [style], in the order of the file, each complete: with what it inherits. Throws as
/// SheetValueReader.
std::vector<SheetStyle> read_styles(TomlReader& styles, SheetValueReader& values);

}  // namespace burin
