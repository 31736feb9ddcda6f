#pragma once

#include <string>
#include <string_view>

#include "scene/toml_reader.h"

// A TOML text becomes tables, with a limit on how deep they are nested.

namespace burin {

/// The tables of a TOML text, which may be long: throws Interrupted soon after the user asks the
/// program to stop, and toml::parse_error for what is no TOML. `path` is named as the place of
/// everything in it.
toml::table parse_toml(std::string_view text, const std::string& path);

/// The same with all that is wrong thrown as InputError: a text that is longer than `most_bytes`, nested too deeply, or
/// no TOML. `what`: "a scene file". `most_values`: 0 is no limit; see line_with_too_many_values().
toml::table parse_checked_toml(std::string_view text, const std::string& path, const std::string& what,
                               std::size_t most_bytes, std::size_t most_values = 0);

}  // namespace burin
