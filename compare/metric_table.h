#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

// Each metric has a row: its key with its unit, its group, and which values are better.

namespace burin {

/// Everything that is measured, in the order of the tables. docs/compare.md defines each.
enum class Metric : unsigned char {
    rmse,
    psnr_db,
    psnr98_db,
    max_error,
    ssim,
    ms_ssim,
    flip_mean,
    flip_p95,
    missed_share,
    false_share,
    width_px,
    width_bias,
    width_ripple,
    offset_px,
    beading,
    angle_rmse,
    within_bin_sd,
    mtf50,
    alias_energy,
    stippled_share,
    leak_share,
    silhouette_ratio,
    levels,
    flicker_sd,
    energy_sd,
    pop,
    time_s,
    cpu_time_s,
    memory,
    passes,
};
constexpr std::size_t kMetricCount = static_cast<std::size_t>(Metric::passes) + 1;

/// Which values of a metric are the better ones.
enum class Better : unsigned char { none, lower, higher, near_zero, near_one };

struct MetricInfo {
    std::string_view key;    ///< in metrics.json and metrics.csv, with its unit
    std::string_view group;  ///< scene, chart, motion or cost
    std::string_view title;  ///< in the report
    std::string_view what;   ///< one sentence
    Better better = Better::none;
    int digits = 3;  ///< after the decimal point, in the report
};

/// One row per Metric, in that order.
std::span<const MetricInfo, kMetricCount> metric_table();

/// Values of all metrics. What does not apply has none.
struct MetricValues {
    std::array<std::optional<double>, kMetricCount> values;

    std::optional<double>& operator[](Metric m) { return values[static_cast<std::size_t>(m)]; }
    const std::optional<double>& operator[](Metric m) const { return values[static_cast<std::size_t>(m)]; }
};

}  // namespace burin
