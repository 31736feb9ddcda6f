#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "image/image.h"
#include "view/surface_set.h"

// Triangles are sorted to the tiles of a picture that they touch, so that tiles can be drawn by themselves.

namespace burin {

/// The surfaces that touch each tile of a picture, in the order of SurfaceId.
class SurfaceBins {
  public:
    /// `margin_px` is how far around a tile a surface still counts (the apron).
    SurfaceBins(const SurfaceSet& surfaces, PixelRect region, int tile_px, int margin_px, int threads);

    std::size_t tile_count() const { return offsets_.size() - 1; }
    PixelRect tile(std::size_t index) const;
    std::span<const SurfaceId> surfaces(std::size_t tile) const {
        return {sorted_.data() + offsets_[tile], offsets_[tile + 1] - offsets_[tile]};
    }

  private:
    PixelRect region_;
    int tile_px_;
    int columns_, rows_;
    std::vector<std::size_t> offsets_;
    std::vector<SurfaceId> sorted_;
};

}  // namespace burin
