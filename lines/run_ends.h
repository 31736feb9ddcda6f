#pragma once

#include "image/image.h"
#include "lines/line_runs.h"

namespace burin {

/// Finds LineRun::ends. `boundaries`: pieces that are not drawn and only hide what is behind them. A run ends
/// *occluded* where the boundary of a nearer surface passes, or where its chain goes on hidden or seen; at a
/// *corner* where any other line of some length is within half a pixel; at the *frame* where the picture ends.
void find_run_ends(LineRuns& runs, std::span<const LinePiece> boundaries, const Projection& projection,
                   PixelRect picture);

}  // namespace burin
