#include "compare/metrics_temporal.h"

#include <cmath>

#include "compare/metrics_profile.h"

namespace burin {

double total_coverage(const Plane& plane) {
    double sum = 0;
    for (const float v : plane.values) sum += static_cast<double>(v);
    return sum;
}

std::optional<Flicker> flicker(const std::vector<Plane>& result, const std::vector<Plane>& truth) {
    const std::size_t frames = truth.size();
    if (frames < 2) return std::nullopt;
    Plane near_line = truth.front();
    for (const Plane& t : truth) {
        for (std::size_t i = 0; i < t.values.size(); ++i) {
            near_line.values[i] = std::max(near_line.values[i], t.values[i]);
        }
    }
    near_line = dilated(near_line);
    Flicker f;
    double sum = 0, pixels = 0;
    for (std::size_t i = 0; i < near_line.values.size(); ++i) {
        double mean = 0, squares = 0;
        for (std::size_t j = 0; j < frames; ++j) {
            const double error = static_cast<double>(result[j].values[i]) - static_cast<double>(truth[j].values[i]);
            mean += error;
            squares += error * error;
            if (j == 0) continue;
            const auto jump = [i, j](const std::vector<Plane>& p) {
                return std::abs(static_cast<double>(p[j].values[i]) - static_cast<double>(p[j - 1].values[i]));
            };
            f.pop = std::max(f.pop, jump(result) - jump(truth));
        }
        if (!(near_line.values[i] > 0)) continue;
        const double n = static_cast<double>(frames);
        mean /= n;
        sum += std::sqrt(std::max(0.0, squares / n - mean * mean));
        ++pixels;
    }
    if (pixels == 0) return std::nullopt;
    f.flicker_sd = sum / pixels;
    std::vector<double> energies;
    for (const Plane& p : result) energies.push_back(total_coverage(p));
    const double mean = mean_of(energies);
    if (mean > 0) f.energy_sd = deviation_of(energies) / mean;
    return f;
}

}  // namespace burin
