#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "image/image.h"
#include "kernels/subpixel.h"
#include "view/polygon_rows.h"

// A picture is cut into square tiles, and what touches each tile is kept in lists.

namespace burin {

/// Some rows of tiles: [begin, end).
struct TileRows {
    int begin = 0, end = 0;
};

/// A rectangle of pixels cut into square tiles, row by row.
class PixelTiles {
  public:
    /// `tile_px`: a power of two.
    PixelTiles(PixelRect region, int tile_px)
        : region_(region),
          tile_px_(tile_px),
          shift_(std::countr_zero(static_cast<unsigned>(tile_px * kSubpixelsPerPixel))),
          columns_((region.width() + tile_px - 1) / tile_px),
          rows_{0, (region.height() + tile_px - 1) / tile_px},
          chosen_(rows_) {}

    /// Chooses some rows of the same tiles, which are numbered from 0 again.
    PixelTiles only(TileRows rows) const {
        PixelTiles part = *this;
        part.chosen_ = rows;
        return part;
    }

    /// Chooses all rows.
    PixelTiles all_rows() const { return only(rows_); }

    TileRows rows() const { return chosen_; }
    int tile_px() const { return tile_px_; }
    int columns() const { return columns_; }
    std::size_t count() const {
        return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(chosen_.end - chosen_.begin);
    }
    PixelRect tile(std::size_t index) const {
        const int x0 = region_.x0 + static_cast<int>(index) % columns_ * tile_px_;
        const int y0 = region_.y0 + (chosen_.begin + static_cast<int>(index) / columns_) * tile_px_;
        return {x0, y0, std::min(x0 + tile_px_, region_.x1), std::min(y0 + tile_px_, region_.y1)};
    }
    /// The pixels of all tiles.
    PixelRect rect() const {
        return {region_.x0, region_.y0 + chosen_.begin * tile_px_, region_.x1,
                std::min(region_.y0 + chosen_.end * tile_px_, region_.y1)};
    }
    /// Calls visit(tile) for the tiles that touch the box from `low` to `high`, in pixels.
    template <typename Visit>
    void visit(glm::dvec2 low, glm::dvec2 high, const Visit& visit) const {
        if (!(high.x >= region_.x0 && high.y >= region_.y0 && low.x <= region_.x1 && low.y <= region_.y1)) return;
        const int x0 = index_along(low.x - region_.x0, columns_), x1 = index_along(high.x - region_.x0, columns_);
        const int y0 = std::max(index_along(low.y - region_.y0, rows_.end), chosen_.begin);
        const int y1 = std::min(index_along(high.y - region_.y0, rows_.end), chosen_.end - 1);
        for (int y = y0; y <= y1; ++y) {
            for (int x = x0; x <= x1; ++x) visit(static_cast<std::uint32_t>((y - chosen_.begin) * columns_ + x));
        }
    }

    /// Calls visit(tile) for the tiles that touch the box, without those that a polygon within the box passes by,
    /// farther than a pixel. The polygon's corners are in units of which there are `per_px` in a pixel.
    template <typename Visit>
    void visit(glm::dvec2 low, glm::dvec2 high, const PolygonRows& polygon, double per_px, const Visit& visit) const {
        if (!(high.x >= region_.x0 && high.y >= region_.y0 && low.x <= region_.x1 && low.y <= region_.y1)) return;
        constexpr double kBesidePx = 1, kFarPx = 1e9;
        const int x0 = index_along(low.x - region_.x0, columns_), x1 = index_along(high.x - region_.x0, columns_);
        const int y0 = std::max(index_along(low.y - region_.y0, rows_.end), chosen_.begin);
        const int y1 = std::min(index_along(high.y - region_.y0, rows_.end), chosen_.end - 1);
        for (int y = y0; y <= y1; ++y) {
            // Tiles at the rim of the picture stand for what is beyond it.
            const double top = y == 0 ? -kFarPx : region_.y0 + y * tile_px_,
                         bottom = y == rows_.end - 1 ? kFarPx : region_.y0 + (y + 1) * tile_px_;
            const PolygonRows::Range range = polygon.between((top - kBesidePx) * per_px, (bottom + kBesidePx) * per_px);
            if (range.is_empty()) continue;
            const int first = std::max(x0, index_along(range.low / per_px - kBesidePx - region_.x0, columns_));
            const int last = std::min(x1, index_along(range.high / per_px + kBesidePx - region_.x0, columns_));
            for (int x = first; x <= last; ++x) visit(static_cast<std::uint32_t>((y - chosen_.begin) * columns_ + x));
        }
    }

    /// Calls visit(tile) for the tiles that touch a box in 1/256 pixel.
    template <typename Visit>
    void visit(glm::ivec2 low, glm::ivec2 high, const Visit& visit) const {
        const glm::ivec2 first = glm::ivec2(region_.x0, region_.y0) * kSubpixelsPerPixel;
        const glm::ivec2 last = glm::ivec2(region_.x1, region_.y1) * kSubpixelsPerPixel;
        if (high.x < first.x || high.y < first.y || low.x > last.x || low.y > last.y) return;
        const auto index = [this](int offset, int count) { return std::clamp(offset >> shift_, 0, count - 1); };
        const int x0 = index(low.x - first.x, columns_), x1 = index(high.x - first.x, columns_);
        const int y0 = std::max(index(low.y - first.y, rows_.end), chosen_.begin);
        const int y1 = std::min(index(high.y - first.y, rows_.end), chosen_.end - 1);
        for (int y = y0; y <= y1; ++y) {
            for (int x = x0; x <= x1; ++x) visit(static_cast<std::uint32_t>((y - chosen_.begin) * columns_ + x));
        }
    }

  private:
    int index_along(double offset_px, int count) const {
        return static_cast<int>(std::clamp(std::floor(offset_px / tile_px_), 0.0, static_cast<double>(count - 1)));
    }

    PixelRect region_;
    int tile_px_, shift_, columns_;
    TileRows rows_, chosen_;
};

/// A list of values per tile, all in one block of memory.
template <typename Value>
class TileLists {
  public:
    struct Record {
        std::uint32_t tile;
        Value value;
    };

    TileLists() = default;
    /// Keeps the order of the records, list after list.
    TileLists(const std::vector<std::vector<Record>>& records, std::size_t tile_count) {
        end_.assign(tile_count + 1, 0);
        for (const auto& list : records) {
            for (const Record& r : list) ++end_[r.tile + 1];
        }
        for (std::size_t i = 1; i < end_.size(); ++i) end_[i] += end_[i - 1];
        values_.resize(end_.back());
        std::vector<std::size_t> next = end_;
        for (const auto& list : records) {
            for (const Record& r : list) values_[next[r.tile]++] = r.value;
        }
    }
    std::span<const Value> of(std::size_t tile) const {
        return {values_.data() + end_[tile], end_[tile + 1] - end_[tile]};
    }

  private:
    std::vector<std::size_t> end_;
    std::vector<Value> values_;
};

}  // namespace burin
