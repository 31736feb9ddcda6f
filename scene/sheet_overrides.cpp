#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/text_scan.h"
#include "scene/scene_tables.h"
#include "scene/sheet_tables.h"
#include "shading/expression/unknown_word.h"

namespace burin {
namespace {

constexpr std::string_view kTopKeys[] = {"summary",    "crease_angle", "contours", "filter", "light",
                                         "parameters", "groups",       "let",      "ramp",   "surfaces"};

[[noreturn]] void fail(const Override& o, const std::string& message) {
    throw UsageError("--set " + printable(o.key) + "=" + printable(o.value) + ": " + message);
}

std::vector<std::string> names_in(const toml::table& root, std::string_view table) {
    std::vector<std::string> names;
    if (const toml::table* const found = root[table].as_table()) {
        for (const auto& [key, node] : *found) names.emplace_back(key.str());
    }
    return names;
}

std::string listed_keys(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + printable(name);
    return list.empty() ? "none" : list;
}

std::vector<std::string> names_of_sets(const toml::table& root) {
    std::vector<std::string> names;
    const toml::array* const sets = root["set"].as_array();
    for (std::size_t i = 0; sets != nullptr && i < sets->size(); ++i) {
        const toml::table* const set = sets->get(i)->as_table();
        if (const auto name = set != nullptr ? (*set)["name"].value<std::string>() : std::nullopt)
            names.push_back(*name);
    }
    return names;
}

[[noreturn]] void fail_unknown(const Override& o, const char* kind, std::string_view name,
                               const std::vector<std::string>& known) {
    fail(o, "the sheet has no " + std::string(kind) + " '" + printable(name) + "'" + suggestion_of(name, known) +
                "; it has " + listed_keys(known));
}

/// "let.NAME" changes what the sheet has.
void check_name(const toml::table& root, const Override& o, std::string_view key) {
    static constexpr std::pair<std::string_view, const char*> kTables[] = {
        {"parameters", "parameter"}, {"let", "let"}, {"ramp", "ramp"}, {"groups", "group"}};
    const std::size_t dot = key.find('.');
    const std::string_view name = key.substr(dot + 1, key.substr(dot + 1).find('.'));
    for (const auto& [table, kind] : kTables) {
        if (key.substr(0, dot) != table) continue;
        const std::vector<std::string> known = names_in(root, table);
        if (!is_word_of(known, name)) fail_unknown(o, kind, name, known);
    }
}

/// "set.NAME.KEY" with the set's number in place of its name; nothing where no set has the name.
std::string path_in_sets(const toml::table& root, std::string_view rest) {
    const std::size_t dot = rest.find('.');
    const std::string_view name = rest.substr(0, dot);
    const toml::array* const sets = root["set"].as_array();
    for (std::size_t i = 0; sets != nullptr && i < sets->size(); ++i) {
        const toml::table* const set = sets->get(i)->as_table();
        if (set != nullptr && (*set)["name"].value<std::string_view>() == name)
            return "set." + std::to_string(i) + (dot == std::string_view::npos ? "" : std::string(rest.substr(dot)));
    }
    return {};
}

/// Where in the tables a key of --set leads; `key`: behind "style.".
std::string path_of(const toml::table& root, const Override& o, std::string_view key) {
    const std::size_t dot = key.find('.');
    const std::string_view first = key.substr(0, dot);
    if (dot == std::string_view::npos) {
        if (const toml::node* const parameter =
                root["parameters"].as_table() != nullptr ? root["parameters"].as_table()->get(first) : nullptr) {
            return "parameters." + std::string(first) + (parameter->is_table() ? ".value" : "");
        }
        if (std::find(std::begin(kTopKeys), std::end(kTopKeys), first) != std::end(kTopKeys)) return std::string(first);
        fail_unknown(o, "parameter", first, names_in(root, "parameters"));
    }
    const toml::table* const styles = root["style"].as_table();
    if (styles != nullptr && styles->contains(first)) return "style." + std::string(key);
    if (first == "set") {
        const std::string_view rest = key.substr(dot + 1);
        const std::string path = path_in_sets(root, rest);
        if (path.empty()) fail_unknown(o, "set", rest.substr(0, rest.find('.')), names_of_sets(root));
        return path;
    }
    if (std::find(std::begin(kTopKeys), std::end(kTopKeys), first) != std::end(kTopKeys)) {
        check_name(root, o, key);
        return std::string(key);
    }
    fail_unknown(o, "style", first, names_in(root, "style"));
}

enum class ParameterKind { none, number, color };

ParameterKind kind_of(const toml::node* value) {
    if (value == nullptr || value->is_table()) return ParameterKind::none;
    const auto text = value->value<std::string_view>();
    return value->is_array() || (text && text->starts_with('#')) ? ParameterKind::color : ParameterKind::number;
}

}  // namespace

void apply_sheet_override(toml::table& root, const Override& o) {
    const std::string path = path_of(root, o, std::string_view(o.key).substr(std::string_view("style.").size()));
    const bool is_parameter = path.starts_with("parameters.");
    const ParameterKind before = is_parameter ? kind_of(root.at_path(path).node()) : ParameterKind::none;
    apply_override(root, o, path);
    if (before == ParameterKind::none || kind_of(root.at_path(path).node()) == before) return;
    fail(o, before == ParameterKind::color ? "the parameter is a colour, not a number"
                                           : "the parameter is a number, not a colour");
}

}  // namespace burin
