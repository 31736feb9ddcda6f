#pragma once

#include <memory>
#include <span>
#include <vector>

#include "kernels/tile_kernels.h"
#include "render/film.h"
#include "render/frame.h"
#include "strokes/pixel_filter.h"
#include "strokes/visible_strokes.h"
#include "view/pixel_tiles.h"

namespace burin {

/// A straight piece of a line that some surface is in front of, on the screen, in pixels.
struct LayerSegment {
    glm::dvec2 from{0.0}, to{0.0};
    LineClass drawn_as = LineClass::silhouette;
    bool is_hidden = false;           ///< by an opaque surface; else seen through transparent ones
    std::uint8_t transmission = 255;  ///< what transparent surfaces in front let through, 255 = all
};

/// Draws lines behind surfaces in one part of the picture: below the visible lines into the beauty, hidden ones into
/// their own channels, and those seen through transparent surfaces into the channels of the visible lines. Tile by
/// tile, together with the visible strokes, which cover them.
class HiddenStrokes {
  public:
    static constexpr int kTilePx = 32;

    /// `layers` must outlive it.
    HiddenStrokes(const Frame& frame, const TileKernels& kernels, int threads, PixelRect part,
                  std::span<const std::vector<LayerSegment>> layers);
    ~HiddenStrokes();

    bool has_any(std::size_t tile) const { return !lists_.of(tile).empty(); }
    /// Before the visible lines of this tile are drawn, which are given: what they will cover stays free.
    void draw_below(int worker, std::size_t tile, const VisibleStrokes& visible, Film& film);
    /// After them, on the same thread.
    void draw_above(int worker, Film& film) const;

  private:
    class Worker;

    std::unique_ptr<const FilterTable> filter_;
    PixelTiles grid_;
    TileLists<const LayerSegment*> lists_;
    std::vector<Worker> workers_;
};

}  // namespace burin
