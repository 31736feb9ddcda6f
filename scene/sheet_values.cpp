#include "scene/sheet_values.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "mesh/text_scan.h"
#include "scene/color.h"
#include "scene/number_text.h"
#include "shading/expression/error.h"

namespace burin {
namespace {

using Of = SheetValueRule::Of;

std::size_t characters_in(std::string_view text) {
    std::size_t count = 0;
    for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0u) != 0x80u ? 1 : 0;
    return count;
}

struct NumberWithUnit {
    double number;
    SheetUnit unit;
};

/// "0.35mm"; nothing for another text.
std::optional<NumberWithUnit> number_with_unit(std::string_view text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [behind, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
    std::string_view rest(behind, static_cast<std::size_t>(end - behind));
    while (rest.starts_with(' ')) rest.remove_prefix(1);
    static constexpr std::pair<std::string_view, SheetUnit> kUnits[] = {{"px", SheetUnit::px},
                                                                        {"mm", SheetUnit::mm},
                                                                        {"pt", SheetUnit::pt},
                                                                        {"%", SheetUnit::percent},
                                                                        {"world", SheetUnit::world}};
    for (const auto& [name, unit] : kUnits) {
        if (rest == name) return NumberWithUnit{number, unit};
    }
    return std::nullopt;
}

/// What stands behind the number of a text in place of a unit: letters; else nothing.
std::string_view unknown_unit_in(std::string_view text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [behind, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc()) return {};
    std::string_view rest(behind, static_cast<std::size_t>(end - behind));
    while (rest.starts_with(' ')) rest.remove_prefix(1);
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    return rest.find_first_not_of(kLetters) == std::string_view::npos ? rest : std::string_view();
}

std::string wanted(const SheetValueRule& rule) {
    static constexpr const char* kWhat[] = {"a number (pixels), a length such as \"0.35mm\"", "a number",
                                            "a colour such as \"#c0d0ff\", or a list of three linear numbers",
                                            "a number, a length such as \"0.35mm\", or a colour such as \"#c0d0ff\""};
    return std::string("must be ") + kWhat[static_cast<std::size_t>(rule.of)] +
           (rule.is_constant ? "" : ", a ramp { over, stops }, or an expression, which begins with '='");
}

/// Only what has a unit whose size in pixels is not known yet may be too large here.
std::optional<std::string> fault_of_number(double number, SheetUnit unit, const SheetValueRule& rule) {
    if (!std::isfinite(number)) return "must be a finite number";
    const bool is_too_small = rule.excludes_least ? !(number > rule.least) : number < rule.least;
    const bool is_too_large = unit == SheetUnit::px && number > rule.most;
    if (!is_too_small && !is_too_large) return std::nullopt;
    return "must be " + std::string(rule.excludes_least ? "greater than " : "at least ") + number_text(rule.least) +
           (std::isinf(rule.most) ? "" : " and at most " + number_text(rule.most)) + ", got " + number_text(number);
}

}  // namespace

bool is_sheet_word(std::string_view name) {
    constexpr std::string_view kKnown = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    return !name.empty() && name.find_first_not_of(kKnown) == std::string_view::npos;
}

SheetUnit unit_of(const toml::node& value) {
    const auto* const text = value.as_string();
    const auto length = text != nullptr ? number_with_unit(text->get()) : std::nullopt;
    return length ? length->unit : SheetUnit::px;
}

SheetText SheetValueReader::text_at(const Place& place) {
    SheetText result;
    result.where = place.table.position_of(place.node);
    result.context = place.context;
    result.is_from_command_line = TomlReader::is_override(result.where);
    if (const auto* const text = place.node.as_string()) {
        result.text = text->get();
        const toml::source_region& source = place.node.source();
        // A text without escapes has as many characters as its source, but for the quotes.
        const bool is_plain = source.begin.line == source.end.line &&
                              source.end.column - source.begin.column == characters_in(result.text) + 2;
        if (is_plain && !result.is_from_command_line) result.first_column = result.where.column + 1;
    }
    return result;
}

SheetText SheetValueReader::expression(const Place& place) {
    SheetText result = text_at(place);
    if (result.text.starts_with('=')) {
        result.text.erase(0, 1);
        result.skipped = 1;
        if (result.first_column > 0) ++result.first_column;
    }
    if (++expressions_ > kMostSheetExpressions) {
        TomlReader::fail_at(result.where, place.context + ": the sheet has more than " +
                                              std::to_string(kMostSheetExpressions) +
                                              " expressions; share parts of them in [let]");
    }
    return result;
}

StyleValue SheetValueReader::constant(const Place& place, const SheetValueRule& rule, SheetText source) {
    const auto fail = [&](const std::string& message) {
        TomlReader::fail_at(source.where, place.context + ": " + message);
    };
    const bool may_be_color = rule.of == Of::color || rule.of == Of::number_or_color;
    const bool may_be_number = rule.of != Of::color;
    StyleValue value;
    const auto number = TomlReader::number_of(place.node);
    if (number && may_be_number) {
        value.number = *number;
    } else if (const auto* const text = place.node.as_string()) {
        if (may_be_color && text->get().starts_with('#')) {
            const auto color = color_from_hex(text->get());
            if (!color) fail("must be a colour such as \"#c0d0ff\"");
            value = StyleValue::of_color({color->r, color->g, color->b});
        } else {
            const auto length = number_with_unit(text->get());
            const std::string_view unit = length || !may_be_number ? std::string_view() : unknown_unit_in(text->get());
            if (!unit.empty() && rule.of == Of::number) fail("takes no unit");
            if (!unit.empty()) fail("unknown unit " + in_quotes(unit) + ": give px, mm, pt, % or world");
            if (!length || !may_be_number) fail(wanted(rule));
            if (rule.of == Of::number && length->unit != SheetUnit::px) fail("takes no unit");
            value.number = length->number;
            value.unit = length->unit;
        }
    } else if (const toml::array* const list = place.node.as_array(); list != nullptr && may_be_color) {
        value.kind = StyleValue::Kind::color;
        if (list->size() != 3) fail(wanted(rule));
        for (std::size_t k = 0; k < 3; ++k) {
            const auto part = TomlReader::number_of(*list->get(k));
            if (!part || !(*part >= 0 && *part <= 65504)) fail("must be three linear numbers from 0 on");
            value.color[k] = static_cast<float>(*part);
        }
    } else {
        fail(wanted(rule));
    }
    if (value.kind == StyleValue::Kind::number) {
        if (const auto fault = fault_of_number(value.number, value.unit, rule)) fail(*fault);
    }
    value.source = std::move(source);
    return value;
}

Ramp SheetValueReader::stops(const Place& place, const SheetValueRule& rule, SheetUnit& unit) {
    const toml::array* const list = place.node.as_array();
    const auto fail_at = [&](const toml::node& node, const std::string& message) {
        TomlReader::fail_at(place.table.position_of(node), place.context + ": " + message);
    };
    if (list == nullptr) fail_at(place.node, "must be a list of stops, [[at, value], ...]");
    if (list->size() > kMostRampStops)
        fail_at(place.node, "has more than " + std::to_string(kMostRampStops) + " stops");
    Ramp ramp;
    SheetValueReader constants;
    SheetValueRule of_values = rule;
    of_values.is_constant = true;
    for (const toml::node& node : *list) {
        const toml::array* const stop = node.as_array();
        if (stop == nullptr || stop->size() != 2) fail_at(node, "a stop must be a list of two: [at, value]");
        const auto at = TomlReader::number_of(*stop->get(0));
        if (!at) fail_at(*stop->get(0), "where a stop lies must be a number");
        const StyleValue value = constants.constant({place.table, *stop->get(1), place.context}, of_values,
                                                    text_at({place.table, *stop->get(1), place.context}));
        const bool is_color = value.kind == StyleValue::Kind::color;
        if (!ramp.stops.empty() && is_color != ramp.is_color)
            fail_at(*stop->get(1), "the values of a ramp must be all numbers, or all colours");
        if (!ramp.stops.empty() && !is_color && value.unit != unit)
            fail_at(*stop->get(1), "the values of a ramp must all have the same unit");
        if (value.unit == SheetUnit::world)
            fail_at(
                *stop->get(1),
                "a ramp takes no world units: write an expression, such as \"=ramp(\\\"name\\\", depth) / px_size\"");
        unit = value.unit;
        ramp.is_color = is_color;
        RampStop made{static_cast<float>(*at), value.color};
        if (!is_color) made.value[0] = static_cast<float>(value.number);
        ramp.stops.push_back(made);
    }
    if (const auto fault = fault_of_ramp(ramp)) fail_at(place.node, *fault);
    return ramp;
}

Ramp SheetValueReader::ramp(TomlReader& table, const SheetValueRule& rule, SheetUnit& unit) {
    if (!table.has("stops")) table.fail("needs stops = [[at, value], ...]");
    const toml::node& node = *table.node("stops");
    Ramp ramp = stops({table, node, table.context_of("stops")}, rule, unit);
    static constexpr RampBetween kBetween[] = {RampBetween::linear, RampBetween::smooth, RampBetween::step,
                                               RampBetween::curve};
    ramp.between = kBetween[table.choice("between", {"linear", "smooth", "step", "curve"}).value_or(0)];
    static constexpr RampOutside kOutside[] = {RampOutside::hold, RampOutside::repeat, RampOutside::mirror};
    ramp.outside = kOutside[table.choice("outside", {"hold", "repeat", "mirror"}).value_or(0)];
    return ramp;
}

StyleValue SheetValueReader::ramp_over(const Place& place, const SheetValueRule& rule) {
    TomlReader table(*place.node.as_table(), place.context, place.table.file(), kSheetPage);
    StyleValue value;
    value.kind = StyleValue::Kind::ramp;
    if (!table.is_text("over")) {
        if (table.has("over")) table.fail("over", "must be the name of a variable, or an expression, in quotes");
        table.fail("needs over = \"VARIABLE\", what the ramp goes over");
    }
    value.source = expression(table, "over");
    value.ramp = ramp(table, rule, value.unit);
    table.finish();
    return value;
}

StyleValue SheetValueReader::read(const Place& place, const SheetValueRule& rule) {
    if (place.node.is_table()) {
        if (rule.is_constant)
            TomlReader::fail_at(place.table.position_of(place.node), place.context + ": " + wanted(rule));
        return ramp_over(place, rule);
    }
    SheetText text = text_at(place);
    if (!text.text.starts_with('=')) return constant(place, rule, std::move(text));
    if (rule.is_constant) TomlReader::fail_at(text.where, place.context + ": " + wanted(rule));
    StyleValue value;
    value.kind = StyleValue::Kind::expression;
    value.source = expression(place);
    return value;
}

StyleValue SheetValueReader::value(TomlReader& table, std::string_view key, const SheetValueRule& rule) {
    return read({table, *table.node(key), table.context_of(key)}, rule);
}

StyleValue SheetValueReader::element(TomlReader& table, std::string_view key, std::size_t index,
                                     const SheetValueRule& rule) {
    return read({table, *table.node(key)->as_array()->get(index), table.context_of(key)}, rule);
}

std::size_t SheetValueReader::list_size(TomlReader& table, std::string_view key) {
    const toml::node* const node = table.node(key);
    return node != nullptr && node->is_array() ? node->as_array()->size() : 0;
}

SheetText SheetValueReader::expression(TomlReader& table, std::string_view key) {
    table.text(key);  // must be one
    return expression(Place{table, *table.node(key), table.context_of(key)});
}

SheetText SheetValueReader::word(TomlReader& table, std::string_view key) {
    if (!is_sheet_word(*table.text(key))) table.fail(key, "must be a name, which has letters, digits, _ and - only");
    return text_at({table, *table.node(key), table.context_of(key)});
}

}  // namespace burin
