#pragma once

#include "render/method.h"

// Method `gbuffer` finds lines by operators on images, which know no mesh.

namespace burin {

/// Lines from images of depth, normal and numbers: Takafumi Saito and Tokiichiro Takahashi,
/// "Comprehensible Rendering of 3-D Shapes", SIGGRAPH 1990, and its descendants. The scene's
/// GBufferSettings choose the operators; docs/methods/gbuffer.md describes them.
RenderStats render_gbuffer(const Frame& frame, const RunOptions& options, Film& film);

/// Boundaries that it draws under another class's name: a border is a jump of depth like a
/// silhouette; an intersection bends depth, and separates numbers, as creases and borders of objects
/// and polygons do.
LineClassSet gbuffer_also_finds(LineClassSet asked);

/// The width of horizontal and vertical lines of the operators asked for, which is at least two
/// samples (one for Roberts' cross and one-sided comparisons). In other directions lines are up to
/// sqrt(2) wider or narrower.
double gbuffer_line_width_px(const Scene& scene);

}  // namespace burin
