#include "output/paths/cubic_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/interrupt.h"
#include "output/paths/simplify.h"

namespace burin {
namespace {

constexpr int kRounds = 4;
/// Between places where a curve is looked at it is off by no more than this share of the tolerance.
constexpr double kSampledShare = 0.05;
/// A first cubic that is so many tolerances off does not become good enough.
constexpr double kHopelessTimes = 16;

struct Cubic {
    glm::dvec2 a, b, c, d;
    glm::dvec2 at(double t) const {
        const double s = 1 - t;
        return a * (s * s * s) + b * (3 * s * s * t) + c * (3 * s * t * t) + d * (t * t * t);
    }
    glm::dvec2 first(double t) const {
        const double s = 1 - t;
        return (b - a) * (3 * s * s) + (c - b) * (6 * s * t) + (d - c) * (3 * t * t);
    }
    glm::dvec2 second(double t) const { return (c - 2.0 * b + a) * (6 * (1 - t)) + (d - 2.0 * c + b) * (6 * t); }
};

/// The best cubic with the tangents of a part, for given parameters of its points.
Cubic best_cubic(const SmoothPart& part, std::span<const double> at, double length) {
    const std::span<const glm::dvec2> p = part.points;
    double c00 = 0, c01 = 0, c11 = 0, x0 = 0, x1 = 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
        const double t = at[k], s = 1 - t;
        const double b0 = s * s * s, b1 = 3 * s * s * t, b2 = 3 * s * t * t, b3 = t * t * t;
        const glm::dvec2 a0 = part.begin_way * b1, a1 = part.end_way * b2;
        const glm::dvec2 rest = p[k] - (p.front() * (b0 + b1) + p.back() * (b2 + b3));
        c00 += glm::dot(a0, a0);
        c01 += glm::dot(a0, a1);
        c11 += glm::dot(a1, a1);
        x0 += glm::dot(a0, rest);
        x1 += glm::dot(a1, rest);
    }
    const double determinant = c00 * c11 - c01 * c01;
    double begin = 0, end = 0;
    if (determinant > 1e-12) {
        begin = (x0 * c11 - x1 * c01) / determinant;
        end = (c00 * x1 - c01 * x0) / determinant;
    }
    const double least = 1e-6 * glm::distance(p.front(), p.back());
    if (!(begin > least) || !(end > least) || begin > 3 * length || end > 3 * length) begin = end = length / 3;
    return {p.front(), p.front() + part.begin_way * begin, p.back() + part.end_way * end, p.back()};
}

/// A cubic and how far it is from the points at their parameters, which is more than the distance; the worst one.
struct Fit {
    Cubic cubic{};
    double off_px = 0;
    std::size_t worst = 0;
};

Fit fitted_cubic(const SmoothPart& part, std::vector<double>& at) {
    const std::span<const glm::dvec2> p = part.points;
    at.assign(p.size(), 0.0);
    for (std::size_t k = 1; k < p.size(); ++k) at[k] = at[k - 1] + glm::distance(p[k - 1], p[k]);
    const double length = at.back();
    for (double& t : at) t /= length;
    Fit fit;
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kRounds; ++round) {
        fit.cubic = best_cubic(part, at, length);
        // One step of Newton's method towards the nearest place on the curve.
        double worst = 0;
        for (std::size_t k = 1; k + 1 < p.size(); ++k) {
            const glm::dvec2 off = fit.cubic.at(at[k]) - p[k], first = fit.cubic.first(at[k]);
            const double square = glm::dot(off, off);
            if (square > worst) {
                worst = square;
                fit.worst = k;
            }
            const double slope = glm::dot(first, first) + glm::dot(off, fit.cubic.second(at[k]));
            if (std::abs(slope) > 1e-12) at[k] = std::clamp(at[k] - glm::dot(off, first) / slope, 0.0, 1.0);
        }
        fit.off_px = std::sqrt(worst);
        if (fit.off_px > kHopelessTimes * part.tolerance_px || worst >= 0.9 * before) break;
        before = worst;
    }
    return fit;
}

/// Adds places on a cubic between which it is straight to a small part of the tolerance, but for its first one.
void add_places(const Cubic& cubic, double tolerance_px, std::vector<glm::dvec2>& out) {
    const double bend =
        std::max(glm::length(cubic.a - 2.0 * cubic.b + cubic.c), glm::length(cubic.b - 2.0 * cubic.c + cubic.d));
    const int parts =
        std::clamp(static_cast<int>(std::ceil(std::sqrt(0.75 * bend / (kSampledShare * tolerance_px)))), 4, 1024);
    for (int i = 1; i <= parts; ++i) out.push_back(cubic.at(static_cast<double>(i) / parts));
}

}  // namespace

