#include "methods/explained_names.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "render/sheet_context.h"
#include "shading/expression.h"
#include "shading/expression/lexer.h"
#include "shading/sheet/sheet_symbols.h"

namespace burin {
namespace {

/// The names in a text that are not those of components, such as `.r`.
std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> words;
    Lexer lexer(text);
    bool is_component = false;
    for (Token token = lexer.next(); token.kind != TokenKind::end; token = lexer.next()) {
        if (token.kind == TokenKind::name && !is_component) words.emplace_back(token.words);
        is_component = token.is(".");
    }
    return words;
}

/// NameValues computes what names stand for at one place.
class NameValues {
  public:
    NameValues(const Frame& frame, const LineColumns& lines, const LineSample& sample, const SampleVariant& variant)
        : symbols_(symbols_of(*frame.scene->sheet, sheet_context_of(frame))),
          lines_(lines),
          sample_(sample),
          variant_(variant) {}

    std::optional<ExplainedName> value(const std::string& name) const {
        try {
            ExpressionGraph graph;
            std::vector<ExpressionInput> inputs;
            ExpressionBuilder builder(symbols_, graph, inputs, std::numeric_limits<std::size_t>::max());
            const TypedValue built = builder.build(name, ValueRate::sample);
            const std::size_t components = built.type == ValueType::number ? 1 : 3;
            const ExpressionProgram program(graph, inputs, {{built.parts, components, built.rate}});
            return ExplainedName{name, built.type, evaluated(program)};
        } catch (const ExpressionError&) {
            return std::nullopt;
        }
    }

  private:
    std::array<float, 3> evaluated(const ExpressionProgram& program) const {
        VariableSet variables;
        std::vector<std::string> attributes;
        for (const ExpressionInput& input : program.inputs()) {
            if (input.is_attribute) {
                attributes.push_back(input.name);
            } else {
                variables.add(*variable_named(input.name), input.component);
            }
        }
        SampleColumns columns;
        lines_.fill({&sample_, 1}, variables, variant_, columns, attributes);
        std::vector<const float*> inputs;
        std::size_t attribute = 0;
        for (const ExpressionInput& input : program.inputs())
            inputs.push_back(input.is_attribute ? columns.of_attribute(attribute++)
                                                : columns.of(*variable_named(input.name), input.component));
        std::array<float, 3> values{};
        const std::array<float*, 3> places{values.data(), values.data() + 1, values.data() + 2};
        std::vector<NotNumbers> not_numbers(program.outputs().size());
        program.evaluate(inputs, 1, places, not_numbers);
        return values;
    }

    const ExpressionSymbols symbols_;
    const LineColumns& lines_;
    const LineSample sample_;
    const SampleVariant& variant_;
};

}  // namespace

std::vector<ExplainedName> names_in(std::span<const StyleValue* const> values, const Frame& frame,
                                    const LineColumns& lines, const LineSample& sample, const SampleVariant& variant) {
    const StyleSheet& sheet = *frame.scene->sheet;
    if (sheet.parameters.empty() && sheet.lets.empty()) return {};
    const NameValues known(frame, lines, sample, variant);
    const auto is_of_sheet = [&](const std::string& name) {
        const auto is_it = [&](const auto& named) { return named.name == name; };
        return std::any_of(sheet.parameters.begin(), sheet.parameters.end(), is_it) ||
               std::any_of(sheet.lets.begin(), sheet.lets.end(), is_it);
    };
    std::vector<ExplainedName> names;
    for (const StyleValue* const value : values) {
        if (value->kind != StyleValue::Kind::expression && value->kind != StyleValue::Kind::ramp) continue;
        for (const std::string& word : words_of(value->source.text)) {
            const auto is_it = [&](const ExplainedName& named) { return named.name == word; };
            if (!is_of_sheet(word) || std::any_of(names.begin(), names.end(), is_it)) continue;
            if (const auto found = known.value(word)) names.push_back(*found);
        }
    }
    return names;
}

}  // namespace burin
