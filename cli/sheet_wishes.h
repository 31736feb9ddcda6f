#pragma once

#include <memory>

#include "cli/arguments.h"
#include "shading/sheet/compiled_sheet.h"
#include "shading/sheet/style_sheet.h"

namespace burin {

/// A sheet as the command line wants it: -w and --color are values of its parameters, --hidden none takes hidden lines
/// away. Throws UsageError for what cannot stand beside a sheet, and for parameters that the sheet has not, or whose
/// range excludes the value. `context`: says how large units are.
std::shared_ptr<const StyleSheet> sheet_as_wished(StyleSheet sheet, const Arguments& arguments,
                                                  const SheetContext& context);

/// Leaves visible lines only.
void take_hidden_lines_away(StyleSheet& sheet);

}  // namespace burin
