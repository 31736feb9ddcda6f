#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "kernels/tile_kernels.h"
#include "lines/whole_line.h"
#include "view/pixel_tiles.h"
#include "view/polygon_rows.h"

namespace burin {

/// Tells where on the screen lines are, and how far away: only what is in front of one can hide any. The tiles of a
/// picture are cut into square blocks; each has the least nearness of the lines there.
class LineDepths {
  public:
    /// `slack_of`: how much farther than a line, in nearness, something may be that is in front of it all the same.
    LineDepths(std::span<const WholeLine> lines, const PixelTiles& tiles,
               const std::function<double(const WholeLine&)>& slack_of);

    /// Calls visit(tile) for the tiles in which what fills a box, in 1/256 pixel, with the nearness `highest` at its
    /// nearest, may hide a line.
    template <typename Visit>
    void for_tiles(glm::ivec2 low, glm::ivec2 high, float highest, const Visit& visit) const {
        for_tiles(low, high, highest, nullptr, visit);
    }
    /// Calls visit(tile) in the same way, without tiles that a polygon within the box passes by, farther than a pixel.
    /// nullptr: no polygon.
    template <typename Visit>
    void for_tiles(glm::ivec2 low, glm::ivec2 high, float highest, const PolygonRows* polygon,
                   const Visit& visit) const {
        const Blocks b = blocks_of(low, high);
        for (int y = b.y0; y <= b.y1; y = (y | kLast) + 1) {
            int first = b.x0, last = b.x1;
            if (polygon != nullptr) {
                const PolygonRows::Range range = in_row_of_tiles(*polygon, y);
                if (range.is_empty()) continue;
                first = std::max(first, column_at(static_cast<int>(std::floor(range.low)) - kBeside) & ~kLast);
                last = std::min(last, column_at(static_cast<int>(std::ceil(range.high)) + kBeside));
            }
            for (int x = first; x <= last; x = (x | kLast) + 1) {
                const std::size_t tile = tile_at(x, y);
                if (highest > of_tile_[tile] &&
                    is_nearer(tile, {x, y, std::min(b.x1, x | kLast), std::min(b.y1, y | kLast)}, highest)) {
                    visit(static_cast<std::uint32_t>(tile));
                }
            }
        }
    }

    /// What for_tiles() asks, by pairs of blocks along both axes, so that few triangles need be asked for one by one.
    DepthGrid grid() const {
        return {of_blocks_.data(),     first_.x,  first_.y, last_.x, last_.y, kBlockShift, columns_, begin_row_,
                end_row_ - begin_row_, kTileShift};
    }

  private:
    static constexpr int kBlockShift = 10;  // log2 of a block's width in 1/256 pixel
    static constexpr int kTileShift = 3;    // log2 of the number of blocks along a tile
    static constexpr int kLast = (1 << kTileShift) - 1;

    /// First and last column and row; nothing if the first one lies behind the last one.
    struct Blocks {
        int x0, y0, x1, y1;
    };
    Blocks blocks_of(glm::ivec2 low, glm::ivec2 high) const {
        if (high.x < first_.x || high.y < first_.y || low.x > last_.x || low.y > last_.y) return {0, 0, -1, -1};
        // The last row of the picture goes on beyond its end, the last one chosen does not.
        return {column_at(low.x), std::max(std::min((low.y - first_.y) >> kBlockShift, rows_ - 1), begin_row_),
                column_at(high.x), std::min((high.y - first_.y) >> kBlockShift, end_row_ - 1)};
    }
    static constexpr int kBeside = kSubpixelsPerPixel;  // 1 pixel
    /// The range of a polygon in the row of tiles that has a row of blocks. Rows at the rim of the picture stand for
    /// what is beyond it.
    PolygonRows::Range in_row_of_tiles(const PolygonRows& polygon, int y) const {
        constexpr double kFar = 1e9;
        const int begin = y & ~kLast, end = (y | kLast) + 1;
        const double top = begin == 0 ? -kFar : first_.y + (begin << kBlockShift),
                     bottom = end >= rows_ ? kFar : first_.y + (end << kBlockShift);
        return polygon.between(top - kBeside, bottom + kBeside);
    }
    int column_at(int x) const { return std::clamp((x - first_.x) >> kBlockShift, 0, columns_ - 1); }
    std::size_t tile_at(int x, int y) const {
        return static_cast<std::size_t>((y - begin_row_) >> kTileShift) *
                   static_cast<std::size_t>(columns_ >> kTileShift) +
               static_cast<std::size_t>(x >> kTileShift);
    }
    static std::size_t place(std::size_t tile, int x, int y) {
        return tile << (2 * kTileShift) | static_cast<std::size_t>((y & kLast) << kTileShift | (x & kLast));
    }
    bool is_nearer(std::size_t tile, const Blocks& b, float highest) const {
        for (int y = b.y0; y <= b.y1; ++y) {
            for (int x = b.x0; x <= b.x1; ++x) {
                if (highest > of_block_[place(tile, x, y)]) return true;
            }
        }
        return false;
    }
    void add(const WholeLine& line, double slack);
    void note(const Blocks& blocks, float nearness);
    void combine_blocks();

    glm::ivec2 first_, last_;                   // of the picture, in 1/256 pixel
    int columns_, rows_, begin_row_, end_row_;  // of blocks
    std::vector<float> of_tile_, of_block_;     // tile by tile
    std::vector<float> of_blocks_;              // DepthGrid::least
};

}  // namespace burin
