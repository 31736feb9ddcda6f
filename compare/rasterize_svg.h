#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "output/paths/vector_drawing.h"

// An independent program, rsvg-convert of librsvg, draws vector files as pixels.

namespace burin {

/// The path of rsvg-convert; empty if it is not installed.
std::string find_svg_rasterizer();

/// Colours of the pixels of `drawing.crop`, row by row: linear, premultiplied; a = coverage.
///
/// The drawing is written as SVG without paper and drawn with 4 x 4 times as many pixels; what is kept is the mean of
/// these. Alpha is never encoded, so coverage is what it is, though SVG blends in sRGB. Large pictures are drawn in
/// parts. The files lie in a temporary folder that is removed. Throws InputError.
std::vector<glm::vec4> rasterize_svg(VectorDrawing drawing, const std::string& rasterizer);

}  // namespace burin
