#pragma once

#include "scene/toml_reader.h"
#include "scene/wire_settings.h"

// The settings of the wireframe methods are read from a scene file.

namespace burin {

/// The table [wire] of a scene file.
WireSettings read_wire_settings(TomlReader& t);

}  // namespace burin
