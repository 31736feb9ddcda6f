#pragma once

#include "compare/render_lines.h"

// A method's frames and the truth's are drawn for a camera that moves by parts of a pixel.

namespace burin {

/// The view of frame j: the camera moved by j / 32 of a pixel along (1, .618), pixels as they are
/// in the middle of the scene.
ComparedView moved_view(const Scene& scene, const ComparedView& view, int j);

/// The part of the picture, at most width x height pixels, with the most line coverage.
PixelRect busiest_part(const Plane& coverage, PixelRect crop, int width, int height);

}  // namespace burin
