#pragma once

#include <string>
#include <vector>

#include "lines/line_drawing.h"
#include "render/frame.h"
#include "shading/ink/found_lines.h"
#include "shading/ink/inked_lines.h"

namespace burin {

/// All that line shading reads of a picture's lines. `drawing`: with what the frame's needs ask for.
FoundLines found_lines(LineDrawing drawing, const Frame& frame, int threads);

/// Makes ink of the lines of a picture, as the frame's style sheet says. `notes`: gets what users should know.
InkedLines shaded_lines(LineDrawing drawing, const Frame& frame, int threads, std::vector<std::string>& notes);

}  // namespace burin
