#include "render/sub_frames.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace burin {
namespace {

constexpr double kLeastBlurPx = 1.0 / 16;
constexpr int kFewest = 8, kMost = 256;
/// Cosine and sine of the golden angle, pi (3 - sqrt 5). Those of its multiples follow by turning, for C libraries
/// round sines in different ways.
constexpr double kCosGolden = -0.73736887807831987, kSinGolden = 0.67549029426152362;
constexpr double kGoldenRatio = 1.618034;

}  // namespace

double shutter_time(const ShutterSettings& s, double part) {
    // The integral of the curve: a parabola while the shutter opens, a straight line, a parabola while it closes.
    const double light = 1 - 0.5 * (s.rise + s.fall), so_far = part * light;
    double x = so_far + 0.5 * s.rise;
    if (so_far < 0.5 * s.rise) {
        x = std::sqrt(2 * s.rise * so_far);
    } else if (const double left = light - so_far; left < 0.5 * s.fall) {
        x = 1 - std::sqrt(2 * s.fall * std::max(left, 0.0));
    }
    return s.open + (s.close - s.open) * std::clamp(x, 0.0, 1.0);
}

std::vector<glm::dvec2> lens_points(int count) {
    std::vector<glm::dvec2> points;
    glm::dvec2 direction(1, 0);
    for (int j = 0; j < count; ++j) {
        points.push_back(std::sqrt((j + 0.5) / count) * direction);
        direction = {direction.x * kCosGolden - direction.y * kSinGolden,
                     direction.x * kSinGolden + direction.y * kCosGolden};
    }
    return points;
}

int lens_step(int count) {
    int step = static_cast<int>(std::ceil(count / kGoldenRatio));
    while (std::gcd(step, count) != 1) ++step;
    return step;
}

int automatic_sub_frames(double way_px, double circle_px) {
    if (!(way_px >= kLeastBlurPx || circle_px >= kLeastBlurPx)) return 1;
    const double wanted = std::ceil(std::max(way_px, 16 + 5 * circle_px));
    return wanted < kMost ? std::max(static_cast<int>(wanted), kFewest) : kMost;
}

std::vector<SubFrame> sub_frames(const ShutterSettings* shutter, bool has_lens, int count) {
    std::vector<SubFrame> all(static_cast<std::size_t>(count));
    const std::vector<glm::dvec2> points = has_lens ? lens_points(count) : std::vector<glm::dvec2>{};
    const auto step = static_cast<std::int64_t>(lens_step(count));
    for (int i = 0; i < count; ++i) {
        SubFrame& sub = all[static_cast<std::size_t>(i)];
        if (shutter != nullptr) sub.time = shutter_time(*shutter, (i + 0.5) / count);
        if (has_lens) sub.lens = points[static_cast<std::size_t>(i * step % count)];
    }
    return all;
}

SubFrame middle_sub_frame(const ShutterSettings* shutter) {
    return {shutter == nullptr ? 0 : 0.5 * (shutter->open + shutter->close), {}};
}

}  // namespace burin
