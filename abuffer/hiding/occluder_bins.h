#pragma once

#include "abuffer/hiding/line_depths.h"
#include "abuffer/screen/screen_surfaces.h"
#include "view/pixel_tiles.h"

// Triangles are sorted to tiles for hidden lines, seen or not.

namespace burin {

/// OccluderBins lists the numbers of all triangles that touch each tile, be they seen or not: those of the instances
/// that are shown, instance by instance, and in ascending order if no lines are given. Triangles that are seen exactly
/// edge-on hide nothing and are left out, as are those in front of none of the lines, if these are given.
class OccluderBins {
  public:
    /// This bit marks the number of a triangle that is cut by the near plane or the guard band.
    static constexpr std::uint32_t kClipped = 1u << 31;

    OccluderBins() = default;
    OccluderBins(const ScreenSurfaces& screen, const TileKernels& kernels, const PixelTiles& grid, int threads,
                 const LineDepths* lines = nullptr);
    std::span<const std::uint32_t> triangles(std::size_t tile) const { return lists_.of(tile); }

  private:
    TileLists<std::uint32_t> lists_;
};

}  // namespace burin
