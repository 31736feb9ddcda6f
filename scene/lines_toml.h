#pragma once

#include <array>
#include <optional>

#include "scene/scene.h"
#include "scene/toml_reader.h"

// The table [lines] of a scene file is read here.

namespace burin {

LineSettings read_line_settings(TomlReader& lines);

/// Throws for the first key of [lines] that says how lines look: beside a style sheet there must be none.
void refuse_looks_of_lines(const TomlReader& lines);

// Keys that [lines] and style sheets have in common.

/// `crease_angle`: from where to where creases fade in, in degrees; or twice the same.
std::optional<std::array<double, 2>> read_crease_angle(TomlReader& table);
std::optional<PixelFilter> read_pixel_filter(TomlReader& table);

}  // namespace burin
