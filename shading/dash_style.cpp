#include "shading/dash_style.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shading/pen.h"

namespace burin {
namespace {

/// No pixel shows a shorter period: it takes two pixels to see one.
constexpr double kShortestPeriodPx = 0.5;
/// Dashes with that period or a shorter one have exactly their share of the solid line, on / (on + off).
constexpr double kFinestPeriodPx = 1.0 / 64;

/// The mean over a gap between the middles of two round ends of how much of the pen's width they cover.
double cover_of_gap(double gap_px, double width_px) {
    const double x = gap_px / width_px;
    if (x >= 1) return 0.25 * std::numbers::pi / x;
    return x < 1e-4 ? 1.0 : 0.5 * (std::sqrt(1 - x * x) + std::asin(x) / x);
}

/// Dots as wide as the pen touch each other below half a pixel, and in the limit they would be a solid line whatever
/// the gaps between them are. So from half a pixel down to 1/64 their ink goes over to their share of the line, evenly
/// per halving of the period.
double opacity_of_short(std::array<double, 2> dash_px, double width_px) {
    const double period_px = dash_px[0] + dash_px[1], share = dash_px[0] / period_px;
    const double steps = std::log2(kShortestPeriodPx / kFinestPeriodPx);
    const double drawn = std::clamp(std::log2(period_px / kFinestPeriodPx) / steps, 0.0, 1.0);
    return drawn > 0 ? std::lerp(share, ink_of_dashes(dash_px, width_px), drawn) : share;
}

DashStyle style_of(std::array<double, 2> dash_px, double width_px) {
    const double period_px = dash_px[0] + dash_px[1];
    if (!(dash_px[0] > 0 && dash_px[1] > 0 && std::isfinite(period_px))) return {};  // no dashes
    if (period_px >= kShortestPeriodPx) return {dash_px, 1};
    return {std::nullopt, opacity_of_short(dash_px, width_px)};
}

}  // namespace

double ink_of_dashes(std::array<double, 2> dash_px, double width_px) {
    const double period_px = dash_px[0] + dash_px[1], straight = std::max(dash_px[0] - width_px, 0.0),
                 gap = period_px - straight;
    return (straight + gap * cover_of_gap(gap, 2 * Pen(width_px).radius_px)) / period_px;
}

DashStyle visible_dashes(const LineStyle& style) {
    return style.dash_px ? style_of(*style.dash_px, style.width_px) : DashStyle{};
}

DashStyle hidden_dashes(const LineStyle& style) {
    return style.hidden.style == HiddenStyle::dashed ? style_of(style.hidden_dash_px(), style.hidden_width_px())
                                                     : DashStyle{};
}

}  // namespace burin
