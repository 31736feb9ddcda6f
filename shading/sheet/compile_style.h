#pragma once

#include <memory>

#include "shading/sheet/compiled_sheet.h"
#include "shading/sheet/style_sheet.h"

namespace burin {

/// Compiles a style. `steps_left`: of all expressions of the sheet; becomes less. Throws as CompiledSheet.
CompiledStyle compile_style(const SheetStyle& style, const ExpressionSymbols& symbols, const SheetContext& context,
                            std::size_t& steps_left);

/// The shader and the test of a name that stands in a sheet. Throws as CompiledSheet where there is none.
std::shared_ptr<const LineShader> shader_named(const SheetText& name, const LineShaders* known);
std::shared_ptr<const LineTest> test_named(const SheetText& name, const LineShaders* known);

/// The variables that programs read.
VariableSet variables_of(const ExpressionProgram& program);

}  // namespace burin
