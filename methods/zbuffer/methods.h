#pragma once

#include "render/method.h"

namespace burin {

// Lines over surfaces on a z-buffered machine, polygon edges as vectors. docs/methods/ has a page for
// each. Settings: ZBufferSettings.
RenderStats render_simple(const Frame& frame, const RunOptions& options, Film& film);
RenderStats render_offset(const Frame& frame, const RunOptions& options, Film& film);
RenderStats render_slope_offset(const Frame& frame, const RunOptions& options, Film& film);
RenderStats render_decal(const Frame& frame, const RunOptions& options, Film& film);
RenderStats render_edging_plane(const Frame& frame, const RunOptions& options, Film& film);
RenderStats render_virgin_plane(const Frame& frame, const RunOptions& options, Film& film);
RenderStats render_stencil(const Frame& frame, const RunOptions& options, Film& film);

}  // namespace burin
