#pragma once

#include "scene/gbuffer_settings.h"
#include "scene/toml_reader.h"

// The settings of method `gbuffer` are read from a scene file.

namespace burin {

/// The table [gbuffer] of a scene file.
GBufferSettings read_gbuffer(TomlReader& t);

}  // namespace burin
