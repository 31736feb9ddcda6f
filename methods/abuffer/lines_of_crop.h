#pragma once

#include "render/frame.h"

namespace burin {

/// The pixels whose lines must be known to draw a frame's crop. Dashes begin where their chain begins, and
/// contours that are moved may come from beside: both need the whole picture, so that a crop shows what
/// the whole shows there.
inline PixelRect rect_with_lines(const Frame& frame) {
    const LineSettings& lines = frame.scene->lines;
    const bool needs_all = lines.style.dash_px.has_value() || lines.contours == Contours::smooth;
    return needs_all ? PixelRect{0, 0, frame.width, frame.height} : frame.crop;
}

}  // namespace burin
