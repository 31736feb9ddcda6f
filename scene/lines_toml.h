#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/toml_reader.h"
#include "shading/sheet/style_sheet.h"

// The table [lines] of a scene file is read here.

namespace burin {

LineSettings read_line_settings(TomlReader& lines);

/// The keys of [lines] that nothing reads beside a style sheet. Those that say how lines look are errors, which name
/// the key of the sheet that says it, unless `may_have_looks`.
std::vector<std::string> keys_beside_sheet(const TomlReader& lines, const StyleSheet& sheet, bool may_have_looks);

// Keys that [lines] and style sheets have in common.

/// `crease_angle`: from where to where creases fade in, in degrees; or twice the same.
std::optional<std::array<double, 2>> read_crease_angle(TomlReader& table);
std::optional<PixelFilter> read_pixel_filter(TomlReader& table);

}  // namespace burin
