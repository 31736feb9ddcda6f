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

}  // namespace burin
