#pragma once

#include <vector>

#include "abuffer/tile_kernels.h"
#include "lines/line_segment.h"
#include "render/film.h"
#include "render/frame.h"

namespace burin {

/// A straight piece of a line that some surface is in front of, on the screen, in pixels.
struct LayerSegment {
    glm::dvec2 from{0.0}, to{0.0};
    LineClass drawn_as = LineClass::silhouette;
    bool is_hidden = false;         ///< by an opaque surface; else seen through transparent ones
    std::uint8_t transmission = 255;  ///< what transparent surfaces in front let through, 255 = all
};

/// Draws lines behind surfaces: below the visible lines into the beauty, hidden ones into their own
/// channels, and those seen through transparent surfaces into the channels of the visible lines.
class LayerStrokes {
  public:
    LayerStrokes(const Frame& frame, const TileKernels& kernels, int threads)
        : frame_(frame), kernels_(kernels), threads_(threads) {}

    /// Before the visible lines of this part are drawn, which are given, too: what they will cover stays
    /// free.
    void draw_below(PixelRect part, const std::vector<std::vector<LineSegment>>& visible,
                    const std::vector<std::vector<LayerSegment>>& layers, Film& film);
    /// After them.
    void draw_above(Film& film) const;

  private:
    struct SeenThrough {
        int x, y;
        LinePixel lines;
    };
    const Frame& frame_;
    const TileKernels& kernels_;
    int threads_;
    std::vector<std::vector<SeenThrough>> seen_through_;  // per tile
};

}  // namespace burin
