#include "scene/sheet_library.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "base/mapped_file.h"
#include "mesh/text_scan.h"
#include "scene/sheet_toml.h"
#include "shading/expression/unknown_word.h"

namespace burin {
namespace {

namespace fs = std::filesystem;

/// The user's folders with sheets, in the order in which they are searched.
std::vector<fs::path> sheet_folders() {
    std::vector<fs::path> folders;
    if (const char* const home = std::getenv("HOME"); home != nullptr && *home != '\0')
        folders.push_back(fs::path(home) / ".config/burin/styles");
    const char* const listed = std::getenv("BURIN_STYLES");
    for (std::string_view rest = listed != nullptr ? listed : ""; !rest.empty();) {
        const std::size_t colon = rest.find(':');
        if (colon != 0) folders.emplace_back(rest.substr(0, colon));
        rest.remove_prefix(colon == std::string_view::npos ? rest.size() : colon + 1);
    }
    return folders;
}

std::string name_in_messages(const SheetSource& source) {
    return source.file.empty() ? "styles/" + source.name + ".toml" : source.file;
}

bool is_path(const std::string& wanted) { return wanted.find('/') != std::string::npos || wanted.ends_with(".toml"); }

}  // namespace

std::optional<SheetSource> find_sheet(const std::string& wanted, const fs::path& folder) {
    if (is_path(wanted)) {
        const fs::path path(wanted);
        return SheetSource{path.stem().string(), path.is_absolute() ? wanted : (folder / path).string(), {}};
    }
    for (const BuiltInSheet& sheet : built_in_sheets()) {
        if (sheet.name == wanted) return SheetSource{wanted, {}, sheet.text};
    }
    if (wanted.empty()) return std::nullopt;
    for (const fs::path& place : sheet_folders()) {
        const fs::path file = place / (wanted + ".toml");
        std::error_code error;
        if (fs::exists(file, error)) return SheetSource{wanted, file.string(), {}};
    }
    return std::nullopt;
}

std::vector<SheetSource> all_sheets() {
    std::vector<SheetSource> sheets;
    for (const BuiltInSheet& sheet : built_in_sheets()) sheets.push_back({std::string(sheet.name), {}, sheet.text});
    for (const fs::path& place : sheet_folders()) {
        std::vector<SheetSource> here;
        std::error_code error;
        for (fs::directory_iterator at(place, error), end; !error && at != end; at.increment(error)) {
            if (at->path().extension() == ".toml")
                here.push_back({at->path().stem().string(), at->path().string(), {}});
        }
        std::sort(here.begin(), here.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
        for (SheetSource& sheet : here) {
            const auto has_its_name = [&](const SheetSource& other) { return other.name == sheet.name; };
            if (std::none_of(sheets.begin(), sheets.end(), has_its_name)) sheets.push_back(std::move(sheet));
        }
    }
    return sheets;
}

std::string no_such_sheet(const std::string& wanted) {
    std::vector<std::string> names;
    for (const SheetSource& sheet : all_sheets()) names.push_back(sheet.name);
    return "there is no style sheet '" + printable(wanted) + "'" + suggestion_of(wanted, names) +
           "; burin styles lists them, and a file is given with a / or the suffix .toml";
}

StyleSheet read_sheet(const SheetSource& source, const std::vector<Override>& overrides) {
    if (!source.file.empty()) return read_sheet_file(source.file, overrides);
    StyleSheet sheet = read_sheet_text(source.text, name_in_messages(source), overrides);
    sheet.name = source.name;
    return sheet;
}

std::string text_of_sheet(const SheetSource& source) {
    if (source.file.empty()) return std::string(source.text);
    const MappedFile file(source.file);
    return std::string(file.bytes().substr(0, kMaxSheetBytes + 1));  // more is an error where it is read
}

NamedSheetText sheet_text_of(const std::string& text_or_name) {
    if (text_or_name.find('\n') != std::string::npos) return {"style", text_or_name};
    const auto source = find_sheet(text_or_name, {});
    if (!source) throw UsageError(no_such_sheet(text_or_name));
    return {name_in_messages(*source), text_of_sheet(*source)};
}

}  // namespace burin
