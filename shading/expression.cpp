#include "shading/expression.h"

namespace burin {

ExpressionCompiler::ExpressionCompiler(const ExpressionSymbols& symbols, std::size_t most_steps)
    : builder_(symbols, graph_, inputs_, most_steps) {}

void ExpressionCompiler::add(std::string_view text, const ExpressionTarget& target) {
    graph_.begin_expression();
    add(builder_.build(text, target.highest_rate), target);
}

void ExpressionCompiler::add_ramp(const Ramp& ramp, std::string_view over, const ExpressionTarget& target) {
    graph_.begin_expression();
    const TypedValue place = builder_.build(over, target.highest_rate);
    if (place.type != ValueType::number)
        throw ExpressionError(1, "a ramp goes over a number, not a colour or a vector");
    add(builder_.ramp(ramp, place), target);
}

void ExpressionCompiler::add(const TypedValue& value, const ExpressionTarget& target) {
    if (graph_.is_full()) throw ExpressionError(1, "the expression has more than 1024 operations: make it shorter");
    if (!target.is_color && value.type == ValueType::color)
        throw ExpressionError(
            1, "a number is needed here, but the expression is a colour: take .r, .g, .b or luminance()");
    if (!target.is_color && value.type == ValueType::vector)
        throw ExpressionError(1,
                              "a number is needed here, but the expression is a vector: take .x, .y, .z or length()");
    const ExpressionOutput output{value.parts, target.is_color ? 3u : 1u, value.rate, target.least, target.most};
    // A result by itself must not be too much; of several together parts may be computed again.
    graph_.count_steps(graph_.nodes().size() / 4);
    const ExpressionProgram alone(graph_, inputs_, {output});
    outputs_.push_back(output);
    if (target.is_color) builder_.remark_bright(value);
}

ExpressionProgram ExpressionCompiler::program() const { return {graph_, inputs_, outputs_}; }

ExpressionProgram compile_expression(std::string_view text, const ExpressionSymbols& symbols,
                                     const ExpressionTarget& target) {
    ExpressionCompiler compiler(symbols);
    compiler.add(text, target);
    return compiler.program();
}

}  // namespace burin
