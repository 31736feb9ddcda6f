#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace burin {

/// DashPen says which parts of a line are dashes, visible or hidden, from where they stand along its chain.
class DashPen {
  public:
    /// `dash_px`: lengths of a dash, with the round ends of a pen of this width, and of a gap.
    DashPen(std::array<double, 2> dash_px, double width_px)
        : on_px_(dash_px[0]), period_px_(dash_px[0] + dash_px[1]), inset_px_(std::min(0.5 * on_px_, 0.5 * width_px)) {}

    double period_px() const { return period_px_; }

    /// Calls visit(first, last) for the strokes of a straight piece whose ends stand at `begin` and `end` along its
    /// chain, either way round: where they stand, the lower one first. `per_px`: by how much that grows in a pixel, 1
    /// unless dashes are stretched. A dash no longer than the pen is wide is a dot, about the length of which a stroke
    /// may go beyond the piece.
    template <typename Visit>
    void for_dashes(double begin, double end, double per_px, const Visit& visit) const {
        if (begin == end) return;
        const double inset = inset_px_ * per_px, on = on_px_ - inset, low = std::min(begin, end),
                     high = std::max(begin, end);
        const bool is_dotted = on_px_ - 2 * inset_px_ < kDotPx;
        for (double dash = std::floor(low / period_px_); dash * period_px_ <= high; ++dash) {
            const double first = std::max(low, dash * period_px_ + inset);
            const double last = std::min(high, std::max(dash * period_px_ + inset, dash * period_px_ + on));
            if (first > last) continue;
            if (is_dotted) {
                const double middle = 0.5 * (first + last), half = 0.5 * kDotPx * per_px;
                visit(middle - half, middle + half);
            } else {
                visit(first, last);
            }
        }
    }

  private:
    /// The length of what is drawn as a dot: with a length it has a direction, and so sides.
    static constexpr double kDotPx = 1.0 / 256;

    double on_px_, period_px_, inset_px_;
};

}  // namespace burin
