#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "image/image.h"
#include "lines/line_piece.h"
#include "strokes/stroke_mask.h"

namespace burin {

/// FadedStrokes draws the strokes of one tile that are not fully opaque, those of lines that fade, into masks. They lie
/// below all others, and where two overlap, the more opaque one counts. So a line that has become opaque looks as if it
/// had never faded. Buffers are used again.
class FadedStrokes {
  public:
    explicit FadedStrokes(const TileKernels& kernels) : canvas_(kernels) {}

    /// Draws the pieces that are not opaque, by calling draw_stroke(index, canvas) for each.
    void draw(std::span<const LinePiece* const> pieces, PixelRect rect,
              const std::function<void(std::size_t, StrokeCanvas&)>& draw_stroke);

    /// Whether a pixel of the rectangle has any of these strokes.
    bool is_touched(int column, int row) const {
        return !masks_.empty() && touched_[static_cast<std::size_t>(row * width_ + column)] != 0;
    }
    /// Tells of eight pixels at once whether they have any, as StrokeCanvas::eight_touched() does.
    std::uint64_t eight_touched(int column, int row) const {
        return masks_.empty() ? 0
                              : StrokeCanvas::eight_bytes(&touched_[static_cast<std::size_t>(row * width_ + column)]);
    }
    /// Calls use(class, mask, samples taken, opacity 0..1) for what there is in a pixel, the most opaque one first.
    template <typename Use>
    void for_masks(int column, int row, StrokeMask taken, const Use& use) const {
        for (const PixelMask& m : masks_of(column, row)) {
            use(m.kind.line_class, m.mask, taken, static_cast<float>(m.kind.opacity()) / 255.0f);
            for (std::size_t r = 0; r < taken.rows.size(); ++r) taken.rows[r] |= m.mask.rows[r];
        }
    }

  private:
    /// What is drawn together. Kinds are in order of what counts first: the more opaque one, then the class.
    struct Kind {
        std::uint8_t lightness;  // 255 - opacity
        LineClass line_class;
        std::uint8_t opacity() const { return static_cast<std::uint8_t>(255 - lightness); }
        auto operator<=>(const Kind&) const = default;
    };
    static Kind kind_of(const LinePiece& piece) {
        return {static_cast<std::uint8_t>(255 - piece.opacity), piece.drawn_as};
    }
    struct PixelMask {
        std::uint32_t pixel;
        Kind kind;
        StrokeMask mask;
    };
    std::span<const PixelMask> masks_of(int column, int row) const;

    StrokeCanvas canvas_;
    std::vector<PixelMask> masks_;       // by pixel, and in each the most opaque ones first
    std::vector<std::uint8_t> touched_;  // pixels that have masks, and room to read eight at once
    int width_ = 0;                      // of the rectangle, rounded up to eights
};

}  // namespace burin
