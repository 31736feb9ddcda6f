#pragma once

#include <span>

#include "abuffer/samples/sample_tile.h"
#include "lines/line_piece.h"

namespace burin {

/// Finds LinePiece::beyond for the visible pieces of a tile where a surface ends: the triangle at the sample that is
/// nearest to a place half a pixel beside the middle of the piece, on the side where the surface is not.
void find_surfaces_beyond(const SampleTile& samples, std::span<LinePiece> pieces);

}  // namespace burin
