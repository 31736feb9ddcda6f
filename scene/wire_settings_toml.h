#pragma once

#include "scene/toml_reader.h"
#include "scene/wire_settings.h"

namespace burin {

/// The table [wire] of a scene file.
WireSettings read_wire_settings(TomlReader& t);

}  // namespace burin
