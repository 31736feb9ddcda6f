// Depth offsets: everything as in simple edging, but fills and edges are moved apart in z, by a
// constant (z-adjust in Herrell, Baldwin, Wilcox 1995) or with the polygon's slope (glPolygonOffset,
// OpenGL 1.1).

#include "methods/zbuffer/methods.h"
#include "methods/zbuffer/render_zbuffer.h"

namespace burin {
namespace {

constexpr Pass kFill{.depth_test = DepthTest::less};
constexpr Pass kEdges{.depth_test = DepthTest::less_equal};

RenderStats render_with(const Frame& frame, const RunOptions& options, Film& film, DepthOffset offset,
                        DepthAdjust adjust) {
    const bool moves_fills = adjust == DepthAdjust::fills;
    offset.sign = moves_fills ? 1 : -1;
    const DepthOffset of_fills = moves_fills ? offset : DepthOffset{};
    const DepthOffset of_edges = moves_fills ? DepthOffset{} : offset;
    ZBufferMethod method;
    method.sweeps = {
        [=](ZBuffer& z, const ProjectedPolygon& polygon) { z.fill(polygon, kFill, of_fills); },
        [=](ZBuffer& z, const ProjectedPolygon& polygon) { z.edges(polygon, kEdges, of_edges); },
    };
    method.edge_offset = of_edges;
    return render_zbuffer(frame, options, film, method);
}

}  // namespace

RenderStats render_offset(const Frame& frame, const RunOptions& options, Film& film) {
    const ZBufferSettings& settings = frame.scene->zbuffer;
    DepthOffset offset;
    offset.constant = settings.eps;
    return render_with(frame, options, film, offset, settings.adjust.value_or(DepthAdjust::edges));
}

RenderStats render_slope_offset(const Frame& frame, const RunOptions& options, Film& film) {
    const ZBufferSettings& settings = frame.scene->zbuffer;
    DepthOffset offset;
    offset.factor = settings.factor;
    offset.units = settings.units;
    offset.limit = settings.clamp.value_or(1);
    return render_with(frame, options, film, offset, settings.adjust.value_or(DepthAdjust::fills));
}

}  // namespace burin
