#pragma once

#include "lines/line_drawing.h"
#include "render/frame.h"
#include "shading/ink/found_lines.h"

namespace burin {

struct StyleSheet;

/// All that line shading reads of a picture's lines. `drawing`: with what the frame's needs ask for.
FoundLines found_lines(LineDrawing drawing, const Frame& frame, int threads);

/// Throws InputError if lines were found for another sheet and this one needs more.
void require_lines_for(const StyleSheet& sheet, const CompiledSheet& compiled, const FoundLines& lines);

}  // namespace burin
