#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "methods/projected_polygon.h"

// Polygons are sorted to the tiles of a picture that they touch.

namespace burin {

/// A polygon of an instance.
struct PolygonRef {
    std::uint32_t instance = 0;
    std::uint32_t polygon = 0;
};

/// Sorts the polygons of a frame to square tiles of pixels. Within a tile they are in the order of
/// the scene: by object, then as they stand in the file.
class PolygonBins {
  public:
    /// `reach_px`: how far lines reach beyond the polygons.
    PolygonBins(const Frame& frame, const FeatureEdges& features, const DepthRange& depth, int tile_px, double reach_px,
                int threads);

    std::size_t tile_count() const { return offsets_.size() - 1; }
    PixelRect tile(std::size_t index) const;
    std::span<const PolygonRef> polygons(std::size_t index) const {
        return std::span(sorted_).subspan(offsets_[index], offsets_[index + 1] - offsets_[index]);
    }

  private:
    PixelRect region_;
    int tile_px_;
    int columns_, rows_;
    std::vector<std::size_t> offsets_;
    std::vector<PolygonRef> sorted_;
};

}  // namespace burin
