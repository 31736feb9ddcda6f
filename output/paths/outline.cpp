#include "output/paths/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace burin {
namespace {

/// Chords of round ends and joins are no farther than this from the circle.
constexpr double kRoundPx = 1.0 / 64;

/// Adds points of a circle from one angle to another one, without its ends. The way is that of the angle's growth or
/// decrease.
void add_arc(glm::dvec2 center, double radius, double from, double to, std::vector<glm::dvec2>& out) {
    if (!(radius > 0)) return;
    const double step = 2 * std::acos(std::clamp(1 - kRoundPx / radius, 0.0, 1.0));
    const int parts = std::clamp(static_cast<int>(std::ceil(std::abs(to - from) / std::max(step, 0.01))), 1, 1024);
    for (int i = 1; i < parts; ++i) {
        const double angle = from + (to - from) * i / parts;
        out.push_back(center + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
}

/// One side of the cones of a stroke, from its first point to its last one: at each cone the two places where the
/// common tangent of its circles touches them, and round joins between.
void add_side(std::span<const InkPoint> points, std::vector<glm::dvec2>& out) {
    bool is_first = true;
    double angle_before = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const glm::dvec2 way = points[i + 1].place - points[i].place;
        const double length = glm::length(way);
        const double r0 = 0.5 * static_cast<double>(points[i].width_px),
                     r1 = 0.5 * static_cast<double>(points[i + 1].width_px);
        if (!(length > std::abs(r1 - r0))) continue;  // one circle lies in the other
        // The tangent touches both circles where their normals have this angle.
        const double angle = std::atan2(way.y, way.x) - std::acos(std::clamp((r0 - r1) / length, -1.0, 1.0));
        const glm::dvec2 normal(std::cos(angle), std::sin(angle));
        if (!is_first) {
            double turn = std::remainder(angle - angle_before, 2 * std::numbers::pi);
            // On the inner side of a turn the outline passes over the point itself, so that it has no gap.
            if (turn < 0) {
                if (turn < -0.1) out.push_back(points[i].place);
            } else {
                add_arc(points[i].place, r0, angle_before, angle_before + turn, out);
            }
        }
        out.push_back(points[i].place + r0 * normal);
        out.push_back(points[i + 1].place + r1 * normal);
        angle_before = angle;
        is_first = false;
    }
}

}  // namespace

void add_outline(std::span<const InkPoint> stroke, bool has_round_caps, bool is_closed, std::vector<glm::dvec2>& out) {
    std::vector<InkPoint> points(stroke.begin(), stroke.end());
    std::vector<glm::dvec2> forth, back;
    add_side(points, forth);
    std::reverse(points.begin(), points.end());
    add_side(points, back);
    const auto widest = std::max_element(stroke.begin(), stroke.end(),
                                         [](const InkPoint& a, const InkPoint& b) { return a.width_px < b.width_px; });
    const std::size_t begin = out.size();
    if (forth.empty() || back.empty()) {
        const double radius = 0.5 * static_cast<double>(widest->width_px);
        if (!(radius > 0)) return;
        out.push_back(widest->place + glm::dvec2(radius, 0));
        add_arc(widest->place, radius, 0, 2 * std::numbers::pi, out);
        out.push_back(out[begin]);
        return;
    }
    // From the end of one side to the beginning of the other around the end of the stroke.
    const auto add_cap = [&](const InkPoint& end, glm::dvec2 from, glm::dvec2 to) {
        const double radius = 0.5 * static_cast<double>(end.width_px);
        if (!has_round_caps || is_closed || !(radius > 0)) return;
        const glm::dvec2 a = from - end.place, b = to - end.place;
        const double first = std::atan2(a.y, a.x);
        double turn = std::remainder(std::atan2(b.y, b.x) - first, 2 * std::numbers::pi);
        if (turn < 0) turn += 2 * std::numbers::pi;
        add_arc(end.place, radius, first, first + turn, out);
    };
    out.insert(out.end(), forth.begin(), forth.end());
    add_cap(stroke.back(), forth.back(), back.front());
    out.insert(out.end(), back.begin(), back.end());
    add_cap(stroke.front(), back.back(), forth.front());
    out.push_back(out[begin]);
}

}  // namespace burin
