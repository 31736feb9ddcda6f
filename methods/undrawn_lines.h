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
    std::string reason;               ///< why it leaves no ink: the first one, in the order of work
    double distance_px = 0;           ///< from the middle of the pixel
    bool is_asked = true;             ///< some set asks for its class
};

/// What a frame with a style sheet draws.
struct DrawnLines {
    const LineColumns& columns;  ///< of all variables
    const SetMatches& matches;
    const InkedLines& inked;
};

/// Finds lines of all classes, behind any number of surfaces, that pass the middle of a pixel within two pixels, or
/// within half of their width, and leave no ink in it. Lines that some set takes come first, hidden lines whose class
/// no set asks for come last, and the other ones between them; within each group those with the fewest surfaces in
/// front come first, and of these the nearest. `inked`: pairs of a set and a run, by number, that have ink in the
/// pixel; they are left out.
std::vector<UndrawnLine> undrawn_lines(const Frame& frame, const DrawnLines& drawn, int x, int y,
                                       const std::set<std::pair<std::uint32_t, std::uint32_t>>& inked, int threads);

}  // namespace burin
