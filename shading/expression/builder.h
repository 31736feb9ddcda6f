#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shading/expression/graph.h"
#include "shading/expression/program.h"
#include "shading/expression/remarks.h"
#include "shading/expression/symbols.h"
#include "shading/expression/syntax_tree.h"

namespace burin {

/// A part of an expression with its type.
struct TypedValue {
    ValueType type = ValueType::number;
    bool is_text = false;
    std::array<ExpressionGraph::Index, 3> parts{};  ///< a number: all three are the same
    ValueRate rate = ValueRate::frame;
    const NameList* names = nullptr;  ///< of what the number is one, if of anything
    std::string_view text;
    std::size_t begin = 0;  ///< in the expression
};

/// Checks expressions and puts what they compute into a graph.
class ExpressionBuilder {
  public:
    ExpressionBuilder(const ExpressionSymbols& symbols, ExpressionGraph& graph, std::vector<ExpressionInput>& inputs,
                      std::size_t most_steps)
        : symbols_(symbols), graph_(graph), inputs_(inputs), most_steps_(most_steps) {}

    /// What has been built stays valid. `highest`: no variable may have a higher rate. Throws ExpressionError.
    TypedValue build(std::string_view text, ValueRate highest);

    /// Looks at a result that is a colour: at itself if it is constant, or at those that are chosen from.
    void remark_bright(const TypedValue& color);
    const ExpressionRemarks& remarks() const { return remarks_; }

    // What functions are made of (function_table.cpp).
    using Operation = ExpressionOperation;
    TypedValue constant(float value);
    TypedValue color(const std::array<float, 3>& linear);
    /// Component by component, if one of the values has several.
    TypedValue compute(Operation operation, std::initializer_list<TypedValue> values);
    TypedValue component(const TypedValue& whole, std::size_t k) const;
    TypedValue triple(ValueType type, const TypedValue& x, const TypedValue& y, const TypedValue& z) const;
    TypedValue variable(std::string_view name, std::size_t begin);
    TypedValue attribute(std::string_view name, std::size_t begin);
    TypedValue ramp(const Ramp& ramp, const TypedValue& x);
    TypedValue ramp_named(const TypedValue& name, const TypedValue& x);
    /// Whether a value is the number of a name that a pattern takes.
    TypedValue is_name(const TypedValue& value, const TypedValue& pattern);
    bool is_constant(const TypedValue& value) const { return graph_.is_constant(value.parts[0]); }
    float constant_value(const TypedValue& value) const { return graph_.constant_value(value.parts[0]); }
    void require_number(const TypedValue& value, std::string_view what) const;
    void require_triple(const TypedValue& value, std::string_view what) const;
    [[noreturn]] void fail(std::size_t offset, const std::string& message) const;

  private:
    enum class Progress : std::uint8_t { not_begun, going_on, done };
    struct BuiltLet {
        Progress progress = Progress::not_begun;
        TypedValue value;
    };

    TypedValue node(const SyntaxNode& of, std::span<const TypedValue> operands);
    TypedValue number(const Token& token);
    TypedValue name(const Token& token);
    TypedValue let(const ExpressionLet& let, const Token& token);
    TypedValue call(const SyntaxNode& node, std::span<const TypedValue> arguments);
    TypedValue binary(const Token& sign, const TypedValue& a, const TypedValue& b);
    TypedValue comparison(const Token& sign, const TypedValue& a, const TypedValue& b);
    TypedValue membership(const Token& group, const TypedValue& value);
    template <typename IsIn>
    TypedValue one_of(const TypedValue& value, std::size_t comparisons, const IsIn& is_in);
    void require_rate(ValueRate rate, std::string_view name, std::size_t offset) const;
    /// The comparison that an unknown word is probably a name in: `object == "box"`; nothing elsewhere.
    std::string compared_with_name(const Token& token) const;
    [[noreturn]] void fail_unknown_name(const Token& token) const;
    [[noreturn]] void fail_unknown_function(const Token& token) const;
    std::uint32_t input_number(const ExpressionInput& input);
    void count_steps(std::size_t steps);

    const ExpressionSymbols& symbols_;
    ExpressionGraph& graph_;
    std::vector<ExpressionInput>& inputs_;
    std::size_t most_steps_;
    std::map<std::string, BuiltLet, std::less<>> lets_;
    std::size_t let_levels_ = 0;
    std::string_view text_;  ///< that is being built
    ValueRate highest_ = ValueRate::sample;
    const SyntaxTree* tree_ = nullptr;  ///< of that text
    ExpressionRemarks remarks_;
    /// A stop of a ramp of colours with a component above 1, and what the ramp gives.
    struct BrightStop {
        std::array<ExpressionGraph::Index, 3> ramp;
        std::array<float, 3> value;
    };
    std::vector<BrightStop> bright_stops_;
    static bool is_bright(const std::array<float, 3>& color);
};

}  // namespace burin
