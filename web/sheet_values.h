#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace burin {

/// The text of a style sheet in which values have changed, as --set style.KEY=VALUE changes them: where these are
/// parameters, nothing else of the text does. Throws InputError and UsageError.
std::string sheet_with_values(std::string text, const std::vector<std::pair<std::string, std::string>>& values);

/// "KEY = …" with a text of several lines, as a TOML file has it.
std::string text_in_toml(const std::string& key, const std::string& text);

}  // namespace burin
