// The edging plane in hardware: the virgin bit, which a fast clear of the z-buffer sets and where z
// is not looked at, is borrowed. Herrell, Baldwin, Wilcox, "High-Quality Polygon Edging", IEEE
// Computer Graphics and Applications 15(4), 1995, hardware form.
//
// After the first pass no pixel of the fill is truly virgin, so the bit is free there. An edge may
// also fall on a truly virgin pixel beside the fill, whose z must count from then on: a write of z
// by an edge makes the pixel an ordinary one.

#include "methods/zbuffer/methods.h"

namespace burin {
namespace {

constexpr Pass kVirginPlaneFill{
    .depth_test = DepthTest::less, .reference = true, .on_pass = BitOp::replace, .bit_passes_depth = true};
constexpr Pass kVirginPlaneEdges{
    .depth_test = DepthTest::less_equal, .reference = false, .on_pass = BitOp::replace, .bit_passes_depth = true};
constexpr Pass kGiveBack{.depth_test = DepthTest::always,
                         .writes_depth = false,
                         .writes_frame = false,
                         .reference = false,
                         .on_pass = BitOp::replace};

}  // namespace

ZBufferMethod virgin_plane_method(const ZBufferSettings&) {
    ZBufferMethod method;
    method.initial_bit = true;
    method.sweeps = {[](ZBuffer& z, const ProjectedPolygon& polygon) {
        z.fill(polygon, kVirginPlaneFill);
        z.edges(polygon, kVirginPlaneEdges);
        z.fill(polygon, kGiveBack);
    }};
    return method;
}

}  // namespace burin
