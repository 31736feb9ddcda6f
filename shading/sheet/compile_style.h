#pragma once

#include "shading/sheet/compiled_sheet.h"
#include "shading/sheet/style_sheet.h"

namespace burin {

/// Compiles a style. Throws as CompiledSheet.
CompiledStyle compile_style(const SheetStyle& style, const ExpressionSymbols& symbols, const SheetContext& context);

/// The variables that programs read.
VariableSet variables_of(const ExpressionProgram& program);

}  // namespace burin
