#pragma once

#include "lines/line_drawing.h"
#include "render/frame.h"

namespace burin {

/// Lays out lines as the look of a frame's scene wants them on the screen: contours of smooth surfaces are moved to
/// where they are smooth, and lines are cut into dashes. `found`: all lines of the picture, with what the frame's needs
/// ask for. Nothing has to be laid out where DrawingNeeds::rows_stand_alone().
LineDrawing laid_out(LineDrawing found, const Frame& frame, int threads);

}  // namespace burin
