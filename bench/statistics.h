#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <vector>

#include "base/json_writer.h"

namespace burin::bench {

/// CPU time of this thread in seconds. Other jobs on the machine disturb it far less than wall
/// time.
inline double thread_cpu_s() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// One quantity over the runs of a benchmark.
class Samples {
  public:
    void add(double value) { values_.push_back(value); }
    std::size_t size() const { return values_.size(); }
    double operator[](std::size_t run) const { return values_[run]; }

    /// The value below which a share `q` (0..1) of all lies, interpolated.
    double quantile(double q) const {
        std::vector<double> sorted = values_;
        std::sort(sorted.begin(), sorted.end());
        const double at = q * static_cast<double>(sorted.size() - 1);
        const auto low = static_cast<std::size_t>(std::floor(at));
        const std::size_t high = std::min(low + 1, sorted.size() - 1);
        return sorted[low] + (at - std::floor(at)) * (sorted[high] - sorted[low]);
    }
    double median() const { return quantile(0.5); }
    double min() const { return quantile(0); }
    /// (p90 - p10) / median.
    double noise() const { return (quantile(0.9) - quantile(0.1)) / median(); }

  private:
    std::vector<double> values_;
};

/// Writes NAME (the median), NAME_min and NAME_noise into the open object.
inline void write_samples(JsonWriter& json, const std::string& name, const Samples& samples) {
    json.key(name).value(samples.median());
    json.key(name + "_min").value(samples.min());
    json.key(name + "_noise").value(samples.noise());
}

/// Writes the median of a[run] / b[run]: quantities of one run are measured under the same load.
inline void write_ratio(JsonWriter& json, const std::string& name, const Samples& a, const Samples& b) {
    Samples ratios;
    for (std::size_t run = 0; run < a.size(); ++run) ratios.add(a[run] / b[run]);
    write_samples(json, name, ratios);
}

}  // namespace burin::bench
