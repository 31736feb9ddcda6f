#pragma once

#include <cstdint>
#include <vector>

#include "abuffer/screen/screen_surfaces.h"
#include "view/pixel_tiles.h"

namespace burin {

/// The memory that each row of tiles takes for what touches it, in bytes.
struct RowCosts {
    std::vector<std::uint64_t> bins;   ///< lists of triangles, counted from above
    std::vector<std::uint64_t> lines;  ///< estimated: more than in any picture measured
};

/// The place of an instance on the screen, in pixels.
struct InstanceExtent {
    glm::dvec2 low{0.0}, high{0.0};
};

/// SliceCosts counts the memory that the tiles of a picture take, from the triangles that touch them.
class SliceCosts {
  public:
    /// `layers`: nullptr where nothing behind the first surface is drawn. `has_fine`: lines that samples miss are.
    SliceCosts(const PixelTiles& visible, const PixelTiles* layers, int samples_per_pixel, bool has_fine, int threads);

    /// Adds the instances shown. Finds the facing of their triangles on the way, and which edges may be lines.
    void add(ScreenSurfaces& screen);
    /// The costs of visible surfaces, and of all surfaces; the latter are empty where only the first one counts.
    RowCosts visible() const;
    RowCosts layers() const;
    /// The bytes of a HidingTile with the most triangles that there are in one: each thread has one.
    std::uint64_t largest_layer_tile() const;
    /// The bytes of the tile whose search for lines that samples miss takes most: each thread has one.
    std::uint64_t largest_fine_tile() const;
    static InstanceExtent extent_of(const ScreenSurfaces& screen, std::uint32_t instance);

  private:
    void find_edges(ScreenSurfaces& screen, const std::vector<TriangleChunk>& chunks) const;
    void add_loose_edges(const ScreenSurfaces& screen);

    PixelTiles visible_;
    const PixelTiles* layers_;
    double sample_px_;
    bool has_fine_;
    int threads_;
    struct Counts {  // per row
        std::vector<std::uint64_t> visible_bytes, visible_touches, layer_touches;
    } counts_;
    std::vector<std::uint64_t> layer_tile_touches_, fine_tile_bytes_;  // per tile
};

}  // namespace burin
