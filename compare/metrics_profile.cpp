#include "compare/metrics_profile.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

namespace burin {
namespace {

constexpr double kStepAcross_px = 0.125;

/// Area of a unit square on the side u <= t of a line with unit normal n through a point t away
/// from the square's centre.
double half_plane_area(double t, glm::dvec2 n) {
    const double a = std::max(std::abs(n.x), std::abs(n.y)), b = std::min(std::abs(n.x), std::abs(n.y));
    if (b < 1e-9) return std::clamp(t / a + 0.5, 0.0, 1.0);
    // The square's shadow on the normal is a trapezoid: the convolution of boxes of widths a and b.
    const auto ramp2 = [](double x) { return x > 0 ? x * x : 0.0; };
    const double outer = 0.5 * (a + b), inner = 0.5 * (a - b);
    return std::clamp((ramp2(t + outer) - ramp2(t + inner) - ramp2(t - inner) + ramp2(t - outer)) / (2 * a * b), 0.0,
                      1.0);
}

std::size_t bin_count(double reach_px) {
    return static_cast<std::size_t>(std::ceil(2 * reach_px / LineSpread::kBin_px));
}

/// Points sorted into the bins of a line spread.
std::vector<std::vector<ProfilePoint>> binned(std::span<const ProfilePoint> points, double reach_px) {
    std::vector<std::vector<ProfilePoint>> bins(bin_count(reach_px));
    for (const ProfilePoint& p : points) {
        const double position = std::floor((p.u + reach_px) / LineSpread::kBin_px);
        if (position >= 0 && position < static_cast<double>(bins.size())) {
            bins[static_cast<std::size_t>(position)].push_back(p);
        }
    }
    return bins;
}

/// Sum of squared distances of a bin's coverages from their regression line.
double residual(const std::vector<ProfilePoint>& bin) {
    const double n = static_cast<double>(bin.size());
    double u = 0, c = 0, uu = 0, uc = 0, cc = 0;
    for (const ProfilePoint& p : bin) {
        u += p.u / n;
        c += p.coverage / n;
    }
    for (const ProfilePoint& p : bin) {
        uu += (p.u - u) * (p.u - u);
        uc += (p.u - u) * (p.coverage - c);
        cc += (p.coverage - c) * (p.coverage - c);
    }
    return std::max(0.0, cc - (uu > 1e-9 ? uc * uc / uu : 0.0));
}

}  // namespace

double band_coverage(double u, glm::dvec2 across, double width_px) {
    return half_plane_area(u + 0.5 * width_px, across) - half_plane_area(u - 0.5 * width_px, across);
}

std::vector<double> widths_along(const Plane& coverage, const Segment& segment, double reach_px) {
    std::vector<double> widths;
    const glm::dvec2 along = segment.along(), across = segment.across();
    const double length = segment.length();
    const int steps = static_cast<int>(std::floor(2 * reach_px / kStepAcross_px));
    // A little slack, so that lines of equal length have equally many places.
    const int places = static_cast<int>(std::floor((length - 2 * kEndMargin_px) / kWidthStep_px + 1e-6)) + 1;
    for (int place = 0; place < places; ++place) {
        const double s = kEndMargin_px + place * kWidthStep_px;
        double sum = 0;
        for (int i = 0; i <= steps; ++i) {
            const double u = -reach_px + i * kStepAcross_px;
            const glm::dvec2 p = segment.a + along * s + across * u;
            sum += static_cast<double>(sample_bilinear(coverage, p.x, p.y));
        }
        widths.push_back(sum * kStepAcross_px);
    }
    return widths;
}

std::vector<double> smoothed_along(std::span<const double> widths, double window_px) {
    const auto count = static_cast<std::size_t>(std::max(1.0, std::round(window_px / kWidthStep_px)));
    std::vector<double> means;
    for (std::size_t i = 0; i + count <= widths.size(); ++i) means.push_back(mean_of(widths.subspan(i, count)));
    return means;
}

double mean_of(std::span<const double> values) {
    if (values.empty()) return 0;
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double deviation_of(std::span<const double> values) {
    if (values.empty()) return 0;
    const double mean = mean_of(values);
    double sum = 0;
    for (const double v : values) sum += (v - mean) * (v - mean);
    return std::sqrt(sum / static_cast<double>(values.size()));
}

double median_of(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::vector<ProfilePoint> profile_points(const Plane& coverage, const Segment& segment, double reach_px,
                                         double width_px) {
    std::vector<ProfilePoint> points;
    const glm::dvec2 along = segment.along(), across = segment.across();
    const glm::dvec2 low = glm::min(segment.a, segment.b) - reach_px, high = glm::max(segment.a, segment.b) + reach_px;
    const int x0 = std::max(0, static_cast<int>(std::floor(low.x)));
    const int y0 = std::max(0, static_cast<int>(std::floor(low.y)));
    const int x1 = std::min(coverage.width, static_cast<int>(std::ceil(high.x)));
    const int y1 = std::min(coverage.height, static_cast<int>(std::ceil(high.y)));
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            const glm::dvec2 from_a = glm::dvec2(x + 0.5, y + 0.5) - segment.a;
            const double s = glm::dot(from_a, along), u = glm::dot(from_a, across);
            if (std::abs(u) > reach_px || s < kEndMargin_px || s > segment.length() - kEndMargin_px) continue;
            points.push_back({u, static_cast<double>(coverage.at(x, y)), band_coverage(u, across, width_px)});
        }
    }
    return points;
}

LineSpread line_spread(std::span<const ProfilePoint> points, double reach_px) {
    LineSpread spread;
    spread.first_u = -reach_px + 0.5 * LineSpread::kBin_px;
    for (const auto& bin : binned(points, reach_px)) {
        double sum = 0;
        for (const ProfilePoint& p : bin) sum += p.coverage;
        spread.mean.push_back(bin.empty() ? 0.0 : sum / static_cast<double>(bin.size()));
    }
    return spread;
}

std::optional<double> within_bin_deviation(std::span<const ProfilePoint> points, double reach_px) {
    double sum = 0, count = 0;
    for (const auto& bin : binned(points, reach_px)) {
        if (bin.size() < 3) continue;
        sum += residual(bin);
        count += static_cast<double>(bin.size());
    }
    if (count == 0) return std::nullopt;
    return std::sqrt(sum / count);
}

std::optional<Modulation> modulation(const LineSpread& spread) {
    const double total = std::accumulate(spread.mean.begin(), spread.mean.end(), 0.0);
    if (!(total > 0)) return std::nullopt;
    Modulation m;
    double energy = 0, high_energy = 0;
    for (int k = 0; k * Modulation::kStep <= 2; ++k) {
        const double frequency = k * Modulation::kStep;
        std::complex<double> sum = 0;
        for (std::size_t i = 0; i < spread.mean.size(); ++i) {
            const double u = spread.first_u + static_cast<double>(i) * LineSpread::kBin_px;
            sum += spread.mean[i] * std::polar(1.0, -2 * std::numbers::pi * frequency * u);
        }
        const double value = std::abs(sum) / total;
        if (!m.mtf50 && value < 0.5) {
            const double before = m.values.back();
            m.mtf50 = frequency - Modulation::kStep * (0.5 - value) / (before - value);
        }
        m.values.push_back(value);
        energy += value * value;
        if (frequency > 0.5) high_energy += value * value;
    }
    m.energy_above_nyquist = high_energy / energy;
    return m;
}

}  // namespace burin
