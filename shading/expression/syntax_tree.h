#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "shading/expression/lexer.h"

namespace burin {

constexpr std::size_t kMostExpressionCharacters = 4096;
constexpr int kMostExpressionLevels = 64;

enum class SyntaxKind : std::uint8_t {
    number,
    color,
    text,
    name,
    call,       ///< words: the function
    unary,      ///< words: "-" or "not"
    binary,     ///< words: the operator
    in,         ///< words: a group
    choose,     ///< condition, value, other value
    component,  ///< words: one of x y z r g b
};

/// A part of an expression. Its operands stand before it, in the order of the text.
struct SyntaxNode {
    SyntaxKind kind;
    Token token;               ///< where messages point to, and its value
    std::size_t first;         ///< of its operands in SyntaxTree::operands
    std::size_t operands = 0;  ///< how many
    std::size_t begin;         ///< of its text
};

struct SyntaxTree {
    std::vector<SyntaxNode> nodes;  ///< the last one is the whole expression
    std::vector<std::uint32_t> operands;
};

/// Reads an expression by its grammar (docs/shading/expressions.md). The tree points into the text. Throws
/// ExpressionError.
SyntaxTree parse_expression(std::string_view text);

}  // namespace burin
