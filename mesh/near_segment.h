#pragma once

#include <algorithm>
#include <glm/glm.hpp>

// Boxes far from a segment are told by one quick test, so that few need an exact one.

namespace burin {

/// Whether a box comes as near to a segment as `margin`; true also for some that do not.
struct NearSegment {
    glm::dvec3 a, b;
    double margin;

    bool operator()(const glm::dvec3& low, const glm::dvec3& high) const {
        double begin = -kRounding, end = 1 + kRounding;  // shares of the way from a to b
        for (int k = 0; k < 3; ++k) {
            clip(a[k], b[k], low[k] - margin, high[k] + margin, begin, end);
        }
        return begin <= end + kRounding;
    }

  private:
    static constexpr double kRounding = 1e-9;
    /// Clips a segment to what lies between two values along one axis.
    static void clip(double from, double to, double low, double high, double& begin, double& end) {
        const double way = to - from;
        if (way == 0) {
            if (from < low || from > high) end = -1;
            return;
        }
        const double at_low = (low - from) / way, at_high = (high - from) / way;
        begin = std::max(begin, std::min(at_low, at_high));
        end = std::min(end, std::max(at_low, at_high));
    }
};

}  // namespace burin
