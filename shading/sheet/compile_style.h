#pragma once

#include "shading/sheet/compiled_sheet.h"
#include "shading/sheet/style_sheet.h"

namespace burin {

/// Compiles a style. `steps_left`: of all expressions of the sheet; becomes less. Throws as CompiledSheet.
CompiledStyle compile_style(const SheetStyle& style, const ExpressionSymbols& symbols, const SheetContext& context,
                            std::size_t& steps_left);

/// The variables that programs read.
VariableSet variables_of(const ExpressionProgram& program);

}  // namespace burin
