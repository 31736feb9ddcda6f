#pragma once

#include "lines/line_drawing.h"
#include "render/frame.h"
#include "shading/ink/found_lines.h"

namespace burin {

/// All that line shading reads of a picture's lines. `drawing`: with what the frame's needs ask for.
FoundLines found_lines(LineDrawing drawing, const Frame& frame, int threads);

}  // namespace burin
