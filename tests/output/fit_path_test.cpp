// Curves through the points of lines.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "output/paths/arc.h"
#include "output/paths/fit_path.h"
#include "output/paths/simplify.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using Points = std::vector<glm::dvec2>;
constexpr double kSagPx = FitBounds().chord_sag_px;

double distance_to(glm::dvec2 p, const Points& line) {
    double least = 1e9;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        least = std::min(least, distance_to_part(p, line[i], line[i + 1]));
    return least;
}

/// A path as points that lie close.
Points flattened(glm::dvec2 start, std::span<const PathStep> steps) {
    Points points = {start};
    for (const PathStep& step : steps) {
        std::vector<PathStep> parts = {step};
        if (step.kind == PathStep::Kind::arc) parts = cubics_of_arc(points.back(), step);
        for (const PathStep& part : parts) {
            const glm::dvec2 from = points.back();
            if (part.kind == PathStep::Kind::line) {
                points.push_back(part.to);
                continue;
            }
            for (int i = 1; i <= 100; ++i) {
                const double t = i / 100.0, s = 1 - t;
                points.push_back(from * (s * s * s) + part.a * (3 * s * s * t) + part.b * (3 * s * t * t) +
                                 part.to * (t * t * t));
            }
        }
    }
    return points;
}

/// Random smooth lines, with corners, straight parts and noise: both bounds hold.
TEST(FitPath, IsWithinTheToleranceBothWays) {
    test::Random random(1);
    std::size_t curves = 0;
    for (int trial = 0; trial < 150; ++trial) {
        Points line = {{100, 100}};
        double angle = random.real(0, 6), bend = random.real(-0.2, 0.2);
        const double step = random.real(0.5, 6);
        for (int i = 0; i < 120; ++i) {
            if (random.integer(0, 30) == 0) angle += random.real(-2, 2);
            if (random.integer(0, 20) == 0) bend = random.integer(0, 2) == 0 ? 0 : random.real(-0.25, 0.25);
            angle += bend;
            line.push_back(line.back() + step * glm::dvec2(std::cos(angle), std::sin(angle)));
        }
        const double tolerance = trial % 2 == 0 ? 0.02 : 0.2;
        std::vector<PathStep> steps;
        const glm::dvec2 start = fit_path(line, false, {tolerance, kSagPx}, steps);
        const Points path = flattened(start, steps);
        for (const glm::dvec2 p : line) EXPECT_LT(distance_to(p, path), tolerance + 2e-3) << trial;
        for (const glm::dvec2 p : path) EXPECT_LT(distance_to(p, line), tolerance + kSagPx + 2e-3) << trial;
        EXPECT_EQ(path.back(), line.back());
        for (const PathStep& s : steps) curves += s.kind == PathStep::Kind::line ? 0 : 1;
    }
    EXPECT_GT(curves, 500u);
}

TEST(FitPath, AnEllipseIsArcs) {
    // The sag of chords grows with their length: 0.05 pixel for sixty of them, 0.02 is as much as is allowed by itself.
    for (const auto& [count, bounds] : {std::pair(60, FitBounds{0.02, 0.05}), std::pair(120, FitBounds())}) {
        Points line;
        for (int i = 0; i <= count; ++i) {
            const double a = i * 2 * 3.14159265358979 / count, x = 40 * std::cos(a), y = 25 * std::sin(a);
            line.push_back({100 + 0.8 * x - 0.6 * y, 90 + 0.6 * x + 0.8 * y});
        }
        line.back() = line.front();
        std::vector<PathStep> steps;
        const glm::dvec2 start = fit_path(line, true, bounds, steps);
        EXPECT_EQ(steps.size(), 4u) << count;
        for (const PathStep& step : steps) EXPECT_EQ(step.kind, PathStep::Kind::arc);
        for (const glm::dvec2 p : flattened(start, steps)) {
            const glm::dvec2 off(0.8 * (p.x - 100) + 0.6 * (p.y - 90), 0.8 * (p.y - 90) - 0.6 * (p.x - 100));
            EXPECT_NEAR(std::hypot(off.x / 40, off.y / 25), 1, 1e-3) << count;
        }
    }
}

TEST(FitPath, StraightLinesAndCornersStay) {
    std::vector<PathStep> steps;
    const Points box = {{0, 0}, {5, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}};
    fit_path(box, true, {}, steps);
    ASSERT_EQ(steps.size(), 4u);
    EXPECT_EQ(steps[0].to, glm::dvec2(10, 0));
    for (const PathStep& step : steps) EXPECT_EQ(step.kind, PathStep::Kind::line);
    steps.clear();
    fit_path(Points{{3, 3}, {3, 3}}, false, {}, steps);  // a dot
    EXPECT_EQ(steps.size(), 1u);
}

