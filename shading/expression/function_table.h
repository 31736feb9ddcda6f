#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "shading/expression/builder.h"

namespace burin {

struct FunctionCall {
    std::size_t offset;  ///< of the function's name
    std::span<const TypedValue> arguments;
};

/// A function of expressions. docs/shading/expressions.md has a row for each.
struct ExpressionFunction {
    std::string_view name;
    std::string_view arguments;  ///< as the page shows them: "x, low, high"
    std::size_t least, most;     ///< how many
    std::size_t texts;           ///< how many of them, the first ones, are texts; the others are values
    TypedValue (*build)(ExpressionBuilder&, const FunctionCall&);
};

std::span<const ExpressionFunction> expression_functions();
/// nullptr if there is none.
const ExpressionFunction* find_function(std::string_view name);
/// "clamp(x, low, high)"
std::string signature(const ExpressionFunction& function);

}  // namespace burin
