// Simple edging: fills, then edges over them. Herrell, Baldwin, Wilcox, "High-Quality Polygon
// Edging", IEEE Computer Graphics and Applications 15(4), 1995, as the state of the art that they
// improve on.

#include "methods/zbuffer/methods.h"

namespace burin {
namespace {

constexpr Pass kSimpleFill{.depth_test = DepthTest::less};
constexpr Pass kSimpleEdges{.depth_test = DepthTest::less_equal};

}  // namespace

ZBufferMethod simple_method(const ZBufferSettings&) {
    ZBufferMethod method;
    method.sweeps = {
        [](ZBuffer& z, const ProjectedPolygon& polygon) { z.fill(polygon, kSimpleFill); },
        [](ZBuffer& z, const ProjectedPolygon& polygon) { z.edges(polygon, kSimpleEdges); },
    };
    return method;
}

}  // namespace burin
