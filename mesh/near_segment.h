#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>

#include "mesh/four_boxes.h"

// Boxes far from a segment are told by one quick test, so that few need an exact one.

namespace burin {

/// Tells whether boxes come as near to the segment from `a` to `b` as `margin`; says so also of some that do not.
class NearSegment {
  public:
    NearSegment(const glm::dvec3& a, const glm::dvec3& b, double margin)
        : a_(a), per_way_(1.0 / (b - a)), margin_(margin) {
        for (int axis = 0; axis < 3; ++axis) is_level_[axis] = !std::isfinite(per_way_[axis]);
    }

    bool operator()(const glm::dvec3& low, const glm::dvec3& high) const {
        double begin = -kRounding, end = 1 + kRounding;  // shares of the way from a to b
        for (int axis = 0; axis < 3; ++axis) {
            const double before = low[axis] - margin_ - a_[axis], behind = high[axis] + margin_ - a_[axis];
            if (is_level_[axis]) {
                if (before > 0 || behind < 0) return false;
                continue;
            }
            const double at_low = before * per_way_[axis], at_high = behind * per_way_[axis];
            begin = std::max(begin, std::min(at_low, at_high));
            end = std::min(end, std::max(at_low, at_high));
        }
        return begin <= end + kRounding;
    }

    FourBoxes::AreNear operator()(const FourBoxes& boxes) const {
        FourBoxes::AreNear near;
        for (std::size_t k = 0; k < FourBoxes::kCount; k += 2) {
            TwoDoubles begin = two_of(-kRounding), end = two_of(1 + kRounding);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const int i = static_cast<int>(axis);
                const TwoDoubles before = boxes.two_of_low(axis, k) - (a_[i] + margin_),
                                 behind = boxes.two_of_high(axis, k) - (a_[i] - margin_);
                if (is_level_[axis]) {
                    end = (before > 0) | (behind < 0) ? two_of(-1) : end;
                    continue;
                }
                const TwoDoubles at_low = before * per_way_[i], at_high = behind * per_way_[i];
                const TwoDoubles first = at_low < at_high ? at_low : at_high,
                                 last = at_low < at_high ? at_high : at_low;
                begin = begin < first ? first : begin;
                end = end < last ? end : last;
            }
            const auto are_near = begin <= end + kRounding;
            near[k] = are_near[0] != 0;
            near[k + 1] = are_near[1] != 0;
        }
        return near;
    }

  private:
    static constexpr double kRounding = 1e-9;
    glm::dvec3 a_, per_way_;
    double margin_;
    std::array<bool, 3> is_level_{};  // both ends at one coordinate, or nearly so
};

}  // namespace burin
