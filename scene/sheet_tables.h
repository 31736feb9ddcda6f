#pragma once

#include <string_view>

#include "scene/scene_description.h"
#include "scene/toml_reader.h"

namespace burin {

/// Keys at the top of a sheet that are no tables, and tables there.
constexpr std::string_view kSheetKeys[] = {"style_version", "summary", "crease_angle", "contours", "filter", "light"};
constexpr std::string_view kSheetTables[] = {"surfaces", "parameters", "groups", "let", "ramp", "set", "style"};

/// Puts an override of --set style.… into the tables of a sheet. Throws UsageError where the sheet has no such value.
void apply_sheet_override(toml::table& root, const Override& o);

}  // namespace burin
