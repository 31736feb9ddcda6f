#pragma once

#include "image/image.h"
#include "lines/line_runs.h"

namespace burin {

/// Finds LineRun::ends and gaps. `boundaries`: pieces that are not drawn and only hide what is behind them.
/// A run ends *occluded* where the boundary of a nearer surface passes, or where its chain goes on hidden or seen; at a
/// *corner* where any other line of some length is within half a pixel, which for a visible run is a visible one; at
/// the *frame* where the picture ends. Gaps are those to the nearest line or boundary that would stop the run if it
/// came closer, so that what depends on them changes little when a line breaks by a hair. `only_hidden`: ends of
/// visible runs are not asked for.
void find_run_ends(LineRuns& runs, std::span<const LinePiece> boundaries, const Projection& projection,
                   PixelRect picture, int threads, bool only_hidden = false);

/// Leaves out runs shorter than 1/16 pixel that lie on longer ones of the same class, all seen or all hidden as they
/// are: hairs, as lie where pieces of contours meet. They would be dots in the gaps of dashes, and where tapers end.
/// `only_hidden`: visible ones stay.
void leave_out_hairs(LineRuns& runs, PixelRect picture, bool only_hidden = false);

}  // namespace burin
