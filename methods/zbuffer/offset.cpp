// Constant depth offset: as simple edging, but edges are moved nearer by a constant. "z-adjust" in
// Herrell, Baldwin, Wilcox, "High-Quality Polygon Edging", IEEE Computer Graphics and Applications
// 15(4), 1995.

#include "methods/zbuffer/methods.h"

namespace burin {
namespace {

constexpr Pass kOffsetFill{.depth_test = DepthTest::less};
constexpr Pass kOffsetEdges{.depth_test = DepthTest::less_equal};

}  // namespace

ZBufferMethod offset_edging(DepthOffset offset, DepthAdjust adjust) {
    const bool moves_fills = adjust == DepthAdjust::fills;
    offset.sign = moves_fills ? 1 : -1;
    const DepthOffset of_fills = moves_fills ? offset : DepthOffset{};
    const DepthOffset of_edges = moves_fills ? DepthOffset{} : offset;
    ZBufferMethod method;
    method.sweeps = {
        [=](ZBuffer& z, const ProjectedPolygon& polygon) { z.fill(polygon, kOffsetFill, of_fills); },
        [=](ZBuffer& z, const ProjectedPolygon& polygon) { z.edges(polygon, kOffsetEdges, of_edges); },
    };
    method.edge_offset = of_edges;
    return method;
}

ZBufferMethod offset_method(const ZBufferSettings& settings) {
    DepthOffset offset;
    offset.constant = settings.eps;
    return offset_edging(offset, settings.adjust.value_or(DepthAdjust::edges));
}

}  // namespace burin
