#include "web/sheet_values.h"

#include <cstddef>
#include <optional>

#include "scene/parse_toml.h"
#include "scene/sheet_tables.h"
#include "scene/sheet_toml.h"
#include "web/toml_text.h"

namespace burin {
namespace {

toml::table tables_of(const std::string& text) {
    return parse_checked_toml(text, "sheet", "a style sheet", kMaxSheetBytes, kMaxSheetValues);
}

/// The value of a parameter; nullptr where it is no parameter.
const toml::node* parameter_in(const toml::table& sheet, const std::string& name) {
    const toml::table* const parameters = sheet["parameters"].as_table();
    const toml::node* const parameter = parameters != nullptr ? parameters->get(name) : nullptr;
    if (parameter == nullptr || !parameter->is_table()) return parameter;
    return parameter->as_table()->get("value");
}

/// Where a place of a text is, in bytes; columns are characters.
std::optional<std::size_t> offset_of(const std::string& text, const toml::source_position& place) {
    std::size_t at = 0;
    for (toml::source_index line = 1; line < place.line; ++line) {
        at = text.find('\n', at);
        if (at == std::string::npos) return std::nullopt;
        ++at;
    }
    for (toml::source_index column = 1; column < place.column; ++column) {
        if (at >= text.size()) return std::nullopt;
        ++at;
        while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80) ++at;
    }
    return at;
}

std::string with_value(const std::string& text, const Override& change) {
    const toml::table before = tables_of(text);
    toml::table after = before;
    apply_sheet_override(after, change);
    const std::string name = change.key.substr(std::string_view("style.").size());
    const toml::node* const old_value = parameter_in(before, name);
    const toml::node* const new_value = parameter_in(after, name);
    if (old_value != nullptr && new_value != nullptr) {
        const auto begin = offset_of(text, old_value->source().begin), end = offset_of(text, old_value->source().end);
        if (begin && end && *begin < *end) {
            std::string changed = text;
            changed.replace(*begin, *end - *begin, text_of_toml(*new_value));
            if (tables_of(changed) == after) return changed;
        }
    }
    return text_of_toml(after) + "\n";
}

}  // namespace

std::string sheet_with_values(std::string text, const std::vector<std::pair<std::string, std::string>>& values) {
    for (const auto& [key, value] : values) text = with_value(text, {"style." + key, value});
    return text;
}

std::string text_in_toml(const std::string& key, const std::string& text) {
    // A literal text keeps every character as it is, but has no control characters.
    const auto is_control = [](char c) {
        return (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7F;
    };
    bool is_literal = text.find("'''") == std::string::npos;
    for (const char c : text) is_literal = is_literal && !is_control(c);
    if (is_literal) return key + " = '''\n" + text + "'''\n";
    return text_of_toml(toml::table{{key, text}}) + "\n";
}

}  // namespace burin
