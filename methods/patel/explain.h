#pragma once

#include <string>

#include "render/frame.h"

// `burin explain` prints what method `patel` saw in one pixel.

namespace burin {

/// How method patel sees one pixel: its fragments front to back with their masks as pictures, depths,
/// owners and planes, and for every pair of neighbours which test drew or refused the line.
std::string explain_pixel(const Frame& frame, int x, int y);

/// What lines method abuffer draws in the pixel, class by class: it decides on fewer samples and knows more than them.
std::string drawn_by_abuffer(const Frame& frame, int x, int y);

}  // namespace burin