std::size_t worst_point(std::span<const glm::dvec2> curve, const SmoothPart& part) {
    const std::span<const glm::dvec2> p = part.points;
    // Both run the same way, so it is enough to look a little ahead.
    constexpr std::size_t kAhead = 8;
    double worst = 1 - kSampledShare;  // in tolerances
    std::size_t at = 0;
    const auto inner = [&](std::size_t point) { return std::clamp<std::size_t>(point, 1, p.size() - 2); };
    std::size_t chord = 0;
    for (const glm::dvec2 place : curve) {
        double best = std::numeric_limits<double>::infinity();
        std::size_t best_chord = chord;
        for (std::size_t k = chord; k + 1 < p.size() && k < chord + kAhead; ++k) {
            const double distance =
                distance_to_part(place, p[k], p[k + 1]) * part.tolerance_px / (part.tolerance_px + part.sag_px[k]);
            if (distance >= best) continue;
            best = distance;
            best_chord = k;
        }
        chord = best_chord;
        if (best / part.tolerance_px > worst) {
            worst = best / part.tolerance_px;
            at = inner(distance_to_part(place, p[chord], p[chord]) < distance_to_part(place, p[chord + 1], p[chord + 1])
                           ? chord
                           : chord + 1);
        }
    }
    std::size_t step = 0;
    for (std::size_t k = 1; k + 1 < p.size(); ++k) {
        double best = std::numeric_limits<double>::infinity();
        std::size_t best_step = step;
        // The curve has more places than the line has points.
        const std::size_t ahead = kAhead * (curve.size() / p.size() + 1);
        for (std::size_t s = step; s + 1 < curve.size() && s < step + ahead; ++s) {
            const double distance = distance_to_part(p[k], curve[s], curve[s + 1]);
            if (distance >= best) continue;
            best = distance;
            best_step = s;
        }
        step = best_step;
        if (best / part.tolerance_px > worst) {
            worst = best / part.tolerance_px;
            at = k;
        }
    }
    return at;
}

void fit_cubics(const SmoothPart& whole, std::vector<PathStep>& steps) {
    std::vector<SmoothPart> parts = {whole};  // the next one last
    std::vector<glm::dvec2> places;
    std::vector<double> parameters;
    const auto add_lines = [&](std::span<const glm::dvec2> points) {
        for (const glm::dvec2 p : points.subspan(1)) {
            PathStep step;
            step.to = p;
            steps.push_back(step);
        }
    };
    while (!parts.empty()) {
        throw_if_interrupted();
        const SmoothPart part = parts.back();
        parts.pop_back();
        const std::span<const glm::dvec2> p = part.points;
        if (p.size() > 3) {
            const Fit fit = fitted_cubic(part, parameters);
            const Cubic& cubic = fit.cubic;
            std::size_t at = fit.worst;
            // Parameters are not exactly those of the nearest places.
            if (fit.off_px <= 1.5 * part.tolerance_px) {
                places.assign(1, cubic.a);
                add_places(cubic, part.tolerance_px, places);
                at = worst_point(places, part);
            }
            if (at == 0) {
                PathStep step;
                step.kind = PathStep::Kind::cubic;
                step.a = cubic.b;
                step.b = cubic.c;
                step.to = cubic.d;
                steps.push_back(step);
                continue;
            }
            const glm::dvec2 before = p[at] - p[at - 1], after = p[at + 1] - p[at];
            // Of the parabola through the three points.
            const double l0 = glm::length(before), l1 = glm::length(after);
            glm::dvec2 way = before * (l1 / l0) + after * (l0 / l1);
            way = glm::length(way) > 0 ? glm::normalize(way) : glm::normalize(after);
            SmoothPart first = part, second = part;
            first.points = p.first(at + 1);
            first.sag_px = part.sag_px.first(at);
            first.end_way = -way;
            second.points = p.subspan(at);
            second.sag_px = part.sag_px.subspan(at);
            second.begin_way = way;
            parts.push_back(second);
            parts.push_back(first);
            continue;
        }
        add_lines(p);
    }
}

}  // namespace burin
