#pragma once

#include <vector>

#include "strokes/ink_regions.h"
#include "strokes/ink_tile.h"
#include "strokes/tile_mattes.h"

namespace burin {

/// InkMattes tells whose the strokes of an InkTile are: of each stroke in a pixel, what it takes of what those above it
/// leave. Used where some layer asks for it.
class InkMattes {
  public:
    /// All must outlive it; the lines have their origins. `filter`: nullptr where each pixel sees its own square.
    InkMattes(const Frame& frame, const InkedLines& lines, const InkPlan& plan, const FilterTable* filter,
              const TileKernels& kernels, Mattes& mattes)
        : lines_(lines),
          plan_(plan),
          tile_mattes_(frame, mattes, filter, kernels),
          regions_(kernels, filter != nullptr) {}

    /// Begins a tile: InkTile::draw() is to tell these whose the strokes are that it draws together.
    OwnerMasks& begin(PixelRect rect) {
        tile_mattes_.begin(rect);
        return tile_mattes_.owners();
    }
    /// Adds the strokes of that tile.
    void add(const InkTile& tile);

  private:
    struct Placed {
        std::uint32_t rank;
        float nearness;
        std::uint64_t chain;
        InkSpot spot;
        OwnerMasks::Line line;
        bool is_behind = false;  ///< some surface is in front of it, be it glass
    };
    void find_spots(const InkTile& tile, int column, int row);
    void lay(int column, int row);
    void lay_deep(int column, int row, bool are_hidden);

    const InkedLines& lines_;
    const InkPlan& plan_;
    TileMattes tile_mattes_;
    InkRegions regions_;
    std::vector<Placed> spots_;
    std::vector<StrokeMask> masks_;  // of parts of layers
};

}  // namespace burin
