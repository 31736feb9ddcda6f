#pragma once

#include <cstdint>
#include <vector>

#include "abuffer/screen/screen_surfaces.h"
#include "render/frame.h"
#include "view/pixel_tiles.h"

namespace burin {

/// Some rows of tiles of a picture, and the instances that touch them, in ascending order.
struct PictureSlice {
    TileRows rows;
    std::vector<std::uint32_t> instances;
};

/// A SlicePlan says in which slices a picture is rendered, from top to bottom. They do not change it.
struct SlicePlan {
    std::vector<PictureSlice> visible;  ///< rows of the tiles of visible surfaces
    std::vector<PictureSlice> layers;   ///< rows of HiddenPass's tiles
    /// All instances, in groups that can be shown at once.
    std::vector<std::vector<std::uint32_t>> groups;
    std::uint64_t least_bytes = 0;  ///< the least cap that there is a plan for
};

/// Makes the largest slices within `cap_bytes` of memory. It takes a look at all triangles to know what they will need,
/// a group of instances at a time. Throws LimitError with the least cap if this one is less.
SlicePlan plan_slices(const Frame& frame, ScreenSurfaces& screen, const PixelTiles& tiles, std::uint64_t cap_bytes,
                      int threads);

}  // namespace burin
