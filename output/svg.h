#pragma once

#include <string>

#include "base/byte_sink.h"
#include "output/paths/vector_drawing.h"

namespace burin {

struct SvgOptions {
    bool has_names = true;  ///< ids and data-* of paths; layers always have them
    std::string fingerprint = {};
};

/// Writes an SVG 1.1 file: layers of Inkscape for hidden and visible lines, in them groups, in these paths. Sizes are
/// in mm, places in pixels, rounded to 1/100. Equal drawings give equal bytes.
std::string svg_of(const VectorDrawing& drawing, const SvgOptions& options = {});

}  // namespace burin
