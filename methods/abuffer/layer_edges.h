#pragma once

#include <vector>

#include "image/image.h"
#include "methods/abuffer/layer_line.h"
#include "methods/abuffer/screen_surfaces.h"
#include "render/frame.h"

namespace burin {

/// All edges of the instances shown that are lines in this view, be they seen or not, as far as they
/// touch `region`: contours, borders that are no seams, and edges with another class asked for. The facing
/// of all triangles must be known.
std::vector<LayerLine> find_layer_edges(const Frame& frame, const ScreenSurfaces& screen, PixelRect region,
                                        int threads);

}  // namespace burin
