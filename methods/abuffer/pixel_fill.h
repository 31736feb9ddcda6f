#pragma once

#include <vector>

#include "methods/abuffer/line_tile.h"
#include "render/film.h"

namespace burin {

/// Fills the pixels of a tile from its samples, without lines. One per thread: what is computed for a
/// surface is kept while it comes up again.
class PixelFiller {
  public:
    PixelFiller(const Frame& frame, const ScreenSurfaces& screen) : frame_(frame), screen_(screen), looks_(kSlots) {}

    /// Puts the pixels of a tile that lie in the frame's crop.
    void fill(const LineTile& tile, Film& film);

  private:
    /// What all pixels of a triangle have in common.
    struct Look {
        std::uint32_t number = 0xFFFFFFFFu;
        bool has_geometry = false;
        glm::dvec3 corner, normal;  // in view space; towards the eye
        double nearest, farthest;   // distances
        glm::vec3 world_normal;
        std::uint32_t object_id, material_id, polygon_id;
    };
    static constexpr std::size_t kSlots = 512;

    const Look& look_of(std::uint32_t number);
    void shade(const SampleTile& samples, int x, int y, PixelResult& result);
    glm::vec4 color(std::uint32_t number, int x, int y);

    const Frame& frame_;
    const ScreenSurfaces& screen_;
    std::vector<Look> looks_;  // by the last bits of the number
};

}  // namespace burin
