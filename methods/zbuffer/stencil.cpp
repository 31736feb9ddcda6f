// The edging plane in OpenGL: the stencil buffer holds the bit. After Herrell, Baldwin, Wilcox,
// "High-Quality Polygon Edging", IEEE Computer Graphics and Applications 15(4), 1995.

#include "methods/zbuffer/methods.h"

namespace burin {
namespace {

// glDepthFunc, glDepthMask, glColorMask; glStencilFunc(func, ref, 1); glStencilOp(fail, zfail,
// pass)
constexpr Pass kStencilFill{.depth_test = DepthTest::less, .reference = true, .on_pass = BitOp::replace};
constexpr Pass kEdgesBeside{.depth_test = DepthTest::less_equal, .bit_test = BitTest::not_equal, .reference = true};
constexpr Pass kEdgesOnFill{.depth_test = DepthTest::always, .bit_test = BitTest::equal, .reference = true};
constexpr Pass kClear{.depth_test = DepthTest::never,
                      .writes_depth = false,
                      .writes_frame = false,
                      .reference = false,
                      .on_depth_fail = BitOp::replace};

}  // namespace

ZBufferMethod stencil_method(const ZBufferSettings&) {
    ZBufferMethod method;
    method.sweeps = {[](ZBuffer& z, const ProjectedPolygon& polygon) {
        z.fill(polygon, kStencilFill);
        z.edges(polygon, kEdgesBeside);
        z.edges(polygon, kEdgesOnFill);
        z.fill(polygon, kClear);
    }};
    return method;
}

}  // namespace burin
