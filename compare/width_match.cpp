#include "compare/width_match.h"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

constexpr double kTolerance = 0.02;
constexpr int kMaxTrials = 4;

}  // namespace

WidthMatch match_width(double wanted_px, const std::function<double(double)>& measure) {
    const auto draw = [&](double asked) {
        const double measured = measure(asked);
        return WidthMatch{asked, measured, std::abs(measured / wanted_px - 1) <= kTolerance};
    };
    const WidthMatch as_wanted = draw(wanted_px);
    WidthMatch trial = as_wanted;
    for (int i = 0; i < kMaxTrials && !trial.matches; ++i) {
        if (!(trial.measured_px > 0)) return as_wanted;
        const double asked =
            std::clamp(trial.asked_px * wanted_px / trial.measured_px, 0.25 * wanted_px, 4 * wanted_px);
        const WidthMatch next = draw(asked);
        if (next.measured_px == trial.measured_px) return as_wanted;  // it does not follow
        trial = next;
    }
    return trial.matches ? trial : as_wanted;
}

}  // namespace burin
