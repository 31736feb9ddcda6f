#pragma once

#include "render/method.h"

// Method `reference` stands for the truth: it draws lines by rays and shares no code with the rasterizers.

namespace burin {

/// Ground truth by rays, sharing no code with the rasterizers: n x n rays per pixel decide what is
/// visible, further rays where exactly the lines between them are, and the exact distance to these
/// lines gives the coverage of strokes of any width. docs/methods/reference.md says how.
///
/// n is Scene::reference.samples.
RenderStats render_reference(const Frame& frame, const RunOptions& options, Film& film);

}  // namespace burin
