#pragma once

#include <vector>

#include "lines/line_segment.h"

namespace burin {

/// Joins pieces of one line and block that continue each other, as far as they lie on one straight line to
/// within 1/2048 pixel: strokes of long pieces are drawn faster than those of many short ones.
void merge_segments(std::vector<LineSegment>& segments);

}  // namespace burin
