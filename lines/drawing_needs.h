#pragma once

#include <cmath>

#include "lines/line_class.h"

namespace burin {

/// DrawingNeeds says what the looks of a picture ask of finding: how much of its lines must be found, how far around,
/// and what must be known of them. What is found depends on nothing else of a look, so that one drawing serves all
/// looks that need no more than it has. What a line is, LineCriteria say.
struct DrawingNeeds {
    static constexpr int kAnyInvisibility = 255;

    LineClassSet classes;
    /// Lines are needed up to this quantitative invisibility, the number of opaque surfaces in front; 0: visible ones.
    int most_invisibility = 0;
    /// Whether the look tells one invisibility from another. Else hidden parts that follow each other are one piece.
    bool tells_invisibility = false;
    /// Some surfaces let light through: what is behind them is seen, lines as well.
    bool is_transparent = false;
    /// Visible lines are needed in the whole picture, whatever its crop, and each edge although another one covers it:
    /// the look moves or cuts lines by what they are elsewhere (smooth contours, dashes). An EXR cannot be written
    /// while it is drawn then.
    bool whole_picture = false;
    /// Lines behind surfaces are needed in the whole picture, too.
    bool whole_picture_behind = false;
    /// Edges and intersections are needed as wholes, seen or not, on the picture and beside it: dashes run along them.
    bool whole_lines = false;
    /// Strokes are drawn on one side of their lines: pieces must not overlap, so they are sampled more finely instead
    /// of being completed from the mesh.
    bool one_sided = false;
    /// Of visible lines where a surface ends it must be known which surface is seen beyond: LinePiece::beyond.
    bool surfaces_beyond = false;
    /// How far from a line its stroke may change pixels.
    double reach_px = 1;

    /// Whether anything behind the first surface matters.
    bool behind() const { return most_invisibility > 0 || is_transparent; }
    /// Whether rows of a picture can be drawn as soon as the lines that reach them are known.
    bool rows_stand_alone() const { return !whole_picture && !whole_picture_behind; }
    /// How many pixels around those that are drawn lines must be found in: as far as strokes reach, and one more.
    int margin_px() const { return static_cast<int>(std::ceil(reach_px)) + 1; }
};

}  // namespace burin
