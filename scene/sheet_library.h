#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene_description.h"
#include "shading/sheet/style_sheet.h"

// Where style sheets are found by name: those that the program brings along, then those in folders of the user.

namespace burin {

/// A sheet that is part of the program, made of a file in styles/.
struct BuiltInSheet {
    std::string_view name, text;
};
std::span<const BuiltInSheet> built_in_sheets();

/// A sheet that has been found: a part of the program, or a file.
struct SheetSource {
    std::string name;
    std::string file;       ///< its path; empty: it is a part of the program
    std::string_view text;  ///< if it is
};

/// Finds a sheet. What has a / or ends in .toml is a file, relative to `folder`, whether it is there or not; else it is
/// a name: of a built-in sheet, of a file NAME.toml in ~/.config/burin/styles, then in the folders of $BURIN_STYLES.
/// Nothing if there is no sheet of that name.
std::optional<SheetSource> find_sheet(const std::string& wanted, const std::filesystem::path& folder);
/// All sheets that names find, the built-in ones first.
std::vector<SheetSource> all_sheets();
/// "there is no style sheet 'x', did you mean ...; burin styles lists them"
std::string no_such_sheet(const std::string& wanted);

/// A sheet's text, and its name in messages.
struct NamedSheetText {
    std::string name, text;
};
/// The text of a sheet that is given as such, which is one of several lines, or by its name or file. Throws InputError,
/// and UsageError if there is no sheet of that name.
NamedSheetText sheet_text_of(const std::string& text_or_name);

/// Reads a sheet. Throws as read_sheet_text().
StyleSheet read_sheet(const SheetSource& source, const std::vector<Override>& overrides = {});
/// Its text as it stands. Throws InputError.
std::string text_of_sheet(const SheetSource& source);

}  // namespace burin
