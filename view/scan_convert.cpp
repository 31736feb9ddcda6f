#include "view/scan_convert.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace burin {
namespace {

std::int64_t ceil_divide(std::int64_t a, std::int64_t positive_b) {
    return a >= 0 ? (a + positive_b - 1) / positive_b : -(-a / positive_b);
}
/// ceil_divide() by means of a number that is about 1 / b: a division takes longer than all else.
std::int64_t ceil_divide(std::int64_t a, std::int64_t positive_b, double per_b) {
    auto quotient = static_cast<std::int64_t>(static_cast<double>(a) * per_b);
    while (quotient * positive_b < a) ++quotient;
    while ((quotient - 1) * positive_b >= a) --quotient;
    return quotient;
}

constexpr std::int64_t kPitch = ScanEdge::kPitch, kHalfPitch = kPitch / 2;
static_assert(kPitch == 2 * kSubpixelsPerPixel);
constexpr double kLargestProduct = 0x1p52;

/// The first sample at or behind a position.
int first_sample_from(std::int64_t position) { return static_cast<int>(ceil_divide(position - kHalfPitch, kPitch)); }

}  // namespace

ScanConverter::ScanConverter(const ScreenPolygon& polygon, int samples_per_pixel) {
    if (polygon.count == 0) return;
    const std::int64_t scale = 2 * samples_per_pixel;
    std::int64_t low_x = std::numeric_limits<std::int64_t>::max(), high_x = -low_x;
    std::int64_t low_y = low_x, high_y = high_x;
    for (int i = 0; i < polygon.count; ++i) {
        const SubpixelPoint a = polygon.corners[static_cast<std::size_t>(i)];
        const SubpixelPoint b = polygon.corners[static_cast<std::size_t>((i + 1) % polygon.count)];
        const std::int64_t ax = scale * a.x, ay = scale * a.y;
        const std::int64_t bx = scale * b.x, by = scale * b.y;
        low_x = std::min(low_x, ax);
        high_x = std::max(high_x, ax);
        low_y = std::min(low_y, ay);
        high_y = std::max(high_y, ay);
        if (ay == by) continue;
        const double height = static_cast<double>(std::abs(by - ay)),
                     per_dy = 1.0 / (static_cast<double>(kPitch) * height);
        edges_[edge_count_++] = ay < by ? ScanEdge{ax, ay, bx, by, per_dy} : ScanEdge{bx, by, ax, ay, per_dy};
        const auto farthest = static_cast<double>(std::max(std::abs(ax), std::abs(bx)) + kPitch);
        fits_doubles_ = fits_doubles_ && 4 * farthest * height < kLargestProduct;
    }
    first_row_ = first_sample_from(low_y);
    end_row_ = first_sample_from(high_y);
    first_column_ = first_sample_from(low_x);
    end_column_ = first_sample_from(high_x);
}

SampleSpan ScanConverter::columns_in(int first, int end) const {
    const auto middle = [](int row) { return static_cast<double>(kPitch * row + kHalfPitch); };
    const double top = middle(first), bottom = middle(end - 1);
    constexpr double kFar = 1e9;  // samples
    double low = kFar, high = -kFar;
    for (const ScanEdge& e : edges()) {
        const auto x0 = static_cast<double>(e.x0), y0 = static_cast<double>(e.y0), y1 = static_cast<double>(e.y1);
        if (y1 <= top || y0 > bottom) continue;
        const double per_row = static_cast<double>(e.x1 - e.x0) * e.per_dy;  // samples per unit
        const double column = (x0 - kHalfPitch) / kPitch;
        const double at_top = column + (std::max(top, y0) - y0) * per_row,
                     at_bottom = column + (std::min(bottom, y1) - y0) * per_row;
        low = std::min({low, at_top, at_bottom});
        high = std::max({high, at_top, at_bottom});
    }
    // Rounding is off by far less than a sample, and a covered sample lies at a whole number from `low` on and before
    // `high`.
    if (low > high) return {};
    const int left = static_cast<int>(low), right = static_cast<int>(high);
    return {left - (low < left ? 1 : 0), right + (high > right ? 2 : 1)};
}

SampleSpan ScanConverter::span(int row) const {
    const std::int64_t y = kPitch * row + kHalfPitch;
    SampleSpan span{std::numeric_limits<int>::max(), std::numeric_limits<int>::min()};
    for (const ScanEdge& e : edges()) {
        if (y < e.y0 || y >= e.y1) continue;
        // The edge meets the row at x = x0 + (y - y0) (x1 - x0) / (y1 - y0).
        const std::int64_t dy = e.y1 - e.y0;
        const std::int64_t x_times_dy = (e.x0 - kHalfPitch) * dy + (y - e.y0) * (e.x1 - e.x0);
        const int sample = static_cast<int>(ceil_divide(x_times_dy, kPitch * dy, e.per_dy));
        span.begin = std::min(span.begin, sample);
        span.end = std::max(span.end, sample);
    }
    return span;
}

}  // namespace burin
