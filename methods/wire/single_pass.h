#pragma once

#include "render/method.h"

// The methods `single-pass` and `solid-wireframe` fill triangles once, with lines along their edges.

namespace burin {

/// Single-pass wireframe rendering, J. A. Baerentzen, S. L. Nielsen, M. Gjoel, B. D. Larsen and
/// N. J. Christensen, SIGGRAPH 2006 sketch: surfaces are filled once, and each pixel's distance to
/// the nearest edge of its polygon makes the line (docs/methods/single-pass.md).
RenderStats render_single_pass(const Frame& frame, const RunOptions& options, Film& film);

/// Single-pass wireframe rendering after S. Gateau, Solid Wireframe, NVIDIA white paper WP-03014-001, 2007: another
/// profile, triangles with corners behind the eye by a table of cases, and diagonals of quadrilaterals left out or
/// dotted (docs/methods/solid-wireframe.md).
RenderStats render_solid_wireframe(const Frame& frame, const RunOptions& options, Film& film);

}  // namespace burin
