#pragma once

#include "render/film.h"
#include "render/frame.h"
#include "shading/ink/inked_lines.h"

namespace burin {

/// Draws lines with their looks over a film that has the surfaces of the frame's crop, on `threads` threads. Every
/// pixel of the result depends on nothing but the strokes that reach it: not on threads, tiles, the crop, or the order
/// of the strokes.
void draw_ink(const Frame& frame, const InkedLines& lines, int threads, Film& film);

}  // namespace burin
