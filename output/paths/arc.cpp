#include "output/paths/arc.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace burin {
namespace {}  // namespace

glm::dvec2 EllipseArc::at(double share) const {
    const double angle = begin + sweep * share;
    return center + first_axis * std::cos(angle) + second_axis * std::sin(angle);
}

EllipseArc ellipse_of_arc(glm::dvec2 start, const PathStep& arc) {
    const double turn = arc.b.x * std::numbers::pi / 180;
    const glm::dvec2 x_way(std::cos(turn), std::sin(turn)), y_way(-x_way.y, x_way.x);
    glm::dvec2 radii = glm::max(glm::abs(arc.a), glm::dvec2(1e-9));
    // Where the ellipse is a circle of radius 1 around its centre.
    const auto to_circle = [&](glm::dvec2 p) { return glm::dvec2(glm::dot(p, x_way), glm::dot(p, y_way)) / radii; };
    glm::dvec2 half = to_circle(0.5 * (arc.to - start));
    const double half_length = glm::length(half);
    if (half_length > 1) {
        radii *= half_length;
        half /= half_length;
    }
    const double square = glm::dot(half, half);
    const double distance = square > 0 ? std::sqrt(std::max(1 - square, 0.0) / square) : 0.0;
    const double side = arc.is_large == arc.is_clockwise ? -1 : 1;
    // From the middle of the chord, across it.
    const glm::dvec2 to_center = glm::dvec2(-half.y, half.x) * (distance * side);
    EllipseArc ellipse;
    ellipse.first_axis = x_way * radii.x;
    ellipse.second_axis = y_way * radii.y;
    ellipse.center = 0.5 * (start + arc.to) + ellipse.first_axis * to_center.x + ellipse.second_axis * to_center.y;
    const glm::dvec2 from = -half - to_center, to = half - to_center;
    ellipse.begin = std::atan2(from.y, from.x);
    ellipse.sweep = std::atan2(to.y, to.x) - ellipse.begin;
    if (arc.is_clockwise && ellipse.sweep < 0) ellipse.sweep += 2 * std::numbers::pi;
    if (!arc.is_clockwise && ellipse.sweep > 0) ellipse.sweep -= 2 * std::numbers::pi;
    return ellipse;
}

std::vector<PathStep> cubics_of_arc(glm::dvec2 start, const PathStep& arc, int parts_of_quarter) {
    const EllipseArc ellipse = ellipse_of_arc(start, arc);
    const int parts = std::max(
        1, static_cast<int>(std::ceil(std::abs(ellipse.sweep) / (0.5 * std::numbers::pi) * parts_of_quarter - 1e-6)));
    const double reach = 4.0 / 3 * std::tan(ellipse.sweep / parts / 4);
    const auto tangent = [&](double share) {
        const double angle = ellipse.begin + ellipse.sweep * share;
        return ellipse.second_axis * std::cos(angle) - ellipse.first_axis * std::sin(angle);
    };
    std::vector<PathStep> steps;
    for (int i = 0; i < parts; ++i) {
        const double from = static_cast<double>(i) / parts, to = static_cast<double>(i + 1) / parts;
        PathStep step;
        step.kind = PathStep::Kind::cubic;
        step.to = i + 1 == parts ? arc.to : ellipse.at(to);
        step.a = (i == 0 ? start : ellipse.at(from)) + tangent(from) * reach;
        step.b = step.to - tangent(to) * reach;
        steps.push_back(step);
    }
    return steps;
}

}  // namespace burin
