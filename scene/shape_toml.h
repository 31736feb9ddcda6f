#pragma once

#include "mesh/shapes.h"
#include "scene/toml_reader.h"

// The built-in shapes of a scene file are read here.

namespace burin {

/// The built-in shape that a table [[object]] asks for with `shape` and its settings. It is not
/// made yet: a few words may ask for millions of polygons.
Shape read_shape(TomlReader& t);

}  // namespace burin
