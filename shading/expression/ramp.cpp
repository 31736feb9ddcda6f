#include "shading/expression/ramp.h"

#include <cmath>

#include "kernels/expression_kernels.h"

namespace burin {
namespace {

/// The slopes at stops with which cubics between them are monotone wherever the stops are.
std::vector<double> monotone_slopes(const std::vector<double>& at, const std::vector<double>& value) {
    const std::size_t n = at.size();
    std::vector<double> chord(n, 0.0), slope(n, 0.0);
    for (std::size_t i = 0; i + 1 < n; ++i) chord[i] = (value[i + 1] - value[i]) / (at[i + 1] - at[i]);
    if (n < 2) return slope;
    slope.front() = chord.front();
    slope.back() = chord[n - 2];
    for (std::size_t i = 1; i + 1 < n; ++i) slope[i] = chord[i - 1] * chord[i] > 0 ? (chord[i - 1] + chord[i]) / 2 : 0;
    for (std::size_t i = 0; i + 1 < n; ++i) {
        if (chord[i] == 0) {
            slope[i] = slope[i + 1] = 0;
            continue;
        }
        const double a = slope[i] / chord[i], b = slope[i + 1] / chord[i], length = std::hypot(a, b);
        if (length <= 3) continue;
        slope[i] = 3 * a / length * chord[i];
        slope[i + 1] = 3 * b / length * chord[i];
    }
    return slope;
}

}  // namespace

std::optional<std::string> fault_of_ramp(const Ramp& ramp) {
    constexpr float kMost = 1e15f, kLeastDistance = 1e-15f;
    if (ramp.stops.empty()) return "a ramp needs a stop at least";
    if (ramp.stops.size() > kMostRampStops) return "a ramp has at most 64 stops";
    for (std::size_t i = 0; i < ramp.stops.size(); ++i) {
        const RampStop& stop = ramp.stops[i];
        bool is_fit = std::abs(stop.at) <= kMost;
        for (const float value : stop.value) is_fit = is_fit && std::abs(value) <= kMost;
        if (!is_fit) return "stop " + std::to_string(i + 1) + " has a number beyond 1e15";
        if (i > 0 && !(stop.at - ramp.stops[i - 1].at >= kLeastDistance))
            return "stop " + std::to_string(i + 1) + " does not lie behind the one before it";
    }
    return std::nullopt;
}

std::vector<float> ramp_table(const Ramp& ramp, std::size_t component) {
    const std::size_t n = ramp.stops.size();
    std::vector<double> at, value;
    for (const RampStop& stop : ramp.stops) {
        at.push_back(static_cast<double>(stop.at));
        value.push_back(static_cast<double>(stop.value[component]));
    }
    const std::vector<double> slopes = monotone_slopes(at, value);
    std::vector<float> table(kRampColumns * n, 0.0f);
    for (std::size_t i = 0; i < n; ++i) {
        std::array<double, 4> c{value[i], 0, 0, 0};
        const double length = i + 1 < n ? at[i + 1] - at[i] : 0, rise = i + 1 < n ? value[i + 1] - value[i] : 0;
        if (length > 0) {
            switch (ramp.between) {
                case RampBetween::linear:
                    c[1] = rise;
                    break;
                case RampBetween::smooth:
                    c[2] = 3 * rise;
                    c[3] = -2 * rise;
                    break;
                case RampBetween::step:
                    break;
                case RampBetween::curve:
                    c[1] = slopes[i] * length;
                    c[2] = 3 * rise - (2 * slopes[i] + slopes[i + 1]) * length;
                    c[3] = (slopes[i] + slopes[i + 1]) * length - 2 * rise;
                    break;
            }
        }
        table[i] = ramp.stops[i].at;
        table[n + i] = length > 0 ? static_cast<float>(1 / length) : 0.0f;
        for (std::size_t k = 0; k < c.size(); ++k) table[(k + 2) * n + i] = static_cast<float>(c[k]);
    }
    return table;
}

}  // namespace burin
