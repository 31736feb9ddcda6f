#pragma once

#include "render/method.h"

namespace burin {

/// Lines from images of depth, normal and numbers: Takafumi Saito and Tokiichiro Takahashi,
/// "Comprehensible Rendering of 3-D Shapes", SIGGRAPH 1990, and its descendants. The scene's
/// GBufferSettings choose the operators; docs/methods/gbuffer.md describes them.
RenderStats render_gbuffer(const Frame& frame, const RunOptions& options, Film& film);

/// The width of lines of the operators asked for, which is at least two samples (one for Roberts'
/// cross and one-sided comparisons).
double gbuffer_line_width_px(const Scene& scene);

}  // namespace burin
