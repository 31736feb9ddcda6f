#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/sheet_values.h"
#include "scene/toml_reader.h"
#include "shading/sheet/style_sheet.h"

// Line sets of a sheet are read here.

namespace burin {

/// The sets of a sheet, in their order. Throws as SheetValueReader.
std::vector<LineSet> read_sets(TomlReader& root, const std::vector<SheetStyle>& styles, SheetValueReader& values);

/// A list of patterns of names, if the table has one.
std::optional<std::vector<std::string>> read_globs(TomlReader& table, std::string_view key);

}  // namespace burin