/// A polygon with few corners is no circle: its sides are farther from one than chords of a mesh are.
TEST(FitPath, WhatTheToleranceMakesNothingOfIsADot) {
    const std::vector<Points> lines = {{{20, 10}, {20.003, 10}, {20, 10}},
                                       {{20, 10}, {20.003, 10}, {20.002, 10.003}, {20, 10}},
                                       {{20, 10}, {20.01, 10}, {20, 10}},
                                       {{20, 10}, {20, 10}},
                                       {{20, 10}, {20, 10}, {20, 10}}};
    for (const bool is_closed : {true, false}) {
        for (const Points& line : lines) {
            std::vector<PathStep> steps;
            EXPECT_EQ(fit_path(line, is_closed, {}, steps), glm::dvec2(20, 10));
            ASSERT_EQ(steps.size(), 1u) << line.size();
            EXPECT_EQ(steps[0].to, glm::dvec2(20, 10));
        }
    }
}

TEST(FitPath, ThereAndBackAgainIsFinite) {
    // Short parts that go leave their neighbours at one place.
    const std::vector<Points> lines = {
        {{20, 10}, {20.01, 10}, {20, 10}, {60, 10}, {60, 40}, {20, 10}},
        {{60, 10}, {20, 10}, {20.01, 10}, {20, 10}, {60, 40}, {60, 10}},
        {{20, 10}, {20.005, 10.01}, {30, 10}, {40, 20}, {20.005, 10.01}, {20, 10}},
    };
    for (const Points& line : lines) {
        std::vector<PathStep> steps;
        fit_path(line, true, {}, steps);
        ASSERT_GE(steps.size(), 2u);
        for (const PathStep& step : steps) EXPECT_TRUE(std::isfinite(step.to.x + step.a.x + step.b.x));
    }
}

/// A line that goes half a pixel off and back again loses that; one that goes farther, or turns less, keeps it.
TEST(FitPath, ThornsAreCutOff) {
    const auto corners = [](const Points& line) {
        std::vector<PathStep> steps;
        fit_path(line, false, {}, steps);
        return steps.size();
    };
    for (int i = 0; i < 100; ++i) {
        const double angle = 0.1 * i, c = std::cos(angle), s = std::sin(angle);
        const auto with_thorn = [&](glm::dvec2 tip, glm::dvec2 back) {
            Points line = {{-10, -3}, {0, 0}, tip, back, {12, 2}};
            for (glm::dvec2& p : line) p = {50 + c * p.x - s * p.y, 50 + s * p.x + c * p.y};
            return line;
        };
        const std::size_t without = corners(with_thorn({0, 0}, {0.03, 0.02}));
        EXPECT_EQ(corners(with_thorn({-0.1, 0.3}, {0.03, 0.02})), without) << i;
        EXPECT_EQ(corners(with_thorn({-0.2, 0.4}, {0, 0})), without) << i;
        EXPECT_GT(corners(with_thorn({-0.2, 0.9}, {0, 0})), without) << i;
        EXPECT_GT(corners(with_thorn({0.2, 0.4}, {0.6, 0.1})), without) << i;
    }
}

TEST(FitPath, CoarsePolygonsStay) {
    Points line;
    for (int i = 0; i <= 24; ++i)
        line.push_back({200 + 100 * std::cos(i * 0.2617993877991494), 150 + 100 * std::sin(i * 0.2617993877991494)});
    line.back() = line.front();
    std::vector<PathStep> steps;
    fit_path(line, true, {}, steps);
    EXPECT_EQ(steps.size(), 24u);
    steps.clear();
    fit_path(line, true, {0.02, 1}, steps);  // unless that is asked for
    EXPECT_EQ(steps.size(), 4u);
}

/// Nothing is farther from the chords of a mesh than twice the tolerance, unless more is asked for: a circle of 60
/// vertices, whose chords are 0.05 px off, is none at 0.02 px.
TEST(FitPath, TheSagOfChordsIsAtMostTheTolerance) {
    Points line;
    for (int i = 0; i <= 60; ++i)
        line.push_back({200 + 40 * std::cos(i * 0.1047197551196598), 150 + 40 * std::sin(i * 0.1047197551196598)});
    line.back() = line.front();
    for (const double tolerance : {0.02, 0.06}) {
        std::vector<PathStep> steps;
        const glm::dvec2 start = fit_path(line, true, {.tolerance_px = tolerance}, steps);
        double off = 0;
        for (const glm::dvec2 p : flattened(start, steps)) off = std::max(off, distance_to(p, line));
        EXPECT_LE(off, 2 * tolerance);
        EXPECT_EQ(steps.front().kind == PathStep::Kind::line, tolerance == 0.02);
    }
}

TEST(Simplify, DotsStayDots) {
    for (std::size_t count = 2; count < 5; ++count) {
        Points out = {{1, 1}};
        simplify(Points(count, {20, 10}), 0.02, out);
        EXPECT_EQ(out, (Points{{1, 1}, {20, 10}, {20, 10}})) << count;
    }
}

}  // namespace
}  // namespace burin
