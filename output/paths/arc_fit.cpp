#include "output/paths/arc_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "output/paths/arc.h"

namespace burin {
namespace {

constexpr std::size_t kLeastPoints = 7;
/// Parts that turn by less are cubics: of a short arc no ellipse can be told.
constexpr double kLeastTurn = std::numbers::pi / 3;

struct Ellipse {
    glm::dvec2 center{0.0};
    std::array<double, 2> radii{};
    double turn_deg = 0;  ///< of the first radius
};

/// Solves a system of five equations by elimination with pivots.
std::optional<std::array<double, 5>> solve(std::array<std::array<double, 6>, 5> m) {
    for (std::size_t k = 0; k < 5; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < 5; ++i) {
            if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
        }
        if (!(std::abs(m[pivot][k]) > 1e-12)) return std::nullopt;
        std::swap(m[k], m[pivot]);
        for (std::size_t i = k + 1; i < 5; ++i) {
            const double factor = m[i][k] / m[k][k];
            for (std::size_t j = k; j < 6; ++j) m[i][j] -= factor * m[k][j];
        }
    }
    std::array<double, 5> x{};
    for (std::size_t k = 5; k-- > 0;) {
        double sum = m[k][5];
        for (std::size_t j = k + 1; j < 5; ++j) sum -= m[k][j] * x[j];
        x[k] = sum / m[k][k];
    }
    return x;
}

/// The ellipse a x^2 + b x y + c y^2 + d x + e y = 1 that fits best, around the mean of the points, in units of their
/// extent.
std::optional<Ellipse> fitted_ellipse(std::span<const glm::dvec2> points) {
    glm::dvec2 mean(0.0);
    for (const glm::dvec2 p : points) mean += p;
    mean /= static_cast<double>(points.size());
    double extent = 0;
    for (const glm::dvec2 p : points) extent = std::max(extent, glm::distance(p, mean));
    if (!(extent > 0)) return std::nullopt;
    std::array<std::array<double, 6>, 5> sums{};
    for (const glm::dvec2 point : points) {
        const glm::dvec2 p = (point - mean) / extent;
        const std::array<double, 6> row = {p.x * p.x, p.x * p.y, p.y * p.y, p.x, p.y, 1};
        for (std::size_t i = 0; i < 5; ++i) {
            for (std::size_t j = 0; j < 6; ++j) sums[i][j] += row[i] * row[j];
        }
    }
    const auto solution = solve(sums);
    if (!solution) return std::nullopt;
    const auto [a, b, c, d, e] = *solution;
    const double determinant = 4 * a * c - b * b;
    if (!(determinant > 1e-9)) return std::nullopt;
    const glm::dvec2 center((b * e - 2 * c * d) / determinant, (b * d - 2 * a * e) / determinant);
    const double level = 1 + a * center.x * center.x + b * center.x * center.y + c * center.y * center.y;
    const double turn = 0.5 * std::atan2(b, a - c);
    const double cosine = std::cos(turn), sine = std::sin(turn);
    const double first = a * cosine * cosine + b * cosine * sine + c * sine * sine;
    const double second = a * sine * sine - b * cosine * sine + c * cosine * cosine;
    if (!(level / first > 0) || !(level / second > 0)) return std::nullopt;
    Ellipse ellipse;
    ellipse.center = mean + center * extent;
    ellipse.radii = {extent * std::sqrt(level / first), extent * std::sqrt(level / second)};
    ellipse.turn_deg = turn * 180 / std::numbers::pi;
    return ellipse;
}

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

}  // namespace

bool fit_arcs(const SmoothPart& part, std::vector<PathStep>& steps) {
    const std::span<const glm::dvec2> points = part.points;
    if (points.size() < kLeastPoints) return false;
    double turn = 0;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const glm::dvec2 before = points[i] - points[i - 1], after = points[i + 1] - points[i];
        const double here = std::atan2(cross(before, after), glm::dot(before, after));
        if (here * turn < 0 && std::abs(here) > 0.02) return false;
        turn += here;
    }
    if (std::abs(turn) < kLeastTurn || std::abs(turn) > 2.1 * std::numbers::pi) return false;
    const auto ellipse = fitted_ellipse(points);
    if (!ellipse || std::max(ellipse->radii[0], ellipse->radii[1]) > 1e5) return false;
    const double sine = std::sin(ellipse->turn_deg * std::numbers::pi / 180),
                 cosine = std::cos(ellipse->turn_deg * std::numbers::pi / 180);
    // The angle on the ellipse, as its parameter.
    const auto angle_of = [&](glm::dvec2 p) {
        const glm::dvec2 off = p - ellipse->center;
        return std::atan2((cosine * off.y - sine * off.x) / ellipse->radii[1],
                          (cosine * off.x + sine * off.y) / ellipse->radii[0]);
    };
    for (const glm::dvec2 p : points) {
        const glm::dvec2 off = p - ellipse->center;
        const glm::dvec2 own = glm::dvec2(cosine * off.x + sine * off.y, cosine * off.y - sine * off.x);
        const glm::dvec2 squares(ellipse->radii[0] * ellipse->radii[0], ellipse->radii[1] * ellipse->radii[1]);
        // How far the point is off to first order.
        const double value = own.x * own.x / squares.x + own.y * own.y / squares.y - 1;
        if (std::abs(value) > 2 * 1.5 * part.tolerance_px * glm::length(own / squares)) return false;
    }
    double sweep = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
        sweep += std::remainder(angle_of(points[i]) - angle_of(points[i - 1]), 2 * std::numbers::pi);
    const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / (0.5 * std::numbers::pi) - 0.05)));
    const double begin = angle_of(points.front());
    std::vector<PathStep> arcs;
    std::vector<glm::dvec2> places = {points.front()};
    const auto rounded = [](double value) { return std::round(value * 100) / 100; };
    for (int i = 1; i <= parts; ++i) {
        const double angle = begin + sweep * i / parts;
        const double x = ellipse->radii[0] * std::cos(angle), y = ellipse->radii[1] * std::sin(angle);
        PathStep arc;
        arc.kind = PathStep::Kind::arc;
        arc.is_clockwise = sweep > 0;
        arc.to =
            i == parts ? points.back() : ellipse->center + glm::dvec2(cosine * x - sine * y, sine * x + cosine * y);
        // As they are written, for the ellipse that a reader makes of them depends on all digits.
        arc.a = {rounded(ellipse->radii[0]), rounded(ellipse->radii[1])};
        arc.b = {rounded(ellipse->turn_deg), 0};
        const EllipseArc drawn = ellipse_of_arc(places.back(), arc);
        const double radius = std::max(arc.a.x, arc.a.y);
        const int count = std::clamp(
            static_cast<int>(std::ceil(std::abs(drawn.sweep) * std::sqrt(radius / (0.8 * part.tolerance_px)))), 4,
            1024);
        for (int k = 1; k <= count; ++k) places.push_back(drawn.at(static_cast<double>(k) / count));
        arcs.push_back(arc);
    }
    if (worst_point(places, part) != 0) return false;
    steps.insert(steps.end(), arcs.begin(), arcs.end());
    return true;
}

}  // namespace burin
