#pragma once

#include "methods/abuffer/line_tile.h"
#include "render/film.h"

namespace burin {

/// Puts the pixels of a tile that lie in the frame's crop, without lines.
void fill_pixels(const Frame& frame, const LineTile& tile, Film& film);

}  // namespace burin
