#pragma once

#include "output/paths/path_lines.h"

namespace burin {

/// Takes away what is drawn twice. Longer lines stay of those that lie as high, and higher ones of others:
///
///  - a line shorter than a pixel goes where the ink of longer ones covers it;
///  - where a line runs within 1/4 pixel along another one for more than 1.5 pixels, that part is cut out of it.
///
/// What covers is opaque and at least as wide, and solid or of the same style. A pattern of dashes covers the same one
/// of its colour, wherever that begins and however it is stretched, if it is as wide and not fainter. A hidden line
/// right behind a visible one goes, too. `area`: where lines are.
PathLines cleaned_paths(const PathLines& lines, PixelRect area);

}  // namespace burin
