#pragma once

#include <string_view>
#include <vector>

#include "render/method.h"

// The SVG of a picture is measured like a method, by another program's pixels of it.

namespace burin {

/// What method abuffer draws as SVG, as rsvg-convert shows it. It is no method of the table: it makes pixels for
/// measuring only. The scene must be prepared by draw_as_paths() when the frame is made.
const Method& svg_method();

/// Has a scene without a style sheet drawn as paths: by the sheet that its line style is, and with what paths are
/// joined by.
void draw_as_paths(Scene& scene);
/// Takes that back.
void draw_as_pixels(Scene& scene);

/// What can be compared: all methods, and SVG behind them.
std::vector<const Method*> compared_methods();

/// nullptr if there is none of that name.
const Method* find_compared_method(std::string_view name);

}  // namespace burin
