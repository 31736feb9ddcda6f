#pragma once

#include "scene/method_settings.h"
#include "shading/line_style.h"

// Settings of a scene say how masks become strokes.

namespace burin {

/// How strokes are made from masks.
struct MaskStroke {
    HaloShape shape = HaloShape::four;
    StrokeSide side = StrokeSide::both;
};

}  // namespace burin
