#pragma once

#include "abuffer/hiding/occluder_bins.h"
#include "render/film.h"
#include "render/frame.h"

namespace burin {

class ShadedSurfaces;

/// Puts the surface colour of all pixels in which a transparent surface is seen: per sample, all
/// surfaces up to the nearest opaque one, composited from front to back (Porter and Duff 1984). The
/// pixels must have been put before.
/// `shaded`: of a shading that varies over surfaces, else nullptr.
void fill_transparent(const Frame& frame, const ScreenSurfaces& screen, const ShadedSurfaces* shaded,
                      const OccluderBins& bins, const PixelTiles& grid, int threads, Film& film);

}  // namespace burin
