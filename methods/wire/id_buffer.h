#pragma once

#include "render/method.h"

// Method `id-buffer` draws strokes over an image of polygon numbers, which tells which pixels a stroke may cover.

namespace burin {

/// The ID buffer method of J. A. Baerentzen, S. L. Nielsen, M. Gjoel and B. D. Larsen, "Two Methods
/// for Antialiased Wireframe Drawing with Hidden Line Removal", 2008: polygons are drawn as
/// numbers, then each edge of each polygon as a wide screen-aligned stroke that its own polygon's
/// pixels let through (docs/methods/id-buffer.md). Polygons may have any shape.
///
/// Throws InputError for 2^24 polygons or more, which the buffer's 24 bits cannot tell apart.
RenderStats render_id_buffer(const Frame& frame, const RunOptions& options, Film& film);

}  // namespace burin
