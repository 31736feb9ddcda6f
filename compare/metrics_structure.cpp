#include "compare/metrics_structure.h"

#include <array>
#include <cmath>

namespace burin {
namespace {

constexpr int kRadius = 5;
constexpr std::array kScaleWeights = {.0448, .2856, .3001, .2363, .1333};
constexpr int kMinMultiScaleSide = 176;  // eleven pixels at the coarsest scale

/// The two factors of SSIM, each averaged: contrast-structure alone, and all together.
struct Similarity {
    double contrast_structure = 0;
    double all = 0;
};

Plane product(const Plane& a, const Plane& b) {
    Plane result(a.width, a.height);
    for (std::size_t i = 0; i < a.values.size(); ++i) result.values[i] = a.values[i] * b.values[i];
    return result;
}

Similarity similarity(const Plane& a, const Plane& b, int threads) {
    const std::vector<float> window = gaussian_kernel(1.5, kRadius);
    const auto blur = [&](const Plane& p) { return convolve(p, window, window, threads); };
    const Plane mean_a = blur(a), mean_b = blur(b);
    const Plane aa = blur(product(a, a)), bb = blur(product(b, b)), ab = blur(product(a, b));
    constexpr double c1 = .01 * .01, c2 = .03 * .03;
    Similarity sum;
    for (int y = kRadius; y < a.height - kRadius; ++y) {
        for (int x = kRadius; x < a.width - kRadius; ++x) {
            const auto at = [x, y](const Plane& p) { return static_cast<double>(p.at(x, y)); };
            const double ma = at(mean_a), mb = at(mean_b);
            const double variances = at(aa) - ma * ma + at(bb) - mb * mb;
            const double covariance = at(ab) - ma * mb;
            const double cs = (2 * covariance + c2) / (variances + c2);
            sum.contrast_structure += cs;
            sum.all += cs * (2 * ma * mb + c1) / (ma * ma + mb * mb + c1);
        }
    }
    const double windows = static_cast<double>(a.width - 2 * kRadius) * (a.height - 2 * kRadius);
    return {sum.contrast_structure / windows, sum.all / windows};
}

}  // namespace

std::optional<double> ssim(const Plane& a, const Plane& b, int threads) {
    if (std::min(a.width, a.height) <= 2 * kRadius) return std::nullopt;
    return similarity(a, b, threads).all;
}

std::optional<double> ms_ssim(const Plane& a, const Plane& b, int threads) {
    if (std::min(a.width, a.height) < kMinMultiScaleSide) return std::nullopt;
    Plane p = a, q = b;
    double result = 1;
    for (std::size_t scale = 0; scale < kScaleWeights.size(); ++scale) {
        const Similarity s = similarity(p, q, threads);
        const bool last = scale + 1 == kScaleWeights.size();
        result *= std::pow(std::max(0.0, last ? s.all : s.contrast_structure), kScaleWeights[scale]);
        p = halved(p);
        q = halved(q);
    }
    return result;
}

}  // namespace burin
