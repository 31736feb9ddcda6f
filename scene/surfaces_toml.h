#pragma once

#include <vector>

#include "scene/toml_reader.h"
#include "shading/surface/light.h"
#include "shading/surface_shader.h"

namespace burin {

/// Reads the table [surfaces]: how surfaces are filled. Throws InputError with line and column, or UsageError for a
/// value of the command line.
SurfaceStyle read_surfaces(TomlReader& table);

/// Reads the tables [[light]] of a scene; throws the same.
std::vector<SceneLight> read_lights(TomlReader& root);

}  // namespace burin
