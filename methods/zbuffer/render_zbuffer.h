#pragma once

#include <functional>
#include <vector>

#include "methods/zbuffer/zbuffer.h"
#include "render/method.h"

// A method for a z-buffered machine is run over all polygons of a frame, tile by tile.

namespace burin {

/// A method for a z-buffered machine: what it does with each polygon.
struct ZBufferMethod {
    using Step = std::function<void(ZBuffer&, const ProjectedPolygon&)>;

    /// Each goes over all polygons, in the order of the scene, before the next begins.
    std::vector<Step> sweeps;
    bool initial_bit = false;
    /// How the method's edges are moved; highlights are drawn with the same vectors.
    DepthOffset edge_offset;
};

/// Draws the frame. What the film tells about surfaces (distance, normals, numbers, colours without
/// lines) comes from an ordinary z-buffer in double precision beside the method's own.
RenderStats render_zbuffer(const Frame& frame, const RunOptions& options, Film& film, const ZBufferMethod& method);

}  // namespace burin
