#pragma once

#include "scene/scene.h"
#include "shading/sheet/style_sheet.h"

namespace burin {

/// The style sheet that draws what a scene's line style draws, for what draws by sheets alone: a set for visible lines
/// and one for hidden ones, or one for the lines of each colour. It says nothing of how lines are found.
StyleSheet plain_sheet(const LineSettings& lines);

}  // namespace burin
