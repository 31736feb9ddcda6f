#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "image/image.h"
#include "lines/line_drawing.h"
#include "lines/piece_chains.h"
#include "lines/whole_line.h"
#include "view/surface_set.h"

// Line shading draws runs: what the eye follows as one line.

namespace burin {

/// What stops a run at one of its ends.
enum class RunEnd : std::uint8_t {
    free,      ///< nothing: a vertex where no line goes on, a cusp, the end of a border
    corner,    ///< another line goes on there
    occluded,  ///< a nearer surface passes in front, or begins or ceases to hide it
    frame,     ///< the border of the picture
};

/// Nothing that is farther from the end of a run is looked for.
constexpr float kFarthestGapPx = 16;

/// A piece of a run, which runs as the run does, and where its ends stand along the chain.
struct RunPiece {
    LinePiece piece;
    double at_from_px = 0, at_to_px = 0;
};

/// A LineRun is the longest part of a chain that is all seen or all hidden.
struct LineRun {
    std::size_t first = 0, count = 0;  ///< in LineRuns::pieces
    bool is_hidden = false;
    bool is_closed = false;  ///< it is a loop: its last piece ends where its first one begins
    std::array<RunEnd, 2> ends{RunEnd::free, RunEnd::free};
    /// How far what may stop the run is from either end: 0 where it is stopped, at most kFarthestGapPx.
    std::array<float, 2> gaps_px{kFarthestGapPx, kFarthestGapPx};
    /// The same of what hides the run or goes on straight ahead, as the other half of a line that breaks: lines that
    /// cross it or turn away by more than 30 degrees do not count.
    std::array<float, 2> onward_gaps_px{kFarthestGapPx, kFarthestGapPx};
    double chain_length_px = 0;
    bool chain_is_closed = false;
    /// A hash of the place in the mesh where its chain begins, which does not depend on the view; 0 for contours and
    /// intersections.
    std::uint64_t chain_place = 0;
};

/// How much of what free ends have an end has that is so far from what may stop it: all of it where nothing is near,
/// and little where a line breaks by a hair, so that nothing jumps when it does.
inline double freedom(float gap_px) {
    const double share = static_cast<double>(gap_px / kFarthestGapPx);
    return share * share * (3 - 2 * share);
}

/// The lines of a picture as runs. Their order depends on nothing but the lines.
struct LineRuns {
    std::vector<RunPiece> pieces;
    std::vector<LineRun> runs;

    std::span<const RunPiece> pieces_of(const LineRun& run) const {
        return std::span(pieces).subspan(run.first, run.count);
    }
    double length_px(const LineRun& run) const {
        return run.count == 0 ? 0 : pieces[run.first + run.count - 1].at_to_px - pieces[run.first].at_from_px;
    }
};

/// How runs are made of visible lines, or of hidden ones.
struct RunRules {
    bool along_features = true;  ///< else edges are chained as all other lines are
    PieceLinking linking;        ///< of lines that do not stand along features
};

/// Makes runs of the pieces of a picture that are drawn, each in one of them; left out are pieces shorter than a pixel
/// beside longer ones of the same chain. `features`: edges that are lines in every view, as wholes;
/// runs of those stand along the chains of these (chains_of()), seen or not. All other lines are chained piece by piece
/// (PieceChains), and stand along what is seen of them. Where a chain is a loop that is seen in part, what is beyond
/// its beginning stands beyond its length.
LineRuns runs_of(const LineDrawing::Lists& visible, const LineDrawing::Lists& behind,
                 std::span<const WholeLine> features, const SurfaceSet& surfaces, const RunRules& of_seen = {},
                 const RunRules& of_hidden = {});

}  // namespace burin
