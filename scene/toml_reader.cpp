#include "scene/toml_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/interrupt.h"
#include "base/suggestion.h"
#include "mesh/text_scan.h"
#include "scene/color.h"
#include "scene/number_text.h"

namespace burin {
const toml::node* TomlReader::find(std::string_view key) {
    known_.emplace(key);
    return table_->get(key);
}

SourcePosition TomlReader::position_of(const toml::node& node) const {
    const toml::source_region& source = node.source();
    return {source.path ? *source.path : file_, source.begin.line, source.begin.column};
}

void TomlReader::fail_at(const SourcePosition& position, const std::string& message) {
    if (is_override(position)) throw UsageError(position.file + ": " + message);
    throw InputError(position, message);
}

SourcePosition TomlReader::position() const { return position_of(*table_); }

SourcePosition TomlReader::position(std::string_view key) const {
    const toml::node* const node = table_->get(key);
    return node != nullptr ? position_of(*node) : position();
}

void TomlReader::fail(std::string_view key, const std::string& message) const {
    fail_at(position(key), context_of(key) + ": " + message);
}

void TomlReader::fail(const std::string& message) const {
    fail_at(position(), context_ + (context_.empty() ? "" : " ") + message);
}

std::optional<double> TomlReader::number_of(const toml::node& node) {
    if (const auto whole = node.value_exact<std::int64_t>()) return static_cast<double>(*whole);
    return node.value_exact<double>();
}

double TomlReader::checked_number(const toml::node& node, std::string_view key) const {
    const auto value = number_of(node);
    if (!value) fail(key, "must be a number");
    if (!std::isfinite(*value)) fail(key, "must be a finite number");
    return *value;
}

std::optional<double> TomlReader::number(std::string_view key, Range range) {
    const toml::node* const node = find(key);
    if (node == nullptr) return std::nullopt;
    const double value = checked_number(*node, key);
    const bool inside = (range.open_low ? value > range.low : value >= range.low) &&
                        (range.open_high ? value < range.high : value <= range.high);
    if (!inside) {
        fail(key, "must be " + std::string(range.open_low ? "greater than " : "at least ") + number_text(range.low) +
                      (range.high < 1e300 ? std::string(range.open_high ? " and less than " : " and at most ") +
                                                number_text(range.high)
                                          : "") +
                      ", got " + number_text(value));
    }
    return value;
}

std::optional<int> TomlReader::integer(std::string_view key, int low, int high) {
    const toml::node* const node = find(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value_exact<std::int64_t>();
    if (!value) fail(key, "must be a whole number");
    if (*value < low || *value > high) {
        fail(key, "must be at least " + std::to_string(low) + " and at most " + std::to_string(high) + ", got " +
                      std::to_string(*value));
    }
    return static_cast<int>(*value);
}

std::optional<bool> TomlReader::boolean(std::string_view key) {
    const toml::node* const node = find(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value_exact<bool>();
    if (!value) fail(key, "must be true or false");
    return *value;
}

std::optional<std::string> TomlReader::text(std::string_view key) {
    const toml::node* const node = find(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value_exact<std::string>();
    if (!value) fail(key, "must be a text in quotes");
    return *value;
}

std::optional<std::vector<std::string>> TomlReader::texts(std::string_view key) {
    const toml::node* const node = find(key);
    if (node == nullptr) return std::nullopt;
    if (const auto one = node->value_exact<std::string>()) return std::vector{*one};
    const toml::array* const array = node->as_array();
    if (array == nullptr) fail(key, "must be a list of texts, such as [\"a\", \"b\"]");
    std::vector<std::string> result;
    for (const toml::node& element : *array) {
        const auto value = element.value_exact<std::string>();
        if (!value) fail(key, "must be a list of texts, such as [\"a\", \"b\"]");
        result.push_back(*value);
    }
    return result;
}

std::optional<std::vector<double>> TomlReader::numbers(std::string_view key, std::size_t count) {
    const toml::node* const node = find(key);
    if (node == nullptr) return std::nullopt;
    const toml::array* const array = node->as_array();
    if (array == nullptr || array->size() != count) {
        fail(key, "must be a list of " + std::to_string(count) + " numbers");
    }
    std::vector<double> result;
    for (const toml::node& element : *array) result.push_back(checked_number(element, key));
    return result;
}

std::optional<glm::dvec3> TomlReader::vector(std::string_view key) {
    const auto values = numbers(key, 3);
    if (!values) return std::nullopt;
    return glm::dvec3((*values)[0], (*values)[1], (*values)[2]);
}

std::optional<glm::vec3> TomlReader::color(std::string_view key) {
    const toml::node* const node = find(key);
    if (node == nullptr) return std::nullopt;
    if (node->is_string()) {
        const auto color = color_from_hex(*node->value_exact<std::string>());
        if (!color) fail(key, "must be a colour like \"#c0d0ff\", or a list of three linear numbers");
        return color;
    }
    const glm::vec3 color(*vector(key));
    if (color.r < 0 || color.g < 0 || color.b < 0) fail(key, "must not be negative");
    return color;
}

std::optional<std::size_t> TomlReader::choice(std::string_view key, const std::vector<std::string_view>& words) {
    const auto value = text(key);
    if (!value) return std::nullopt;
    const auto it = std::find(words.begin(), words.end(), *value);
    if (it != words.end()) return static_cast<std::size_t>(it - words.begin());
    std::string list;
    for (const std::string_view word : words) {
        list += (list.empty() ? "\"" : ", \"") + std::string(word) + "\"";
    }
    fail(key, "must be one of " + list);
}

std::optional<TomlReader> TomlReader::table(std::string_view key) {
    const toml::node* const node = find(key);
    if (node == nullptr) return std::nullopt;
    const toml::table* const table = node->as_table();
    if (table == nullptr) fail(key, "must be a table");
    const std::string_view outer =
        context_.empty() ? std::string_view() : std::string_view(context_).substr(1, context_.size() - 2);
    return this->within(*table, "[" + std::string(outer) + (outer.empty() ? "" : ".") + std::string(key) + "]");
}

std::vector<TomlReader> TomlReader::tables(std::string_view key) {
    const toml::node* const node = find(key);
    std::vector<TomlReader> result;
    if (node == nullptr) return result;
    const std::string name = "[[" + std::string(key) + "]]";
    if (const toml::table* const single = node->as_table()) {
        result.push_back(within(*single, name));
        return result;
    }
    const toml::array* const array = node->as_array();
    if (array == nullptr) fail(key, "must be a list of tables, " + name);
    for (const toml::node& element : *array) {
        throw_if_interrupted();
        if (!element.is_table()) fail(key, "must be a list of tables, " + name);
        result.push_back(within(*element.as_table(), name));
    }
    return result;
}

std::vector<std::string> TomlReader::keys() const {
    std::vector<std::pair<toml::source_position, std::string>> places;
    for (const auto& [key, node] : *table_) places.emplace_back(key.source().begin, std::string(key.str()));
    std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> result;
    for (auto& [place, name] : places) result.push_back(std::move(name));
    return result;
}

std::optional<std::string> TomlReader::misspelled(std::string_view key) const {
    for (const auto& [other, node] : *table_) {
        const bool is_as_long = other.str().size() <= key.size() + 1 && key.size() <= other.str().size() + 1;
        if (is_as_long && edit_distance(other.str(), key) == 1) return std::string(other.str());
    }
    return std::nullopt;
}

std::string TomlReader::hint_for_top_key(std::string_view key) const {
    const bool is_one = std::find(top_keys_.begin(), top_keys_.end(), key) != top_keys_.end();
    return is_one && !context_.empty() ? "; as a key of the whole file it belongs above the first table" : "";
}

void TomlReader::finish() const {
    for (const auto& [key, node] : *table_) {
        if (known_.contains(key.str())) continue;
        std::string message = "unknown key '" + printable(key.str()) + "'";
        if (const std::string hint = hint_for_top_key(key.str()); !hint.empty()) {
            message += hint;
        } else if (const auto closest = closest_word(key.str(), {known_.begin(), known_.end()})) {
            message += "; did you mean '" + *closest + "'?";
        } else {
            message += "; " + std::string(page_) + " lists the known ones";
        }
        SourcePosition where = position_of(node);
        const toml::source_region& source = key.source();
        if (source.begin) {
            where.line = source.begin.line;
            where.column = source.begin.column;
        }
        fail_at(where, context_ + (context_.empty() ? "" : ": ") + message);
    }
}

}  // namespace burin
