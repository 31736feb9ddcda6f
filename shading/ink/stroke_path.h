#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "shading/ink/inked_lines.h"

// The path of a stroke is moved, lengthened and cut.

namespace burin {

/// A point of a path: its ink, where it stands along its chain, and on which piece the way to the next point lies.
struct PathPoint {
    InkPoint ink;
    double at_px = 0;
    std::uint32_t piece = 0;  ///< in LineRuns
    bool ends_piece = false;  ///< the way to the next point is one between pieces
};
using StrokePath = std::vector<PathPoint>;

/// Makes an end of a path longer, straight on, or shorter if `px` is negative. Nothing is left of a path shorter than
/// that.
void lengthen_end(StrokePath& path, bool is_first, double px);

/// Makes width and opacity of each point their means over a length of `px` to either side along the path.
void smooth_ink(StrokePath& path, double px, bool is_closed);

/// A pattern of dashes along chains.
struct DashPattern {
    std::vector<double> lengths_px;  ///< on, off, on, off ...: an even number
    double phase_px = 0;
    bool has_round_caps = true;  ///< a dash includes the round ends of its pen

    double period_px() const;
    /// Shorter periods cannot be seen.
    static constexpr double kShortestPeriodPx = 0.5;
    /// The share of a line that is drawn.
    double share() const;
};

/// What lengths of a pattern are multiplied by, so that it has no seam where a chain is a loop of this length; 0: it is
/// none.
double dash_scale(const DashPattern& pattern, double loop_px);

/// Calls visit(dash) for the dashes of a path, each of them a path of its own. `loop_px`: the length of the chain if it
/// is a loop, on which the pattern is stretched or squeezed so that there is no seam; else 0. A dash no longer than the
/// pen is wide is a dot.
void for_dashes(const StrokePath& path, const DashPattern& pattern, double loop_px,
                const std::function<void(const StrokePath&)>& visit);

}  // namespace burin
