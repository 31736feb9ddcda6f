#pragma once

#include "scene/scene_description.h"
#include "scene/toml_reader.h"

namespace burin {

/// Puts an override of --set style.… into the tables of a sheet. Throws UsageError where the sheet has no such value.
void apply_sheet_override(toml::table& root, const Override& o);

}  // namespace burin
