#pragma once

#include <string>

#include "scene/toml_reader.h"

namespace burin {

/// Tables or a value as a TOML file has them, which reads back as the same. Only the sources that write scene files
/// include this header.
std::string text_of_toml(const toml::node& node);

}  // namespace burin
