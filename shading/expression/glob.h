#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace burin {

/// Whether a name is what a pattern says: '*' stands for any characters, '?' for one byte, all others for themselves.
/// Takes at most their lengths' product in steps.
bool matches_glob(std::string_view pattern, std::string_view name);

/// Whether a list of patterns takes a name. It is read from left to right: a pattern adds names, one that begins with
/// '!' takes names away. A list that begins with '!' begins with all names.
bool matches_globs(const std::vector<std::string>& patterns, std::string_view name);

}  // namespace burin
