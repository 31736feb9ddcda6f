#include "compare/chart_metrics.h"

#include <cmath>

#include "compare/metrics_error.h"

namespace burin {
namespace {

/// How wide every part of some lines is.
std::vector<double> all_widths(const std::vector<Segment>& lines, const Plane& coverage, double reach_px) {
    std::vector<double> widths;
    for (const Segment& line : lines) {
        const std::vector<double> w = widths_along(coverage, line, reach_px);
        widths.insert(widths.end(), w.begin(), w.end());
    }
    return widths;
}

/// Share of the values below a bound.
double share_below(const std::vector<double>& values, double bound) {
    if (values.empty()) return 0;
    const auto below = std::count_if(values.begin(), values.end(), [&](double v) { return v < bound; });
    return static_cast<double>(below) / static_cast<double>(values.size());
}

/// Stipples are gaps: the stairs of an aliased line are none.
constexpr double kStippleWindow_px = 1.5;

double stippled_share(const TestChart& chart, const Plane& coverage, double bound_px) {
    std::vector<double> widths;
    for (const Segment& line : chart.slopes) {
        const std::vector<double> means =
            smoothed_along(widths_along(coverage, line, chart.reach_px), kStippleWindow_px);
        widths.insert(widths.end(), means.begin(), means.end());
    }
    return share_below(widths, bound_px);
}

double rms_error(const std::vector<ProfilePoint>& points) {
    double sum = 0;
    for (const ProfilePoint& p : points) sum += (p.coverage - p.ideal) * (p.coverage - p.ideal);
    return points.empty() ? 0 : std::sqrt(sum / static_cast<double>(points.size()));
}

void measure_star(const TestChart& chart, const Plane& coverage, double truth_width_px, ComparisonRow& row) {
    ChartCurves curves;
    std::vector<ProfilePoint> all;
    double beading = 0, drawn_lines = 0;
    for (const Segment& line : chart.star) {
        const std::vector<double> widths = widths_along(coverage, line, chart.reach_px);
        const double mean = mean_of(widths);
        curves.width_px.push_back(mean);
        if (mean > 0) {
            beading += deviation_of(widths) / mean;
            ++drawn_lines;
        }
        const auto points = profile_points(coverage, line, chart.reach_px, truth_width_px);
        curves.rmse.push_back(rms_error(points));
        curves.within_bin_sd.push_back(within_bin_deviation(points, chart.reach_px).value_or(0));
        all.insert(all.end(), points.begin(), points.end());
    }
    curves.profile = line_spread(all, chart.reach_px);

    MetricValues& v = row.values;
    const double mean = mean_of(curves.width_px);
    v[Metric::width_px] = mean;
    v[Metric::width_bias] = mean / truth_width_px - 1;
    v[Metric::angle_rmse] = rms_error(all);
    v[Metric::levels] = static_cast<double>(coverage_levels(coverage));
    if (drawn_lines > 0) {
        const auto [low, high] = std::minmax_element(curves.width_px.begin(), curves.width_px.end());
        v[Metric::width_ripple] = (*high - *low) / mean;
        v[Metric::beading] = beading / drawn_lines;
        v[Metric::within_bin_sd] = within_bin_deviation(all, chart.reach_px);
        double moment = 0, total = 0;
        for (const ProfilePoint& p : all) {
            moment += p.u * p.coverage;
            total += p.coverage;
        }
        v[Metric::offset_px] = std::abs(moment / total);
    }
    if (const auto m = modulation(curves.profile)) {
        v[Metric::mtf50] = m->mtf50;
        v[Metric::alias_energy] = m->energy_above_nyquist;
        curves.modulation = m->values;
    }
    row.curves = std::move(curves);
}

/// Hidden lines may leak on one side only: their ink counts, up to that of a visible line.
void measure_leaks(const TestChart& chart, const Plane& coverage, double expected_px, ComparisonRow& row) {
    std::vector<double> all, at_gap;
    for (std::size_t i = 0; i < chart.hidden.size(); ++i) {
        const TestChart::HiddenLine& line = chart.hidden[i];
        for (const double width : widths_along(coverage, line.segment, chart.reach_px)) {
            at_gap.push_back(std::min(width / expected_px, 1.0));
        }
        if (i + 1 < chart.hidden.size() && chart.hidden[i + 1].gap_px == line.gap_px) continue;
        row.curves->gaps_px.push_back(line.gap_px);
        row.curves->leak_share.push_back(mean_of(at_gap));
        all.insert(all.end(), at_gap.begin(), at_gap.end());
        at_gap.clear();
    }
    row.values[Metric::leak_share] = mean_of(all);
}

}  // namespace

LineClassSet chart_classes(LineClassSet draws) {
    LineClassSet classes = draws & LineClassSet(LineClass::silhouette);
    if (draws.has(LineClass::crease)) return classes | LineClass::crease;
    return classes | (draws & LineClassSet(LineClass::polygon));
}

double star_width_px(const TestChart& chart, const Plane& coverage) {
    return mean_of(all_widths(chart.star, coverage, chart.reach_px));
}

void measure_chart(const TestChart& chart, const Plane& coverage, LineClassSet draws, double truth_width_px,
                   ComparisonRow& row) {
    const LineClassSet classes = chart_classes(draws);
    if (!classes.has(LineClass::crease) && !classes.has(LineClass::polygon)) return;
    measure_star(chart, coverage, truth_width_px, row);
    const double width = *row.values[Metric::width_px];
    if (!(width > 0)) return;  // shares of nothing
    const double expected = median_of(all_widths(chart.star, coverage, chart.reach_px));
    row.values[Metric::stippled_share] = stippled_share(chart, coverage, 0.5 * expected);
    measure_leaks(chart, coverage, expected, row);
    if (classes.has(LineClass::silhouette)) {
        row.values[Metric::silhouette_ratio] = mean_of(all_widths(chart.silhouettes, coverage, chart.reach_px)) / width;
    }
}

}  // namespace burin
