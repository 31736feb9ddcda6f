#include "shading/sheet/sheet_symbols.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

#include "lines/line_class.h"

namespace burin {
namespace {

/// The value of a variable that is the same in the whole frame.
float frame_value(Variable v, const SheetContext& context) {
    switch (v) {
        case Variable::frame:
            return static_cast<float>(context.frame);
        case Variable::time:
            return static_cast<float>(context.frame / context.fps);
        case Variable::width_px:
            return static_cast<float>(context.width_px);
        case Variable::height_px:
            return static_cast<float>(context.height_px);
        default:
            return 0;
    }
}

ExpressionSymbols variables_of(const std::array<std::shared_ptr<const NameList>, 4>& names) {
    ExpressionSymbols symbols;
    for (const VariableRow& row : variable_table()) {
        symbols.variables.push_back(
            {std::string(row.name), row.type, row.rate, names[static_cast<std::size_t>(row.names)]});
    }
    for (const std::string_view word : names_of_later_versions()) symbols.later.emplace_back(word);
    return symbols;
}

std::shared_ptr<const NameList> class_names() {
    return std::make_shared<NameList>(
        NameList{"class", std::vector<std::string>(kLineClassNames.begin(), kLineClassNames.end()), 0, true});
}

}  // namespace

ExpressionSymbols sheet_variables() { return variables_of({nullptr, class_names(), nullptr, nullptr}); }

ExpressionSymbols symbols_of(const StyleSheet& sheet, const SheetContext& context) {
    ExpressionSymbols symbols =
        variables_of({nullptr, class_names(), std::make_shared<NameList>(NameList{"object", context.objects, 1, false}),
                      std::make_shared<NameList>(NameList{"material", context.materials, 1, false})});
    std::erase_if(symbols.variables, [](const ExpressionVariable& v) { return v.rate == ValueRate::frame; });
    for (const VariableRow& row : variable_table()) {
        if (row.rate != ValueRate::frame) continue;
        symbols.parameters.push_back({std::string(row.name), row.type, {frame_value(row.variable, context), 0, 0}});
    }
    for (const SheetParameter& parameter : sheet.parameters) {
        if (const auto fault = fault_of_parameter(parameter, &context)) parameter.value.source.fail(*fault);
        ExpressionParameter made{parameter.name, ValueType::number, {}};
        if (parameter.value.kind == StyleValue::Kind::color) {
            made.type = ValueType::color;
            made.value = parameter.value.color;
        } else {
            made.value[0] = static_cast<float>(in_pixels(parameter.value.number, parameter.value.unit, context));
        }
        symbols.parameters.push_back(std::move(made));
    }
    for (const SheetLet& let : sheet.lets) symbols.lets.push_back({let.name, let.text.text});
    symbols.groups = sheet.groups;
    symbols.ramps = sheet.ramps;
    symbols.px_per_mm = context.px_per_mm;
    return symbols;
}

double in_pixels(double number, SheetUnit unit, const SheetContext& context) {
    switch (unit) {
        case SheetUnit::mm:
            return number * context.px_per_mm;
        case SheetUnit::pt:
            return number * context.px_per_mm * 25.4 / 72;
        case SheetUnit::percent:
            return number * context.height_px / 100;
        case SheetUnit::px:
        case SheetUnit::world:
            break;
    }
    return number;
}

const char* suffix_of(SheetUnit unit) {
    static constexpr const char* kSuffixes[] = {"", "mm", "pt", "%", "world"};
    return kSuffixes[static_cast<std::size_t>(unit)];
}

std::optional<std::string> fault_of_parameter(const SheetParameter& parameter, const SheetContext* context) {
    if (parameter.value.kind == StyleValue::Kind::color) {
        if (parameter.least || parameter.most) return "a colour has no min and max";
        return std::nullopt;
    }
    double value = parameter.value.number;
    const auto shown = [unit = suffix_of(parameter.range_unit)](double number) { return text_of(number) + unit; };
    std::string as_written;
    double rounding = 0;
    if (parameter.value.unit != parameter.range_unit) {
        if (context == nullptr) return std::nullopt;
        const std::string unit = parameter.value.unit == SheetUnit::px ? "px" : suffix_of(parameter.value.unit);
        as_written = " (" + text_of(value) + unit + ")";
        value = in_pixels(value, parameter.value.unit, *context) / in_pixels(1, parameter.range_unit, *context);
        rounding = 1e-9 * std::abs(value);
    }
    if (parameter.least && value < *parameter.least - rounding)
        return "must be at least " + shown(*parameter.least) + ", got " + shown(value) + as_written;
    if (parameter.most && value > *parameter.most + rounding)
        return "must be at most " + shown(*parameter.most) + ", got " + shown(value) + as_written;
    return std::nullopt;
}

std::string text_of(double number) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", number);
    return text;
}

}  // namespace burin
