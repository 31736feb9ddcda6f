#pragma once

#include <span>
#include <vector>

#include "lines/line_crossing.h"
#include "lines/line_piece.h"

// Crossings between samples become pieces of lines, cell by cell.

namespace burin {

/// Connects the crossings on the four sides of a cell, a square between 2 x 2 neighbouring samples,
/// to pieces of lines: marching squares (Lorensen and Cline 1987, in the plane) whose crossings lie
/// where the mesh says.
///
/// Two crossings are joined; where they belong to two lines, by way of the corner in which these meet, if it lies in
/// the cell or, where one of them is an intersection, just beyond. Where three or four come together, the nearest
/// line goes through and the others end at it, but for those whose edges meet at a corner before it: they end there.
/// A single one runs on to the end of its edge.
///
/// `low` and `high` are the positions of the cell's upper left and lower right sample. `has_bridges`: two lines that
/// run through the cell, of which one ends a surface, are joined though they do not meet. Else what is missing of
/// them is expected to be found along their edges, if they can be told apart.
void trace_cell(std::span<const LineCrossing* const> crossings, glm::dvec2 low, glm::dvec2 high, bool has_bridges,
                std::vector<LinePiece>& pieces);

}  // namespace burin
