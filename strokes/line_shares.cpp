#include "strokes/line_shares.h"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

/// Brings shares above 0 so that their sum stays, where it is from 0 to 1.
template <typename Chosen>
void clamp_sum(std::vector<LineShare>& lines, const Chosen& is_chosen) {
    float sum = 0, positive = 0;
    for (LineShare& line : lines) {
        if (!is_chosen(line)) continue;
        sum += line.share;
        line.share = std::max(line.share, 0.0f);
        positive += line.share;
    }
    const float scale = positive > 0 ? std::clamp(sum, 0.0f, 1.0f) / positive : 0.0f;
    for (LineShare& line : lines) {
        if (is_chosen(line)) line.share *= scale;
    }
}

}  // namespace

void bring_into_range(std::vector<LineShare>& lines, float opaque, bool is_filtered) {
    const auto is_above = [](const LineShare& line) { return !line.is_below; };
    const auto is_below = [](const LineShare& line) { return line.is_below; };
    if (is_filtered) {
        clamp_sum(lines, is_above);
        clamp_sum(lines, is_below);
    }
    float below = 0;
    for (const LineShare& line : lines) below += line.is_below ? line.share : 0;
    if (below == 0) return;
    const float left = 1.0f - std::clamp(opaque, 0.0f, 1.0f);
    const float scale = left > 0 ? std::min(1.0f / left, 1.0f / std::max(below, 1e-6f)) : 0.0f;
    for (LineShare& line : lines) {
        if (line.is_below) line.share *= scale;
    }
}

float in_share_steps(float share) {
    constexpr float steps = 1 << 14;
    return std::round(share * steps) / steps;
}

}  // namespace burin
