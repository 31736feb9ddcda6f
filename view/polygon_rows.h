#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace burin {

/// Tells where a polygon lies within a row of tiles: long polygons touch few of the tiles that their boxes touch.
class PolygonRows {
  public:
    struct Corner {
        double x, y;
    };
    /// A range of x; nothing if `low` is greater than `high`.
    struct Range {
        double low = kFar, high = -kFar;
        bool is_empty() const { return low > high; }
    };

    /// The corners must stay where they are.
    explicit PolygonRows(std::span<const Corner> corners) : corners_(corners) {}

    /// The least and the greatest x of the polygon between two values of y, both included, but for rounding.
    Range between(double top, double bottom) const {
        Range range;
        const auto reach = [&range](double x) {
            range.low = std::min(range.low, x);
            range.high = std::max(range.high, x);
        };
        // The extremes lie on its boundary, whatever its shape.
        for (std::size_t k = 0; k < corners_.size(); ++k) {
            const Corner a = corners_[k], b = corners_[k + 1 == corners_.size() ? 0 : k + 1];
            const auto [low, high] = std::minmax(a.y, b.y);
            if (high < top || low > bottom) continue;
            if (low == high) {
                reach(a.x);
                reach(b.x);
                continue;
            }
            const double per_y = (b.x - a.x) / (b.y - a.y);
            reach(a.x + per_y * (std::clamp(top, low, high) - a.y));
            reach(a.x + per_y * (std::clamp(bottom, low, high) - a.y));
        }
        return range;
    }

  private:
    static constexpr double kFar = 1e300;
    std::span<const Corner> corners_;
};

}  // namespace burin
