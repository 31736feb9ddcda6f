#include "compare/metrics_error.h"

#include <cmath>
#include <set>

namespace burin {
namespace {

std::optional<double> psnr_db(double mean_square) {
    if (mean_square <= 0) return std::nullopt;
    return -10 * std::log10(mean_square);
}

/// Coverage of `a` where `b` has no line nearby.
double lonely_coverage(const Plane& a, const Plane& b) {
    const Plane near_b = dilated(b);
    double sum = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        if (a.values[i] >= kLineFloor && near_b.values[i] < kLineFloor) sum += static_cast<double>(a.values[i]);
    }
    return sum;
}

}  // namespace

std::optional<CoverageError> coverage_error(const Plane& result, const Plane& truth) {
    std::vector<double> squares;
    for (std::size_t i = 0; i < truth.values.size(); ++i) {
        if (!(result.values[i] > 0 || truth.values[i] > 0)) continue;
        const double error = static_cast<double>(result.values[i]) - static_cast<double>(truth.values[i]);
        squares.push_back(error * error);
    }
    if (squares.empty()) return std::nullopt;
    std::sort(squares.begin(), squares.end());
    const std::size_t kept = squares.size() - squares.size() / 50;
    double sum = 0, sum98 = 0;
    for (std::size_t i = 0; i < squares.size(); ++i) {
        sum += squares[i];
        if (i < kept) sum98 += squares[i];
    }
    CoverageError e;
    e.line_pixels = squares.size();
    const double mean_square = sum / static_cast<double>(squares.size());
    e.rmse = std::sqrt(mean_square);
    e.max_error = std::sqrt(squares.back());
    e.psnr_db = psnr_db(mean_square);
    e.psnr98_db = psnr_db(sum98 / static_cast<double>(kept));
    return e;
}

std::optional<LineMass> line_mass(const Plane& result, const Plane& truth) {
    double total = 0;
    for (const float alpha : truth.values) total += static_cast<double>(alpha);
    if (!(total > 0)) return std::nullopt;
    return LineMass{lonely_coverage(truth, result) / total, lonely_coverage(result, truth) / total};
}

std::size_t coverage_levels(const Plane& result) {
    std::set<long> levels;
    for (const float alpha : result.values) levels.insert(std::lround(255 * alpha));
    levels.erase(0);
    return levels.size();
}

}  // namespace burin
