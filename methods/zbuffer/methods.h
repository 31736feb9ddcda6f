#pragma once

#include "methods/zbuffer/render_zbuffer.h"

// Methods for z-buffered machines are put together from passes.

namespace burin {

// Lines over surfaces on a z-buffered machine, polygon edges as vectors. Each has a file that lists
// its passes, and a page in docs/methods/.
ZBufferMethod simple_method(const ZBufferSettings& settings);
ZBufferMethod offset_method(const ZBufferSettings& settings);
ZBufferMethod slope_offset_method(const ZBufferSettings& settings);
ZBufferMethod decal_method(const ZBufferSettings& settings);
ZBufferMethod edging_plane_method(const ZBufferSettings& settings);
ZBufferMethod virgin_plane_method(const ZBufferSettings& settings);
ZBufferMethod stencil_method(const ZBufferSettings& settings);

/// Fills, then edges, moved apart in z.
ZBufferMethod offset_edging(DepthOffset offset, DepthAdjust adjust);

/// One of them as a method of the table.
template <ZBufferMethod (*kMethod)(const ZBufferSettings&)>
RenderStats render_with(const Frame& frame, const RunOptions& options, Film& film) {
    return render_zbuffer(frame, options, film, kMethod(frame.scene->zbuffer));
}

}  // namespace burin
