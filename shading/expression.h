#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "shading/expression/builder.h"
#include "shading/expression/error.h"
#include "shading/expression/program.h"
#include "shading/expression/symbols.h"

// The expressions of style sheets: a text and a table of names go in, a program comes out that computes the values of
// many samples (docs/shading/expressions.md).

namespace burin {

/// What an expression is for.
struct ExpressionTarget {
    bool is_color = false;  ///< else a number
    float least = -std::numeric_limits<float>::infinity();
    float most = std::numeric_limits<float>::infinity();
    ValueRate highest_rate = ValueRate::sample;  ///< of variables that it may use
};

/// Compiles several expressions, such as all those of a style, into one program; what they share is computed once.
class ExpressionCompiler {
  public:
    /// The table must stay as long as the compiler. `most_steps`: to be an error where it takes more.
    explicit ExpressionCompiler(const ExpressionSymbols& symbols,
                                std::size_t most_steps = std::numeric_limits<std::size_t>::max());
    ExpressionCompiler(const ExpressionCompiler&) = delete;
    ExpressionCompiler& operator=(const ExpressionCompiler&) = delete;

    /// Adds a result. Throws ExpressionError, after which the compiler is as before.
    void add(std::string_view text, const ExpressionTarget& target);
    /// Adds a ramp, which has no fault, over the value of an expression.
    void add_ramp(const Ramp& ramp, std::string_view over, const ExpressionTarget& target);
    /// The program that computes all results in the order in which they were added.
    ExpressionProgram program() const;
    const ExpressionRemarks& remarks() const { return builder_.remarks(); }
    /// How much work it has been; the time that it takes is about proportional to that.
    std::size_t steps() const { return graph_.steps(); }

  private:
    void add(const TypedValue& value, const ExpressionTarget& target);

    ExpressionGraph graph_;
    std::vector<ExpressionInput> inputs_;
    ExpressionBuilder builder_;
    std::vector<ExpressionOutput> outputs_;
};

ExpressionProgram compile_expression(std::string_view text, const ExpressionSymbols& symbols,
                                     const ExpressionTarget& target);

}  // namespace burin
