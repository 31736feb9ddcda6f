#pragma once

#include <span>
#include <string>
#include <vector>

#include "shading/sheet/compiled_sheet.h"
#include "shading/sheet/style_sheet.h"

namespace burin {

/// What is right in a sheet, and yet probably a mistake in this scene (CompiledSheet::notes_on_names()).
std::vector<std::string> notes_on_sheet(const StyleSheet& sheet, std::span<const CompiledSet> sets,
                                        std::span<const CompiledStyle> styles, const SheetContext& context);

/// The same of remarks on expressions. `whose`: "style ink".
void add_notes_on(const std::string& whose, const ExpressionRemarks& remarks, const SheetContext& context,
                  std::vector<std::string>& notes);

}  // namespace burin
