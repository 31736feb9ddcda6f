#pragma once

#include "scene/shutter.h"
#include "scene/toml_reader.h"

namespace burin {

/// [shutter].
ShutterSettings read_shutter(TomlReader& table);

}  // namespace burin
