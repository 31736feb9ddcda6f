#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "mesh/text_scan.h"
#include "scene/scene_tables.h"
#include "scene/toml_depth.h"

namespace burin {
namespace {

/// For messages about an override; TomlReader recognises it.
std::string override_place(const Override& o) {
    const std::string_view from = o.from == Override::From::option ? TomlReader::kOption : TomlReader::kCall;
    return std::string(from) + printable(o.key) + "=" + printable(o.value);
}

[[noreturn]] void fail_override(const Override& o, const std::string& message) {
    throw UsageError(override_place(o) + ": " + message);
}

/// A text as TOML writes it.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20 || code == 0x7F || c == '"' || c == '\\') {
            char escape[8];
            std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(code));
            result += escape;
        } else {
            result += c;
        }
    }
    return result + '"';
}

/// A table whose only member is the value; nothing if the text is no single TOML value.
std::optional<toml::table> parse_value(const Override& o, const std::string& text) {
    const std::string line = "value = " + text;
    if (line_nested_too_deep(line)) fail_override(o, kTomlTooDeep);
    try {
        toml::table table = toml::parse(line, override_place(o));
        if (table.size() == 1) return table;
    } catch (const toml::parse_error&) {
    }
    return std::nullopt;
}

/// Numbers as options take them, in TOML: ".5" is 0.5; "1,2,3" and "400x300" are lists. Nothing for other texts and for
/// what is a text by its key.
std::optional<std::string> numbers_in_toml(std::string_view key, std::string_view text) {
    for (const std::string_view name : {"name", "file", "material", "highlight"}) {
        if (key.ends_with(name)) return std::nullopt;
    }
    const bool is_list = text.starts_with('[') && text.ends_with(']');
    if (is_list) text = text.substr(1, text.size() - 2);
    std::string result;
    int count = 0;
    for (std::size_t begin = 0, end = 0; end != std::string_view::npos; begin = end + 1, ++count) {
        end = text.find_first_of(is_list ? "," : ",x", begin);
        double value = 0;
        std::string_view part = text.substr(begin, end - begin);
        while (part.starts_with(' ')) part.remove_prefix(1);
        while (part.ends_with(' ')) part.remove_suffix(1);
        if (part.starts_with('+')) part.remove_prefix(1);
        // 001122 is rather a colour.
        if (part.size() > 1 && part[0] == '0' && part.find_first_not_of("0123456789") == std::string_view::npos)
            return std::nullopt;
        const auto [last, error] = std::from_chars(part.data(), part.data() + part.size(), value);
        if (error != std::errc() || last != part.data() + part.size() || !std::isfinite(value)) return std::nullopt;
        char number[40];
        const bool is_whole = part.find_first_of(".eE") == std::string_view::npos && std::abs(value) < 1e15;
        std::snprintf(number, sizeof number, is_whole ? "%.0f" : "%.17e", value);
        result += (result.empty() ? "" : ", ") + std::string(number);
    }
    return is_list || count > 1 ? "[" + result + "]" : result;
}

/// Names as they are typed, "a,b" and "[a, b]", as a list in TOML. Nothing for one name, and for keys that have no list
/// of names.
std::optional<std::string> names_in_toml(std::string_view key, std::string_view text) {
    key = key.substr(key.rfind('.') + 1);
    if (key != "classes" && key != "objects" && key != "materials") return std::nullopt;
    const bool is_list = text.starts_with('[') && text.ends_with(']');
    if (is_list) text = text.substr(1, text.size() - 2);
    if (!is_list && text.find(',') == std::string_view::npos) return std::nullopt;
    std::string result;
    for (std::size_t begin = 0, end = 0; end != std::string_view::npos; begin = end + 1) {
        end = text.find(',', begin);
        std::string_view part = text.substr(begin, end - begin);
        while (part.starts_with(' ')) part.remove_prefix(1);
        while (part.ends_with(' ')) part.remove_suffix(1);
        if (part.empty()) return std::nullopt;
        result += (result.empty() ? "" : ", ") + quoted(std::string(part));
    }
    return "[" + result + "]";
}

bool is_number(std::string_view part) { return part.find_first_not_of("0123456789") == std::string_view::npos; }

/// The key has a number for an element, `part` of it, but what stands before it is no list.
[[noreturn]] void fail_no_list(const Override& o, std::string_view part) {
    const auto begin = static_cast<std::size_t>(part.data() - o.key.data());
    const std::string list = o.key.substr(0, begin - 1);
    fail_override(o, "there is no list '" + printable(list) + "' that has an element '" + printable(part) +
                         "'; without the number, " + printable(list + o.key.substr(begin + part.size())) +
                         " is a setting of its only element");
}

toml::table override_value(const Override& o) {
    if (auto value = parse_value(o, o.value)) return *std::move(value);
    if (const auto numbers = numbers_in_toml(o.key, o.value)) {
        if (auto value = parse_value(o, *numbers)) return *std::move(value);
    }
    if (const auto names = names_in_toml(o.key, o.value)) {
        if (auto value = parse_value(o, *names)) return *std::move(value);
    }
    if (auto value = parse_value(o, quoted(o.value))) return *std::move(value);  // typed without quotes
    fail_override(o, "the value is not UTF-8");
}

}  // namespace

void apply_override(toml::table& root, const Override& o) { apply_override(root, o, o.key); }

void apply_override(toml::table& root, const Override& o, std::string_view place) {
    constexpr int kMaxParts = 16;
    toml::table holder = override_value(o);
    toml::node&& value = std::move(*holder.get("value"));  // a copied node forgets its source
    toml::node* at = &root;
    std::string_view rest = place;
    for (int parts = 1; parts <= kMaxParts; ++parts) {
        const std::size_t dot = rest.find('.');
        const std::string_view part = rest.substr(0, dot);
        const bool is_last = dot == std::string_view::npos;
        if (part.empty()) fail_override(o, "the key must be like lines.width or object.0.subdivide");
        if (toml::array* const array = at->as_array()) {
            std::size_t index = 0;
            const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
            if (error != std::errc() || end != part.data() + part.size() || index >= array->size()) {
                fail_override(
                    o, "there is no element '" + printable(part) + "', the list has " + std::to_string(array->size()));
            }
            if (is_last) {
                array->replace(array->begin() + static_cast<std::ptrdiff_t>(index), std::move(value));
                return;
            }
            at = array->get(index);
        } else if (toml::table* const table = at->as_table()) {
            if (parts > 1 && is_number(part) && !table->contains(part)) fail_no_list(o, part);
            if (is_last) {
                table->insert_or_assign(part, std::move(value));
                return;
            }
            if (!table->contains(part)) {
                toml::table empty = *parse_value(o, "{}");
                table->insert(part, std::move(*empty.get("value")));
            }
            at = table->get(part);
        } else {
            fail_override(o, "'" + printable(part) + "' stands below a value that is no table");
        }
        rest.remove_prefix(dot + 1);
    }
    fail_override(o, "the key has too many parts");
}

}  // namespace burin
