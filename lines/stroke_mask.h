#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "abuffer/tile_kernels.h"

namespace burin {

/// A pixel's coverage mask for strokes: 16 rows of 32 samples, bit c of row r at
/// ((c + 1/2 + kStrokeRowShift[r]) / 32, (r + 1/2) / 16) of the pixel.
struct StrokeMask {
    static constexpr int kRows = 16;
    static constexpr int kColumns = 32;
    std::array<std::uint32_t, kRows> rows{};

    /// Calls visit(pixel, bits) for the pixels of a row that columns [begin, end) lie in, counted from the row's start.
    template <typename Visit>
    static void for_pixels(int begin, int end, const Visit& visit) {
        for (int column = begin; column < end;) {
            const int pixel = column / kColumns, from = column % kColumns;
            const int to = std::min(end - pixel * kColumns, kColumns);
            visit(pixel, (0xFFFFFFFFu << from) & (0xFFFFFFFFu >> (kColumns - to)));
            column = (pixel + 1) * kColumns;
        }
    }
};

/// Coverage masks of a rectangle of pixels, into which strokes are drawn. Pieces that overlap or meet
/// count once, so pieces of a line need no joins.
class StrokeCanvas {
  public:
    explicit StrokeCanvas(const TileKernels& kernels = best_kernels()) : kernels_(&kernels) {}
    void reset(int x0, int y0, int width, int height);

    /// Adds all that is closer than `radius_px` to a segment: a round pen's stroke.
    void draw(glm::dvec2 from, glm::dvec2 to, double radius_px);

    /// Adds samples of one pixel.
    void add(int column, int row, const StrokeMask& mask) {
        const auto i = static_cast<std::size_t>(row * width_ + column);
        for (std::size_t r = 0; r < mask.rows.size(); ++r) masks_[i].rows[r] |= mask.rows[r];
        touched_[i] = 1;
    }

    int width() const { return width_; }
    int height() const { return height_; }
    const StrokeMask& at(int column, int row) const {
        return masks_[static_cast<std::size_t>(row * width_ + column)];
    }
    bool is_touched(int column, int row) const {
        return touched_[static_cast<std::size_t>(row * width_ + column)] != 0;
    }
    /// Whether nothing can be added any more.
    bool is_full(int column, int row) const {
        if (!is_touched(column, row)) return false;
        std::uint32_t all = ~0u;
        for (const std::uint32_t bits : at(column, row).rows) all &= bits;
        return all == ~0u;
    }

  private:
    const TileKernels* kernels_;
    std::vector<std::int32_t> begin_, end_;
    int x0_ = 0, y0_ = 0, width_ = 0, height_ = 0;
    std::vector<StrokeMask> masks_;
    std::vector<std::uint8_t> touched_;
};

}  // namespace burin
