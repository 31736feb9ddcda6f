#pragma once

#include <array>
#include <span>
#include <vector>

#include "lines/line_segment.h"
#include "lines/pen.h"
#include "lines/stroke_clip.h"
#include "render/frame.h"

namespace burin {

/// The strokes of visible lines in one tile after the other, as masks, class by class; buffers are used
/// again.
class VisibleStrokes {
  public:
    explicit VisibleStrokes(const Frame& frame, const TileKernels& kernels = best_kernels());

    /// `segments`: all that come within the pen's radius of the rectangle, drawn or not.
    void draw(std::span<const LineSegment* const> segments, PixelRect rect);

    const Pen& pen() const { return pen_; }
    PixelRect rect() const { return rect_; }
    bool is_touched(int column, int row) const {
        for (const LineClass c : classes_) {
            if (canvas_of(c).is_touched(column, row)) return true;
        }
        return false;
    }
    /// Calls use(class, mask, samples of earlier classes) for the classes at a pixel. Where several overlap,
    /// the first one counts.
    template <typename Use>
    void for_classes(int column, int row, const Use& use) const {
        StrokeMask drawn;
        for (const LineClass c : classes_) {
            if (!canvas_of(c).is_touched(column, row)) continue;
            const StrokeMask& mask = canvas_of(c).at(column, row);
            use(c, mask, drawn);
            for (std::size_t r = 0; r < mask.rows.size(); ++r) drawn.rows[r] |= mask.rows[r];
        }
    }

  private:
    StrokeCanvas& canvas_of(LineClass c) { return canvases_[static_cast<std::size_t>(c)]; }
    const StrokeCanvas& canvas_of(LineClass c) const { return canvases_[static_cast<std::size_t>(c)]; }
    bool needs_clipping(std::span<const LineSegment* const> segments) const;
    void draw_clipped(std::span<const LineSegment* const> segments);
    double depth_px(float nearness) const;

    const Projection& projection_;
    StrokeSide side_;
    Pen pen_;
    std::array<StrokeCanvas, kLineClassCount> canvases_;
    PixelRect rect_;
    std::vector<LineClass> classes_;  // that have strokes in the tile
    StrokeClipper clipper_;
    std::vector<ClipPiece> pieces_;
    std::vector<const ClipPiece*> boundaries_;
};

}  // namespace burin
