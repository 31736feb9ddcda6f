#include "output/paths/dash_pattern.h"

#include <cmath>

namespace burin {
namespace {

/// How much patterns of dashes may differ in their period, as a factor, and in the shares that parts have of it.
constexpr double kMostStretch = 1.5, kOtherShare = 0.04;

}  // namespace

bool is_one_pattern(std::span<const float> a, std::span<const float> b) {
    if (a.size() != b.size()) return false;
    double a_period = 0, b_period = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        a_period += static_cast<double>(a[i]);
        b_period += static_cast<double>(b[i]);
    }
    if (a_period > kMostStretch * b_period || b_period > kMostStretch * a_period) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double off = static_cast<double>(a[i]) * b_period - static_cast<double>(b[i]) * a_period;
        if (std::abs(off) > kOtherShare * a_period * b_period) return false;
    }
    return true;
}

}  // namespace burin
