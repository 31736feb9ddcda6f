#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "base/suggestion.h"
#include "shading/expression/builder.h"
#include "shading/expression/error.h"
#include "shading/expression/function_table.h"
#include "shading/expression/glob.h"
#include "shading/expression/unknown_word.h"

// What names in an expression stand for: variables, parameters, lets, ramps; names of classes and objects; groups.

namespace burin {
namespace {

using O = ExpressionOperation;

template <typename Things>
auto* find_named(Things& things, std::string_view name) {
    const auto place =
        std::find_if(things.begin(), things.end(), [&](const auto& thing) { return thing.name == name; });
    return place == things.end() ? nullptr : &*place;
}

}  // namespace

std::uint32_t ExpressionBuilder::input_number(const ExpressionInput& input) {
    const auto place = std::find(inputs_.begin(), inputs_.end(), input);
    if (place != inputs_.end()) return static_cast<std::uint32_t>(place - inputs_.begin());
    inputs_.push_back(input);
    return static_cast<std::uint32_t>(inputs_.size() - 1);
}

void ExpressionBuilder::require_rate(ValueRate rate, std::string_view name, std::size_t offset) const {
    if (rate <= highest_) return;
    const std::string shown = in_quotes(name);
    switch (highest_) {
        case ValueRate::sample:
            return;
        case ValueRate::piece:
            fail(offset, shown + " changes along a line; use it in width or opacity");
        case ValueRate::chain:
            fail(offset, shown + " changes along a line; here a value is needed that is the same for a whole line");
        case ValueRate::frame:
            fail(offset, shown + " changes from line to line; here a value is needed that is the same for all");
    }
}

TypedValue ExpressionBuilder::variable(std::string_view name, std::size_t begin) {
    const ExpressionVariable* const found = find_named(symbols_.variables, name);
    if (found == nullptr) fail(begin, "the variable " + in_quotes(name) + " that this needs is not known here");
    require_rate(found->rate, name, begin);
    TypedValue result;
    result.type = found->type;
    result.rate = found->rate;
    result.names = found->names.get();
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t component = found->type == ValueType::number ? 0 : k;
        result.parts[k] = graph_.input(input_number({found->name, component, false}));
    }
    return result;
}

TypedValue ExpressionBuilder::attribute(std::string_view name, std::size_t begin) {
    if (name.empty()) fail(begin, "the name of a vertex attribute is missing");
    require_rate(ValueRate::sample, "attr", begin);
    TypedValue result;
    result.rate = ValueRate::sample;
    result.parts.fill(graph_.input(input_number({std::string(name), 0, true})));
    return result;
}

TypedValue ExpressionBuilder::name(const Token& token) {
    count_steps((symbols_.parameters.size() + symbols_.lets.size()) / 8);  // which are looked through
    if (find_named(symbols_.variables, token.words) != nullptr) return variable(token.words, token.offset);
    if (const ExpressionParameter* const p = find_named(symbols_.parameters, token.words)) {
        if (p->type == ValueType::number) return constant(p->value[0]);
        TypedValue value = color(p->value);
        value.type = p->type;
        return value;
    }
    if (const ExpressionLet* const l = find_named(symbols_.lets, token.words)) return let(*l, token);
    fail_unknown_name(token);
}

TypedValue ExpressionBuilder::let(const ExpressionLet& let, const Token& token) {
    BuiltLet& built = lets_[let.name];
    if (built.progress == Progress::going_on) fail(token.offset, in_quotes(let.name) + " is made of itself");
    if (built.progress == Progress::not_begun) {
        constexpr std::size_t kMostLevels = 64;
        if (let_levels_ == kMostLevels) fail(token.offset, "more than 64 lets are made of each other");
        built.progress = Progress::going_on;
        ++let_levels_;
        const auto outer = std::tuple(text_, highest_, tree_);
        std::optional<ExpressionError> fault;
        try {
            built.value = build(let.text, ValueRate::sample);
        } catch (const ExpressionError& error) {
            fault = error;
        }
        std::tie(text_, highest_, tree_) = outer;
        --let_levels_;
        built.progress = fault ? Progress::not_begun : Progress::done;
        if (fault)
            fail(token.offset,
                 "in " + in_quotes(let.name) + ", column " + std::to_string(fault->column()) + ": " + fault->what());
    }
    require_rate(built.value.rate, let.name, token.offset);
    return built.value;
}

std::string ExpressionBuilder::compared_with_name(const Token& token) const {
    const std::vector<SyntaxNode>& nodes = tree_->nodes;
    for (const SyntaxNode& comparison : nodes) {
        const bool is_equality = comparison.token.words == "==" || comparison.token.words == "!=";
        if (comparison.kind != SyntaxKind::binary || !is_equality) continue;
        for (std::size_t k = 0; k < 2; ++k) {
            const SyntaxNode& operand = nodes[tree_->operands[comparison.first + k]];
            const SyntaxNode& other = nodes[tree_->operands[comparison.first + 1 - k]];
            if (operand.kind != SyntaxKind::name || operand.token.offset != token.offset) continue;
            if (other.kind != SyntaxKind::name) return {};
            const ExpressionVariable* const variable = find_named(symbols_.variables, other.token.words);
            if (variable == nullptr || variable->names == nullptr) return {};
            // A word that is nearly such a variable is probably one.
            for (const ExpressionVariable& v : symbols_.variables) {
                if (v.names != nullptr && edit_distance(v.name, token.words) == 1) return {};
            }
            return variable->name + " " + std::string(comparison.token.words) + " \"" + std::string(token.words) + "\"";
        }
    }
    return {};
}

