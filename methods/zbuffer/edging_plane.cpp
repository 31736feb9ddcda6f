// The edging plane: one bit per pixel says where the polygon was just filled; there its edges win
// whatever their z. Herrell, Baldwin, Wilcox, "High-Quality Polygon Edging", IEEE Computer Graphics
// and Applications 15(4), 1995, software form.

#include "methods/zbuffer/methods.h"

namespace burin {
namespace {

constexpr Pass kEdgingPlaneFill{.depth_test = DepthTest::less, .reference = true, .on_pass = BitOp::replace};
constexpr Pass kEdgingPlaneEdges{.depth_test = DepthTest::less_equal, .bit_passes_depth = true};

}  // namespace

ZBufferMethod edging_plane_method(const ZBufferSettings&) {
    ZBufferMethod method;
    method.sweeps = {[](ZBuffer& z, const ProjectedPolygon& polygon) {
        z.fill(polygon, kEdgingPlaneFill);
        z.edges(polygon, kEdgingPlaneEdges);
        z.set_bits_of_box(polygon, false);
    }};
    return method;
}

}  // namespace burin
