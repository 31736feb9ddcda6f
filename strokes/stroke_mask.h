#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <vector>

#include "kernels/cache_line.h"
#include "kernels/stroke_samples.h"
#include "kernels/tile_kernels.h"

namespace burin {

/// A pixel's coverage mask for strokes: 16 rows of 32 samples, bit c of row r at ((c + 1/2 + shift) / 32, (r + 1/2) /
/// 16) of the pixel with the row's stroke_row_shift(); for level boundaries, see kStrokeColumnShifts.
struct StrokeMask {
    static constexpr int kRows = kStrokeRows;
    static constexpr int kColumns = kStrokeColumns;
    std::array<std::uint32_t, kRows> rows{};
};

inline void unite(StrokeMask& mask, const StrokeMask& other) {
    for (std::size_t r = 0; r < mask.rows.size(); ++r) mask.rows[r] |= other.rows[r];
}

/// StrokeCanvas has the coverage masks of a rectangle of pixels, into which strokes are drawn. Pieces that overlap or
/// meet count once, so pieces of a line need no joins.
class StrokeCanvas {
  public:
    explicit StrokeCanvas(const TileKernels& kernels = best_kernels()) : kernels_(&kernels) {}
    void reset(int x0, int y0, int width, int height);

    /// Some pixels of it: columns [x0, x1) and rows [y0, y1).
    struct Box {
        int x0, y0, x1, y1;
        bool is_empty() const { return x0 >= x1 || y0 >= y1; }
    };

    /// Adds all that is closer than `radius_px` to a piece: a round pen's stroke.
    void draw(const glm::dvec2& from, const glm::dvec2& to, double radius_px) {
        // Wide strokes lie on each other, and soon most of their pixels are full.
        if (radius_px > kWideRadiusPx && open_part(box_around(from, to, radius_px + 1)).is_empty()) return;
        kernels_->stroke.draw({{from.x, from.y}, {to.x, to.y}, radius_px},
                              {masks_.data()->rows.data(), touched_.data(), x0_, y0_, width_, height_, stride_});
    }

    /// Adds the stroke of a pen whose radius changes.
    void draw(const PenCone& cone) {
        const double radius_px = std::max(cone.radius_from, cone.radius_to);
        if (radius_px > kWideRadiusPx &&
            open_part(box_around({cone.from[0], cone.from[1]}, {cone.to[0], cone.to[1]}, radius_px + 1)).is_empty())
            return;
        kernels_->stroke.draw_cone(cone,
                                   {masks_.data()->rows.data(), touched_.data(), x0_, y0_, width_, height_, stride_});
    }

    /// Adds samples of one pixel.
    void add(int column, int row, const StrokeMask& mask) {
        const std::size_t i = index(column, row);
        for (std::size_t r = 0; r < mask.rows.size(); ++r) masks_[i].rows[r] |= mask.rows[r];
        touched_[i] = 1;
    }

    int width() const { return width_; }
    int height() const { return height_; }
    const StrokeMask& at(int column, int row) const { return masks_[index(column, row)]; }
    bool is_touched(int column, int row) const { return touched_[index(column, row)] != 0; }
    /// Tells of eight pixels, from a multiple of eight on, which are touched: a byte each, 0 or 1. Pixels beyond the
    /// canvas are not.
    std::uint64_t eight_touched(int column, int row) const { return eight_bytes(&touched_[index(column, row)]); }
    /// Eight bytes as one number, the first byte in the lowest bits.
    static std::uint64_t eight_bytes(const std::uint8_t* first) {
        static_assert(std::endian::native == std::endian::little);
        std::uint64_t bytes;
        std::memcpy(&bytes, first, sizeof bytes);
        return bytes;
    }
    /// Calls visit(column, row) for the pixels that are touched, row by row.
    template <typename Visit>
    void for_touched(const Visit& visit) const {
        for (int row = 0; row < height_; ++row) {
            for (int column = 0; column < width_; column += 8)
                visit_touched(eight_touched(column, row), column, row, visit);
        }
    }
    /// Calls visit(column, row) for the pixels that are touched among the eight that eight_touched() told of.
    template <typename Visit>
    static void visit_touched(std::uint64_t eight, int column, int row, const Visit& visit) {
        for (; eight != 0; eight &= eight - 1) visit(column + std::countr_zero(eight) / 8, row);
    }
    /// The pixels that a stroke may reach.
    Box box_around(const glm::dvec2& from, const glm::dvec2& to, double radius_px) const;
    /// The smallest box around the pixels of a box to which something can be added.
    Box open_part(Box box);
    /// Whether nothing can be added to a pixel any more.
    bool is_full(int column, int row) const {
        if (!is_touched(column, row)) return false;
        std::uint32_t all = ~0u;
        for (const std::uint32_t bits : at(column, row).rows) all &= bits;
        return all == ~0u;
    }

  private:
    static constexpr double kWideRadiusPx = 8;

    std::size_t index(int column, int row) const { return static_cast<std::size_t>(row * stride_ + column); }
    bool is_open(int column, int row);

    const TileKernels* kernels_;
    int x0_ = 0, y0_ = 0, width_ = 0, height_ = 0;
    int stride_ = 0;  // a multiple of eight; pixels beyond the width stay untouched
    std::vector<StrokeMask, CacheLineAllocator<StrokeMask>> masks_;
    std::vector<std::uint8_t> touched_;
    std::vector<std::uint8_t> known_full_;  // pixels that were found full; empty until one is looked for
};

}  // namespace burin
