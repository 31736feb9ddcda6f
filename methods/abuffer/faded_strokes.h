#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "image/image.h"
#include "lines/line_segment.h"
#include "lines/stroke_mask.h"

namespace burin {

/// The strokes of one tile that are not fully opaque: lines that fade in or out. They lie below all others,
/// and where two overlap, the more opaque one counts. So a line that has become opaque looks as if it
/// had never faded. Buffers are used again.
class FadedStrokes {
  public:
    explicit FadedStrokes(const TileKernels& kernels) : kernels_(&kernels), canvas_(kernels) {}

    /// Draws those of the segments that are not opaque.
    void draw(std::span<const LineSegment* const> segments, PixelRect rect, double radius_px);

    /// Whether there is any in a pixel of the rectangle.
    bool is_touched(int column, int row) const { return !masks_.empty() && !masks_of(column, row).empty(); }
    /// Coverage times opacity in a pixel, besides what is `drawn` already.
    float coverage(int column, int row, StrokeMask drawn) const;

  private:
    struct PixelMask {
        std::uint32_t pixel;
        std::uint8_t opacity;
        StrokeMask mask;
    };
    std::span<const PixelMask> masks_of(int column, int row) const;

    const TileKernels* kernels_;
    StrokeCanvas canvas_;
    std::vector<PixelMask> masks_;  // by pixel, and in each the most opaque ones first
    int width_ = 0;
};

}  // namespace burin
