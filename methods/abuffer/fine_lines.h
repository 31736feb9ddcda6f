#pragma once

#include <vector>

#include "lines/line_segment.h"
#include "methods/abuffer/fine_parts.h"
#include "render/frame.h"

namespace burin {

/// The lines that samples miss: features thinner than a sample, and meshes with several triangles to a
/// sample. Of `parts`, list by list, those that are lines are clipped against all triangles in front of
/// them; what is visible is returned, in one order for any number of threads.
std::vector<LineSegment> find_fine_lines(const Frame& frame, const ScreenSurfaces& screen,
                                         const TileKernels& kernels, PixelRect region,
                                         const std::vector<std::vector<FinePart>>& parts, int threads);

}  // namespace burin
