#pragma once

#include <string>

#include "shading/ink/found_lines.h"
#include "shading/sheet/compiled_sheet.h"

namespace burin {

/// What must be known of lines so that a sheet can draw them.
FoundLinesNeeds found_needs_of(const SheetNeeds& sheet);

/// What a sheet needs and lines lack, since others were looked for when they were found: "lines of class mark,
/// normals"; empty: nothing. `needs`: of the sheet.
std::string missing_for(const StyleSheet& sheet, const SheetNeeds& needs, const FoundLines& lines);

/// Whether lines found for all sheets, as `lines` were but for that, would lack nothing.
bool find_all_keeps(const StyleSheet& sheet, const SheetNeeds& needs, const FoundLines& lines);

}  // namespace burin
