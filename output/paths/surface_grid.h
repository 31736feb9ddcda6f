#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "image/image.h"

namespace burin {

/// What is seen of surfaces at the places of a grid that is finer than pixels: which object, in which colour.
struct SurfaceGrid {
    /// A colour in which an object is seen. Look 0 is nothing.
    struct Look {
        std::uint32_t object = 0;  ///< from 1; 0: transparent surfaces with nothing behind them
        glm::vec3 color{0.0f};     ///< linear RGB
        float opacity = 0;
    };

    PixelRect area;                      ///< of the picture
    int places_per_px = 1;               ///< along each axis
    glm::dvec2 place{0.5};               ///< of a place in its cell of the grid, 0 to 1
    std::vector<Look> looks;             ///< at least look 0
    std::vector<std::uint32_t> look_at;  ///< of each place, row by row
    std::size_t mean_objects = 0;        ///< objects whose colour varies too much: they have their mean

    int columns() const { return area.width() * places_per_px; }
    int rows() const { return area.height() * places_per_px; }
};

/// SurfaceGridMaker makes a grid of pixels of a finer picture: of the object in the middle of each, and of its colour,
/// which is mixed of those of both sides at edges. A colour that fills squares of four pixels is one of an object's;
/// other pixels get that which is nearest to them of the same object. Objects that have more than 64 colours, or none
/// in most of their pixels, get their mean.
class SurfaceGridMaker {
  public:
    SurfaceGridMaker(PixelRect area, int places_per_px, glm::dvec2 place);

    /// Adds the next row: of each place the object, or 0, and the colour, linear and premultiplied by its opacity, as
    /// halfs.
    void add_row(const std::uint32_t* objects, const std::array<const std::uint16_t*, 4>& colors);
    SurfaceGrid grid();

  private:
    struct Seen {
        std::uint32_t object;
        std::uint64_t halfs;
        glm::vec4 color;
        std::size_t count = 0, in_squares = 0;
    };
    std::uint32_t number_of(std::uint32_t object, std::uint64_t halfs);
    void grow();
    void find_squares();
    void name_looks();
    void spread_looks();

    SurfaceGrid grid_;
    std::vector<Seen> seen_;
    std::vector<std::uint32_t> slots_;  ///< of a table of seen_, by hash, counted from 1
    std::uint32_t last_ = 0;
    std::vector<bool> is_in_square_;
    std::vector<std::uint32_t> look_of_seen_, unnamed_;
};

}  // namespace burin
