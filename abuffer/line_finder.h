#pragma once

#include <cstddef>
#include <cstdint>

#include "lines/line_drawing.h"
#include "render/film.h"
#include "render/frame.h"
#include "render/method.h"
#include "render/row_sink.h"
#include "render/stats.h"

namespace burin {

/// Finds what a frame shows: surfaces go into the film, lines into the drawing, as far as the frame's needs ask for
/// them. Rows of tiles are found from the top; under a cap for memory, slice by slice.
///
/// `sink`: is told how far rows are found, so that it can draw them meanwhile; then pieces that it needs no more may be
/// forgotten. nullptr: the drawing keeps all. Adds the times of its stages to `stats`.
void find_lines(const Frame& frame, const RunOptions& options, Film& film, LineDrawing& drawing, RowSink* sink,
                RenderStats& stats);

/// In how many slices find_lines() finds a frame under a cap for memory (0: none), and the least cap that it takes.
struct SliceCount {
    std::size_t slices = 1;
    std::uint64_t least_bytes = 0;
};
/// Looks at all triangles. Throws LimitError if the cap is less than that.
SliceCount count_slices(const Frame& frame, std::uint64_t cap_bytes, int threads);

}  // namespace burin
