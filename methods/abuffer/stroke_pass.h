#pragma once

#include <vector>

#include "abuffer/tile_kernels.h"
#include "lines/line_segment.h"
#include "render/film.h"
#include "render/frame.h"

namespace burin {

/// Draws pieces of lines as strokes over a part of a film.
void draw_strokes(const Frame& frame, PixelRect part, const std::vector<std::vector<LineSegment>>& segments,
                  const TileKernels& kernels, int threads, Film& film);

}  // namespace burin