void ExpressionBuilder::fail_unknown_name(const Token& token) const {
    const std::string shown = in_quotes(token.words);
    if (const ExpressionFunction* const function = find_function(token.words))
        fail(token.offset, shown + " is a function: write " + signature(*function));
    if (is_word_of(symbols_.later, token.words)) fail(token.offset, shown + " is not in this version");
    if (find_named(symbols_.ramps, token.words) != nullptr)
        fail(token.offset, shown + " is a ramp: write ramp(\"" + std::string(token.words) + "\", x)");
    if (find_named(symbols_.groups, token.words) != nullptr)
        fail(token.offset, shown + " is a group: write object in " + std::string(token.words));
    if (token.words == "true") fail(token.offset, "'true' is written 1");
    if (token.words == "false") fail(token.offset, "'false' is written 0");
    for (const std::string_view unit : {"px", "mm", "pt", "world"}) {
        if (token.words == unit) fail(token.offset, "a unit stands right behind a number, as 2" + std::string(unit));
    }
    const std::string comparison = compared_with_name(token);
    fail(token.offset, "unknown variable " + shown +
                           (comparison.empty() ? suggestion_of(token.words, all_names(symbols_))
                                               : "; names stand in double quotes: " + comparison) +
                           symbols_.hint_for_unknown);
}

void ExpressionBuilder::fail_unknown_function(const Token& token) const {
    const std::string shown = in_quotes(token.words);
    if (const std::string_view hint = hint_for_function(token.words); !hint.empty())
        fail(token.offset, std::string(hint));
    if (is_word_of(symbols_.later, token.words)) fail(token.offset, shown + " is not in this version");
    if (is_word_of(all_names(symbols_), token.words))
        fail(token.offset, shown + " is not a function: an operator is missing before '('");
    std::vector<std::string> known;
    for (const ExpressionFunction& function : expression_functions()) known.emplace_back(function.name);
    fail(token.offset, "unknown function " + shown + suggestion_of(token.words, known));
}

TypedValue ExpressionBuilder::ramp_named(const TypedValue& name, const TypedValue& x) {
    if (const ExpressionRamp* const found = find_named(symbols_.ramps, name.text)) return ramp(found->ramp, x);
    std::vector<std::string> known;
    for (const ExpressionRamp& candidate : symbols_.ramps) known.push_back(candidate.name);
    fail(name.begin, "unknown ramp " + in_quotes(name.text) + suggestion_of(name.text, known));
}

template <typename IsIn>
TypedValue ExpressionBuilder::one_of(const TypedValue& value, std::size_t comparisons, const IsIn& is_in) {
    const NameList& list = *value.names;
    count_steps(list.names.size() * comparisons / 128);  // scenes may have very many objects
    std::vector<float> table{0};
    for (std::size_t i = 0; i < list.names.size(); ++i) {
        if (!is_in(list.names[i])) {
            if (table.size() > 1) table.push_back(0);
            continue;
        }
        if (table.size() == 1) table[0] = static_cast<float>(list.first_number + i);
        table.push_back(1);
    }
    while (table.size() > 1 && table.back() == 0.0f) table.pop_back();
    if (table.size() == 1) return constant(0);
    if (table.size() == 2) return compute(O::equal, {value, constant(table[0])});
    TypedValue result;
    result.parts.fill(graph_.look_up(O::member, value.parts[0], std::move(table)));
    result.rate = value.rate;
    return result;
}

TypedValue ExpressionBuilder::is_name(const TypedValue& value, const TypedValue& pattern) {
    if (!pattern.is_text) fail(pattern.begin, "a text is needed here, as \"wheel*\"");
    if (value.names == nullptr)
        fail(pattern.begin, "a text can only be compared with a name, as in class == \"crease\"");
    const NameList& list = *value.names;
    const bool has_wildcard = pattern.text.find_first_of("*?") != std::string_view::npos;
    if (list.is_complete && !has_wildcard && !is_word_of(list.names, pattern.text)) {
        if (is_word_of(symbols_.later, pattern.text))
            fail(pattern.begin, in_quotes(pattern.text) + " is not in this version");
        fail(pattern.begin,
             "unknown " + list.kind + " " + in_quotes(pattern.text) + suggestion_of(pattern.text, list.names));
    }
    bool fits_any = list.is_complete;
    const TypedValue result = one_of(value, 1, [&](const std::string& name) {
        const bool fits = matches_glob(pattern.text, name);
        fits_any = fits_any || fits;
        return fits;
    });
    if (!fits_any) remarks_.add({list.kind, std::string(pattern.text)});
    return result;
}

TypedValue ExpressionBuilder::membership(const Token& group, const TypedValue& value) {
    if (value.is_text || value.names == nullptr)
        fail(value.begin, "only a name can be in a group, as in: object in " + std::string(in_quotes(group.words)));
    const ExpressionGroup* other_kind = nullptr;
    for (const ExpressionGroup& candidate : symbols_.groups) {
        if (candidate.name != group.words) continue;
        if (candidate.kind != value.names->kind) {
            other_kind = &candidate;
            continue;
        }
        count_steps(candidate.patterns.size() / 128);
        const GlobList globs(candidate.patterns);
        return one_of(value, globs.comparisons(), [&](const std::string& name) { return globs.takes(name); });
    }
    if (other_kind != nullptr)
        fail(group.offset, "the group " + in_quotes(group.words) + " is one of kind '" + other_kind->kind + "', not '" +
                               value.names->kind + "'");
    std::vector<std::string> known;
    for (const ExpressionGroup& candidate : symbols_.groups) known.push_back(candidate.name);
    fail(group.offset, "unknown group " + in_quotes(group.words) + suggestion_of(group.words, known));
}

}  // namespace burin
