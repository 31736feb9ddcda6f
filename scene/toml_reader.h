#pragma once

#include <toml++/toml.h>
#include <functional>
#include <glm/glm.hpp>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace burin {

/// Reads the keys of one TOML table, each with its type and range checked, and at the end refuses
/// keys that nobody asked for. Only the sources that read scene files include this header.
class TomlReader {
  public:
    /// `context` names the table in messages ("[camera]"); empty for the whole file. `file` is
    /// named for values that stand in no file.
    /// `page`: of the docs, lists the known keys.
    TomlReader(const toml::table& table, std::string context, std::string file,
               std::string_view page = "docs/scene-format.md")
        : table_(&table), context_(std::move(context)), file_(std::move(file)), page_(page) {}

    struct Range {
        double low, high;
        bool open_low = false, open_high = false;  ///< whether the ends themselves are excluded
    };

    bool has(std::string_view key) const { return table_->contains(key); }
    bool is_number(std::string_view key) const { return has(key) && table_->get(key)->is_number(); }
    bool is_text(std::string_view key) const { return has(key) && table_->get(key)->is_string(); }
    bool is_table(std::string_view key) const { return has(key) && table_->get(key)->is_table(); }
    std::optional<double> number(std::string_view key, Range range);
    std::optional<int> integer(std::string_view key, int low, int high);
    std::optional<bool> boolean(std::string_view key);
    std::optional<std::string> text(std::string_view key);
    /// A list, or a single text.
    std::optional<std::vector<std::string>> texts(std::string_view key);
    std::optional<std::vector<double>> numbers(std::string_view key, std::size_t count);
    std::optional<glm::dvec3> vector(std::string_view key);
    /// "#rrggbb" or three linear numbers.
    std::optional<glm::vec3> color(std::string_view key);
    /// One of the given words; its index.
    std::optional<std::size_t> choice(std::string_view key, const std::vector<std::string_view>& words);
    /// A table within this one, or nothing.
    std::optional<TomlReader> table(std::string_view key);
    /// An array of tables; a single table counts as an array of one.
    std::vector<TomlReader> tables(std::string_view key);

    /// The value of a key as it stands; nullptr if there is none.
    const toml::node* node(std::string_view key) { return find(key); }
    /// All keys, in the order of the file.
    std::vector<std::string> keys() const;

    /// A key of the table that is nearly `key`.
    std::optional<std::string> misspelled(std::string_view key) const;

    /// Throws for the first key that was not read.
    void finish() const;

    /// Throws for a key's value, or for the whole table: InputError with the place in the file,
    /// UsageError if the value comes from an override.
    [[noreturn]] void fail(std::string_view key, const std::string& message) const;
    [[noreturn]] void fail(const std::string& message) const;
    SourcePosition position(std::string_view key) const;
    SourcePosition position() const;
    SourcePosition position_of(const toml::node& node) const;
    /// What messages about a key begin with.
    std::string context_of(std::string_view key) const {
        return context_ + (context_.empty() ? "" : " ") + std::string(key);
    }
    const std::string& context() const { return context_; }
    const std::string& file() const { return file_; }
    /// Whether a place is that of an override's value, in no file.
    static bool is_override(const SourcePosition& position) {
        return position.file.starts_with(kOption) || position.file.starts_with(kCall);
    }
    /// Throws InputError, or UsageError for a value of an override.
    [[noreturn]] static void fail_at(const SourcePosition& position, const std::string& message);

    /// Values of overrides have one of these in front of their source path.
    static constexpr std::string_view kOption = "--set ", kCall = "burin_set() ";

  private:
    const toml::node* find(std::string_view key);
    double checked_number(const toml::node& node, std::string_view key) const;

    const toml::table* table_;
    std::string context_;
    std::string file_;
    std::string_view page_;
    std::set<std::string, std::less<>> known_;
};

}  // namespace burin
