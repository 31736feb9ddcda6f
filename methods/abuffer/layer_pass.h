#pragma once

#include <vector>

#include "methods/abuffer/layer_bins.h"
#include "methods/abuffer/layer_strokes.h"
#include "methods/abuffer/layer_tile.h"
#include "methods/abuffer/smooth_contours.h"

namespace burin {

/// What is behind the first surface: keeps all layers of all tiles in turn, composites transparent
/// surfaces, and finds and draws hidden lines and lines seen through transparent surfaces.
class LayerPass {
  public:
    /// Whether a frame shows anything of it.
    static bool is_needed(const Frame& frame);

    /// The facing of all triangles must be known to `screen`.
    /// `contours`: nullptr where they follow the mesh.
    LayerPass(const Frame& frame, const ScreenSurfaces& screen, int threads,
              const SmoothContours* contours = nullptr);

    /// The lines, per tile; finds them at the first call of find().
    void find();
    const std::vector<LayerLine>& lines() const { return lines_; }
    const std::vector<LayerPiece>& pieces() const { return pieces_; }

    /// After all pixels were put and before the visible lines are drawn.
    void draw_below(const std::vector<std::vector<LineSegment>>& visible, Film& film);
    /// After the visible lines.
    void draw_above(Film& film) const { strokes_.draw_above(film); }

    std::uint64_t fragment_count() const { return fragment_count_; }

  private:
    std::vector<std::vector<LayerSegment>> make_segments() const;
    void add(const LayerLine& line, LayerSegment segment, std::vector<LayerSegment>& segments) const;
    void add_dashes(const LayerPiece& piece, const std::array<double, 2>& position,
                    std::vector<LayerSegment>& segments) const;

    const Frame& frame_;
    const ScreenSurfaces& screen_;
    const SmoothContours* contours_;
    int threads_;
    PixelTiles grid_;
    LayerBins bins_;
    LayerStrokes strokes_;
    std::vector<LayerLine> lines_;
    std::vector<LayerPiece> pieces_;
    std::uint64_t fragment_count_ = 0;
};

}  // namespace burin
