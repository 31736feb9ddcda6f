#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "methods/explained_line.h"
#include "shading/ink/inked_lines.h"
#include "shading/ink/line_columns.h"

namespace burin {

/// A line near a pixel that leaves no ink in it.
struct UndrawnLine : ExplainedLine {
    std::string set, style;           ///< that takes it; empty: none does
    std::vector<RefusedSet> refused;  ///< the sets that do not, if none does
    std::string reason;               ///< the first one why there is no ink of it
    double distance_px = 0;           ///< from the middle of the pixel
    bool is_asked = true;             ///< some set asks for its class
};

/// What a frame with a style sheet draws.
struct DrawnLines {
    const LineColumns& columns;  ///< of all variables
    const SetMatches& matches;
    const InkedLines& inked;
};

/// The lines that pass a pixel within two pixels, or within half of their width, and of which no ink is in it: those
/// that sets take first, hidden ones of classes that no set asks for last, else visible ones first, then the nearest.
/// It looks for lines of all classes, behind any number of surfaces. `inked`: the numbers of sets, and of the runs that
/// these have drawn in the pixel.
std::vector<UndrawnLine> undrawn_lines(const Frame& frame, const DrawnLines& drawn, int x, int y,
                                       const std::set<std::pair<std::uint32_t, std::uint32_t>>& inked, int threads);

}  // namespace burin
