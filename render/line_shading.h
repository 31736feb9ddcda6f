#pragma once

#include <string>
#include <vector>

#include "lines/line_drawing.h"
#include "render/frame.h"
#include "shading/ink/inked_lines.h"

namespace burin {

/// Makes ink of all lines of a picture, as the frame's style sheet says. `found`: with what the frame's needs ask for.
/// `warnings`: gets what users should know.
InkedLines shaded_lines(LineDrawing found, const Frame& frame, int threads, std::vector<std::string>& warnings);

}  // namespace burin
