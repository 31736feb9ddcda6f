#pragma once

#include "lines/line_drawing.h"
#include "render/frame.h"

namespace burin {

/// Lines as the look of a frame's scene wants them on the screen: contours of smooth surfaces moved to where they are
/// smooth, and lines cut into dashes. `found`: all of the picture's, with what the frame's needs ask for. Where
/// DrawingNeeds::rows_stand_alone(), nothing has to be laid out.
LineDrawing laid_out(LineDrawing found, const Frame& frame, int threads);

}  // namespace burin
