#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "lines/line_piece.h"
#include "render/frame.h"
#include "shading/pen.h"
#include "strokes/faded_strokes.h"
#include "strokes/stroke_clip.h"

namespace burin {

/// VisibleStrokes draws the strokes of visible lines in one tile after the other into masks, class by class. Buffers
/// are used again.
class VisibleStrokes {
  public:
    explicit VisibleStrokes(const Frame& frame, const TileKernels& kernels = best_kernels());

    /// Draws the masks of a rectangle. `pieces`: all pieces within the pen's radius of it, drawn or not.
    void draw(std::span<const LinePiece* const> pieces, PixelRect rect);

    const Pen& pen() const { return pen_; }
    PixelRect rect() const { return rect_; }
    /// Calls visit(column, row) for the pixels that have any strokes, row by row.
    template <typename Visit>
    void for_touched(const Visit& visit) const {
        for (int row = 0; row < rect_.height(); ++row) {
            for (int column = 0; column < rect_.width(); column += 8) {
                std::uint64_t eight = faded_.eight_touched(column, row);
                for (const LineClass c : classes_) eight |= canvas_of(c).eight_touched(column, row);
                StrokeCanvas::visit_touched(eight, column, row, visit);
            }
        }
    }
    /// The class of the strokes at a pixel that has some, if it is one and none of them fades.
    std::optional<LineClass> only_class(int column, int row) const {
        std::optional<LineClass> only;
        for (const LineClass c : classes_) {
            if (!canvas_of(c).is_touched(column, row)) continue;
            if (only) return std::nullopt;
            only = c;
        }
        return faded_.is_touched(column, row) ? std::nullopt : only;
    }
    const StrokeMask& mask_of(LineClass c, int column, int row) const { return canvas_of(c).at(column, row); }
    bool is_touched(int column, int row) const {
        return faded_.is_touched(column, row) || std::any_of(classes_.begin(), classes_.end(), [&](LineClass c) {
                   return canvas_of(c).is_touched(column, row);
               });
    }
    /// Calls use(class, mask, samples taken by others, opacity 0..1) for the strokes at a pixel, class by class;
    /// what fades comes last. Where several overlap, the first one counts.
    template <typename Use>
    void for_classes(int column, int row, const Use& use) const {
        StrokeMask drawn;
        for (const LineClass c : classes_) {
            if (!canvas_of(c).is_touched(column, row)) continue;
            const StrokeMask& mask = canvas_of(c).at(column, row);
            use(c, mask, drawn, 1.0f);
            for (std::size_t r = 0; r < mask.rows.size(); ++r) drawn.rows[r] |= mask.rows[r];
        }
        if (!faded_.is_touched(column, row)) return;
        faded_.for_masks(column, row, drawn, use);
    }

  private:
    StrokeCanvas& canvas_of(LineClass c) { return canvases_[static_cast<std::size_t>(c)]; }
    const StrokeCanvas& canvas_of(LineClass c) const { return canvases_[static_cast<std::size_t>(c)]; }
    bool needs_clipping(std::span<const LinePiece* const> pieces) const;
    void find_boundaries(std::span<const LinePiece* const> pieces, LineClass line_class);
    void draw_clipped(std::span<const LinePiece* const> pieces);
    double depth_px(float nearness) const;

    const Projection& projection_;
    StrokeSide side_;
    Pen pen_;
    std::array<StrokeCanvas, kLineClassCount> canvases_;
    PixelRect rect_;
    std::vector<LineClass> classes_;  // that have opaque strokes in the tile
    FadedStrokes faded_;
    StrokeClipper clipper_;
    std::vector<ClipPiece> pieces_;
    std::vector<const ClipPiece*> boundaries_;
};

}  // namespace burin
