#pragma once

#include <optional>
#include <string>

#include "shading/expression/symbols.h"
#include "shading/sheet/compiled_sheet.h"
#include "shading/sheet/style_sheet.h"

// Names that the expressions of a sheet may use.

namespace burin {

/// Variables, without the names of a scene's objects and materials.
ExpressionSymbols sheet_variables();

/// All names: of variables, whose values of the rate `frame` are known, of the sheet and of the scene. Throws as
/// SheetText::fail().
ExpressionSymbols symbols_of(const StyleSheet& sheet, const SheetContext& context);

/// A number with a unit, in pixels. The unit must not be `world`.
double in_pixels(double number, SheetUnit unit, const SheetContext& context);

/// "mm", "%"; empty: pixels.
const char* suffix_of(SheetUnit unit);

/// Why a parameter cannot have its value: it is out of its range. `context`: says how large units are; without it, a
/// value that has another unit than the range is not compared.
std::optional<std::string> fault_of_parameter(const SheetParameter& parameter, const SheetContext* context = nullptr);

/// A number as an expression has it; read as single precision, it is the nearest one.
std::string text_of(double number);

}  // namespace burin
