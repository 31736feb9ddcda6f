#pragma once

#include <vector>

#include "abuffer/samples/sample_tile.h"
#include "abuffer/screen/screen_surfaces.h"
#include "lines/line_piece.h"

namespace burin {

/// Finds LinePiece::beyond for the visible pieces of a tile where a surface ends: the triangle at the sample that is
/// nearest to a place half a pixel beside the middle of the piece, on the side where the surface is not. Pieces are cut
/// where another surface begins there, to a sample, so that what is beyond does not change for whole pieces at once;
/// further parts of them stand behind all others.
void find_surfaces_beyond(const SampleTile& samples, const ScreenSurfaces& screen, const Projection& projection,
                          std::vector<LinePiece>& pieces);

}  // namespace burin
