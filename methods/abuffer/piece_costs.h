#pragma once

#include <cstdint>
#include <vector>

#include "methods/abuffer/screen_surfaces.h"
#include "methods/abuffer/tile_lists.h"

namespace burin {

/// The memory that each row of tiles takes for what touches it, in bytes. Counted from above: a row is
/// never found cheaper than it is.
struct RowCosts {
    std::vector<std::uint64_t> visible;  ///< TriangleBins
    std::vector<std::uint64_t> layers;   ///< LayerBins and lines; empty where there are none
};

/// Where an instance is on the screen, in pixels.
struct InstanceExtent {
    glm::dvec2 low{0.0}, high{0.0};
};

/// Adds what the instances shown cost, and says where each of `instances` is.
class PieceCosts {
  public:
    /// `layers`: nullptr where nothing behind the first surface is drawn.
    PieceCosts(const PixelTiles& visible, const PixelTiles* layers, int samples_per_pixel, int threads);

    void add(const ScreenSurfaces& screen);
    const RowCosts& rows() const { return rows_; }
    static InstanceExtent extent_of(const ScreenSurfaces& screen, std::uint32_t instance);

  private:
    PixelTiles visible_;
    const PixelTiles* layers_;
    double sample_px_;
    int threads_;
    RowCosts rows_;
};

}  // namespace burin
