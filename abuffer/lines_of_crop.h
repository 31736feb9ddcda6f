#pragma once

#include "render/frame.h"
#include "shading/dash_style.h"

namespace burin {

/// The pixels whose lines must be known to draw a frame's crop. Dashes begin where their chain begins, and
/// contours that are moved may come from beside: both need the whole picture, so that a crop shows what
/// the whole shows there.
inline bool needs_all_visible_lines(const Frame& frame) {
    const LineSettings& lines = frame.scene->lines;
    return visible_dashes(lines.style).dash_px.has_value() || lines.contours == Contours::smooth;
}
inline PixelRect rect_with_lines(const Frame& frame) {
    return needs_all_visible_lines(frame) ? PixelRect{0, 0, frame.width, frame.height} : frame.crop;
}

}  // namespace burin
