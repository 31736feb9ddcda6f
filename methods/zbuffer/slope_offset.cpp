// Slope-dependent depth offset: as simple edging, but fills are moved away by their own slope.
// glPolygonOffset, OpenGL 1.1, 1997; a pixel's worth of slope (factor 1) is what an edge and a fill
// can differ by at the corner of a pixel.

#include "methods/zbuffer/methods.h"

namespace burin {

ZBufferMethod slope_offset_method(const ZBufferSettings& settings) {
    DepthOffset offset;
    offset.factor = settings.factor;
    offset.units = settings.units;
    offset.limit = settings.clamp.value_or(1);
    return offset_edging(offset, settings.adjust.value_or(DepthAdjust::fills));
}

}  // namespace burin
