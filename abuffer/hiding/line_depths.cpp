#include "abuffer/hiding/line_depths.h"

#include <cmath>
#include <limits>

namespace burin {
namespace {

constexpr double kFarthest = 1 << 28;  // 1/256 pixel
constexpr float kNoLine = std::numeric_limits<float>::infinity();

}  // namespace

LineDepths::LineDepths(std::span<const WholeLine> lines, const PixelTiles& tiles,
                       const std::function<double(const WholeLine&)>& slack_of) {
    const PixelRect all = tiles.all_rows().rect();
    first_ = glm::ivec2(all.x0, all.y0) * kSubpixelsPerPixel;
    last_ = glm::ivec2(all.x1, all.y1) * kSubpixelsPerPixel;
    const int per_tile = 1 << kTileShift;
    columns_ = tiles.columns() * per_tile;
    rows_ = tiles.all_rows().rows().end * per_tile;
    begin_row_ = tiles.rows().begin * per_tile;
    end_row_ = tiles.rows().end * per_tile;
    of_tile_.assign(tiles.count(), kNoLine);
    of_block_.assign(tiles.count() << (2 * kTileShift), kNoLine);
    for (const WholeLine& line : lines) add(line, slack_of(line));
    combine_blocks();
}

void LineDepths::combine_blocks() {
    const std::size_t page = of_block_.size();
    of_blocks_.resize(4 * page);
    const auto of_block = [this](int x, int y) {
        x = std::min(x, columns_ - 1);
        y = std::min(y, end_row_ - 1);
        return of_block_[place(tile_at(x, y), x, y)];
    };
    float* at = of_blocks_.data();
    for (int y = begin_row_; y < end_row_; ++y) {
        float own = of_block(0, y), own_or_below = std::min(own, of_block(0, y + 1));
        for (int x = 0; x < columns_; ++x) {
            const float right = of_block(x + 1, y), right_or_below = std::min(right, of_block(x + 1, y + 1));
            at[0] = own;
            at[page] = std::min(own, right);
            at[2 * page] = own_or_below;
            at[3 * page] = std::min(own_or_below, right_or_below);
            ++at;
            own = right;
            own_or_below = right_or_below;
        }
    }
}

void LineDepths::add(const WholeLine& line, double slack) {
    const float least = std::nextafter(static_cast<float>(line.lowest_in(0, 1) - slack), -kNoLine);
    // Ends of lines that are cut lie about where the guard band ends, as exactly as the line is long.
    const auto whole = [](glm::dvec2 p) { return glm::ivec2(glm::clamp(p, -kFarthest, kFarthest)); };
    const Blocks b =
        blocks_of(whole(glm::floor(glm::min(line.from, line.to))), whole(glm::ceil(glm::max(line.from, line.to))));
    if (b.x1 - b.x0 <= 1 || b.y1 - b.y0 <= 1) return note(b, least);
    // Row by row, the part of the line in it, and a bit; what is beside the picture is in the row at its rim.
    const glm::dvec2 along = line.to - line.from;
    for (int y = b.y0; y <= b.y1; ++y) {
        const double top = first_.y + (y << kBlockShift) - 1.0, bottom = top + (1 << kBlockShift) + 2.0;
        const auto x_at = [&](double row) {
            return line.from.x + along.x * std::clamp((row - line.from.y) / along.y, 0.0, 1.0);
        };
        const auto [left, right] =
            std::minmax({y == 0 ? x_at(-1e30) : x_at(top), y == rows_ - 1 ? x_at(1e30) : x_at(bottom)});
        note({column_at(whole({left - 1, 0}).x - 1), y, column_at(whole({right + 1, 0}).x + 1), y}, least);
    }
}

void LineDepths::note(const Blocks& b, float nearness) {
    for (int y = b.y0; y <= b.y1; ++y) {
        for (int x = b.x0; x <= b.x1; ++x) {
            const std::size_t tile = tile_at(x, y);
            float& of_block = of_block_[place(tile, x, y)];
            of_block = std::min(of_block, nearness);
            of_tile_[tile] = std::min(of_tile_[tile], nearness);
        }
    }
}

}  // namespace burin
