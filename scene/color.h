#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>

// Colours of scene files are read here.

namespace burin {

/// A colour typed as "#rgb" or "#rrggbb" (sRGB), in linear RGB; nothing if it is no such text.
std::optional<glm::vec3> color_from_hex(std::string_view text);

}  // namespace burin
