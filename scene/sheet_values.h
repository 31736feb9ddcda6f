#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "scene/toml_reader.h"
#include "shading/sheet/style_sheet.h"

// Values of style sheets are read here: constants with units, ramps, expressions. Only the sources that read sheets
// include this header.

namespace burin {

/// What a value of a sheet may be.
struct SheetValueRule {
    enum class Of : std::uint8_t { length, number, color, number_or_color };
    Of of = Of::length;
    double least = 0, most = std::numeric_limits<double>::infinity();  ///< of lengths: in pixels
    bool excludes_least = false;
    bool is_constant = false;  ///< ramps and expressions are errors
};

constexpr std::string_view kSheetPage = "docs/shading/sheets.md";

/// Whether a name has letters, digits, _ and - only, and at least one of them.
bool is_sheet_word(std::string_view name);

/// The unit of a constant; `px` of what has none.
SheetUnit unit_of(const toml::node& value);

/// Reads the values of a sheet, and counts its expressions. All throw InputError with line and column, or UsageError
/// for a value of the command line.
class SheetValueReader {
  public:
    /// The value of a key that is there.
    StyleValue value(TomlReader& table, std::string_view key, const SheetValueRule& rule);
    /// An element of a list. `key`: of the list.
    StyleValue element(TomlReader& table, std::string_view key, std::size_t index, const SheetValueRule& rule);
    /// How many elements the list of a key has; 0 where it is no list.
    static std::size_t list_size(TomlReader& table, std::string_view key);
    /// The text of a key that is there: an expression, with or without "=".
    SheetText expression(TomlReader& table, std::string_view key);
    /// The name that a key has, of something outside of the sheet.
    static SheetText word(TomlReader& table, std::string_view key);
    /// A ramp without what it goes over.
    static Ramp ramp(TomlReader& table, const SheetValueRule& rule, SheetUnit& unit);

  private:
    struct Place {
        const TomlReader& table;
        const toml::node& node;
        std::string context;
    };
    StyleValue read(const Place& place, const SheetValueRule& rule);
    StyleValue constant(const Place& place, const SheetValueRule& rule, SheetText source);
    SheetText expression(const Place& place);
    StyleValue ramp_over(const Place& place, const SheetValueRule& rule);
    static SheetText text_at(const Place& place);
    static Ramp stops(const Place& place, const SheetValueRule& rule, SheetUnit& unit);

    std::size_t expressions_ = 0;
};

}  // namespace burin
