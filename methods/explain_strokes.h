#pragma once

#include <string>

#include "render/frame.h"

namespace burin {

/// What a frame's style sheet draws in one pixel, stroke by stroke from the top: which line set took the line and why
/// earlier ones did not, the style, whose line it is, how much of the pixel it covers and how much of that is seen, and
/// the values of the style there with the variables that they read.
std::string explain_strokes(const Frame& frame, int x, int y);

}  // namespace burin
