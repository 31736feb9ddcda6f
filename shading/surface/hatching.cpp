#include "shading/surface/hatching.h"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

/// What the lines of a level cover when the next level begins.
constexpr double kFullLevel = 0.4;

/// The integral of what lines cover, from the middle of line 0 on.
double covered_up_to(double place, double width) {
    const double line = std::floor(place + 0.5), half = 0.5 * width;
    return line * width + std::clamp(place - line, -half, half);
}

/// Lines at the even numbers and lines at the odd ones, each of a width of their own.
double covered_by_two(double place, double length, double even, double odd) {
    return covered_by_lines(0.5 * place, 0.5 * length, 0.5 * even) +
           covered_by_lines(0.5 * (place - 1), 0.5 * length, 0.5 * odd);
}

}  // namespace

double HatchLevels::coverage(int level, double tone) const {
    double begin = 1;  // the tone at which the level begins
    for (int i = 0; i < level; ++i) begin *= 1 - kFullLevel;
    if (tone >= begin) return 0;
    const double covered = 1 - tone / begin;
    return level + 1 < count ? std::min(covered, kFullLevel) : covered;
}

double covered_by_lines(double place, double length, double width) {
    const double begin = covered_up_to(place - 0.5 * length, width), end = covered_up_to(place + 0.5 * length, width);
    return std::max(0.0, std::min(1.0, (end - begin) / length));  // what is no number becomes 1
}

double covered_by_adaptive_lines(double place, double per_px, double spacing_px, double width) {
    // The distance of the denser lines on the screen is from half of the spacing to all of it. As it falls from all to
    // half, every other line goes, and those that stay take what it leaves.
    const double wanted = std::max(1e-200, std::min(1e200, per_px * spacing_px));
    const int exponent = std::ilogb(wanted);
    const double distance = std::ldexp(1.0, exponent), beyond = wanted / distance - 1;
    const double odd = width * (1 - beyond), even = 2 * width - odd;
    return std::min(1.0, covered_by_two(place / distance, per_px / distance, even, odd));
}

}  // namespace burin
