// Decal edging: a polygon's edges are drawn before its fill is in the z-buffer, so they never meet
// it. Herrell, Baldwin, Wilcox, "High-Quality Polygon Edging", IEEE Computer Graphics and
// Applications 15(4), 1995.

#include "methods/zbuffer/methods.h"

namespace burin {
namespace {

constexpr Pass kColorOfFill{.depth_test = DepthTest::less, .writes_depth = false};
constexpr Pass kDecalEdges{.depth_test = DepthTest::less_equal};
constexpr Pass kDepthOfFill{.depth_test = DepthTest::less, .writes_frame = false};

}  // namespace

ZBufferMethod decal_method(const ZBufferSettings&) {
    ZBufferMethod method;
    method.sweeps = {[](ZBuffer& z, const ProjectedPolygon& polygon) {
        z.fill(polygon, kColorOfFill);
        z.edges(polygon, kDecalEdges);
        z.fill(polygon, kDepthOfFill);
    }};
    return method;
}

}  // namespace burin
