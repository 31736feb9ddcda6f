#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene_description.h"
#include "shading/sheet/style_sheet.h"

namespace burin {

// So that no sheet takes long to read.
constexpr std::size_t kMaxSheetBytes = 1 << 21;
constexpr std::size_t kMaxSheetValues = 120000;  ///< in lists; a key, a table or a list counts as four

/// Reads a style sheet (docs/shading/sheets.md). `overrides`: those of --set whose keys begin with "style.": of a
/// parameter, of a style's key, or of any other value. Throws InputError with line and column, UsageError for an
/// override that does not fit. `name`: of the text, in messages.
StyleSheet read_sheet_text(std::string_view text, const std::string& name, const std::vector<Override>& overrides = {});
/// The same of a file.
StyleSheet read_sheet_file(const std::string& path, const std::vector<Override>& overrides = {});

/// Whether an override is one of a value of the sheet.
inline bool is_of_sheet(const Override& o) { return o.key.starts_with("style."); }

}  // namespace burin
