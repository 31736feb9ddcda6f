// What plotters ask of drawings, and sheets of several views: no line is lost, none is added.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/interrupt.h"
#include "output/paths/arc.h"
#include "output/paths/path_order.h"
#include "output/paths/view_sheet.h"
#include "output/svg.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

PathStep random_step(Random& random) {
    PathStep step;
    step.kind = static_cast<PathStep::Kind>(random.integer(0, 2));
    step.to = {random.real(0, 400), random.real(0, 300)};
    step.a = {random.real(5, 400), random.real(5, 300)};
    step.b = {random.real(0, 90), step.kind == PathStep::Kind::arc ? 0 : random.real(0, 300)};
    step.is_large = random.integer(0, 1) == 1;
    step.is_clockwise = random.integer(0, 1) == 1;
    return step;
}

VectorDrawing random_drawing(Random& random, std::size_t count, std::size_t groups = 2) {
    VectorDrawing drawing;
    drawing.width_px = 400;
    drawing.height_px = 300;
    drawing.crop = {0, 0, 400, 300};
    drawing.styles.resize(2);
    drawing.styles[1].width_px = 3;
    for (std::size_t g = 0; g < groups; ++g) {
        VectorGroup group;
        group.first_path = drawing.paths.size();
        group.path_count = count;
        group.is_hidden = g == 0;
        drawing.groups.push_back(group);
        for (std::size_t i = 0; i < count; ++i) {
            VectorPath path;
            path.start = {random.real(0, 400), random.real(0, 300)};
            path.style = static_cast<std::uint32_t>(random.integer(0, 1));
            path.first_step = drawing.steps.size();
            path.step_count = static_cast<std::size_t>(random.integer(1, 4));
            for (std::size_t k = 0; k < path.step_count; ++k) drawing.steps.push_back(random_step(random));
            path.first_edge = drawing.edges.size();
            path.edge_count = 1;
            drawing.edges.push_back(drawing.edges.size());
            drawing.paths.push_back(path);
        }
    }
    return drawing;
}

/// Places on all paths of one style, rounded and sorted: the same for paths that are turned round, cut or joined.
using Places = std::multiset<std::array<long, 4>>;
Places places_of(const VectorDrawing& drawing) {
    Places places;
    for (const VectorGroup& group : drawing.groups) {
        for (const VectorPath& path : drawing.paths_of(group)) {
            glm::dvec2 from = path.start;
            for (const PathStep& step : drawing.steps_of(path)) {
                for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
                    const double s = 1 - t;
                    const glm::dvec2 p =
                        step.kind == PathStep::Kind::line ? glm::mix(from, step.to, t)
                        : step.kind == PathStep::Kind::arc
                            ? ellipse_of_arc(from, step).at(t)
                            : s * s * s * from + 3 * s * s * t * step.a + 3 * s * t * t * step.b + t * t * t * step.to;
                    places.insert({std::lround(p.x * 1000), std::lround(p.y * 1000), path.style % 2, group.is_hidden});
                }
                from = step.to;
            }
        }
    }
    return places;
}

TEST(PathOrder, CanBeStopped) {
    Random random(7);
    VectorDrawing drawing = random_drawing(random, 20);
    const StopFlag flag(true);
    const StopScope scope(flag);
    EXPECT_THROW(merge_paths(drawing), Interrupted);
    EXPECT_THROW(sort_for_pen(drawing), Interrupted);
    EXPECT_THROW(svg_of(drawing, {}), Interrupted);
}

TEST(PathOrder, SortingKeepsAllLinesAndSavesTravel) {
    for (std::uint64_t trial = 0; trial < 20; ++trial) {
        Random random(trial);
        VectorDrawing drawing = random_drawing(random, 40);
        const Places before = places_of(drawing);
        const PenTravel travel = sort_for_pen(drawing);
        EXPECT_EQ(places_of(drawing), before) << trial;
        EXPECT_LT(travel.after_px, 0.5 * travel.before_px) << trial;
    }
}

/// Each path is the nearest of those that are left, found by looking at all.
TEST(PathOrder, TheNextPathIsTheNearest) {
    for (std::uint64_t trial = 0; trial < 20; ++trial) {
        Random random(trial);
        VectorDrawing drawing = random_drawing(random, 30, 1);
        for (PathStep& step : drawing.steps) step.to *= trial % 3 == 0 ? 3.0 : 1.0;  // beyond the picture, too
        sort_for_pen(drawing);
        glm::dvec2 pen(0.0);
        for (std::size_t i = 0; i < drawing.paths.size(); ++i) {
            const double next = glm::distance(pen, drawing.paths[i].start);
            for (std::size_t k = i; k < drawing.paths.size(); ++k) {
                EXPECT_LE(next, glm::distance(pen, drawing.paths[k].start));
                EXPECT_LE(next, glm::distance(pen, drawing.steps_of(drawing.paths[k]).back().to));
            }
            pen = drawing.steps_of(drawing.paths[i]).back().to;
        }
    }
}

TEST(PathOrder, PatternsOfDashesAreNotTurnedRound) {
    Random random(7);
    VectorDrawing drawing = random_drawing(random, 30, 1);
    for (VectorStyle& style : drawing.styles) style.dash_px = {4, 3};
    std::set<std::pair<double, double>> before, after;
    for (const VectorPath& path : drawing.paths) before.emplace(path.start.x, path.start.y);
    sort_for_pen(drawing);
    for (const VectorPath& path : drawing.paths) after.emplace(path.start.x, path.start.y);
    EXPECT_EQ(before, after);
}

/// A long line, cut into parts that are turned round and shuffled, becomes one again.
TEST(PathOrder, MergingJoinsWhatMeets) {
    for (std::uint64_t trial = 0; trial < 20; ++trial) {
        Random random(trial);
        VectorDrawing drawing;
        drawing.crop = {0, 0, 400, 300};
        drawing.styles.resize(1);
        const bool is_ring = trial % 2 == 0;
        std::vector<glm::dvec2> points;
        for (int i = 0; i <= 12; ++i) points.emplace_back(random.real(0, 400), random.real(0, 300));
        if (is_ring) points.back() = points.front();
        for (std::size_t i = 0; i < 12; ++i) {
            const bool turns = random.integer(0, 1) == 1;
            PathStep step = random_step(random);
            step.to = points[turns ? i : i + 1];
            VectorPath path;
            path.start = points[turns ? i + 1 : i];
            path.first_step = drawing.steps.size();
            path.step_count = 1;
            path.first_edge = drawing.edges.size();
            path.edge_count = 1;
            path.unnamed_edges = i;
            drawing.steps.push_back(step);
            drawing.edges.push_back(i);
            drawing.paths.push_back(path);
        }
        for (std::size_t i = 11; i > 0; --i)
            std::swap(drawing.paths[i],
                      drawing.paths[static_cast<std::size_t>(random.integer(0, static_cast<int>(i)))]);
        drawing.groups.push_back({});
        drawing.groups[0].path_count = 12;
        const Places before = places_of(drawing);
        merge_paths(drawing);
        ASSERT_EQ(drawing.paths.size(), 1u) << trial;
        EXPECT_EQ(drawing.paths[0].is_closed, is_ring);
        EXPECT_EQ(drawing.paths[0].edge_count, 12u);
        EXPECT_EQ(drawing.paths[0].unnamed_edges, 66u);
        EXPECT_EQ(places_of(drawing), before);
    }
}

TEST(PathOrder, MergingKeepsLooksApart) {
    Random random(3);
    VectorDrawing drawing = random_drawing(random, 20);
    for (std::size_t i = 0; i + 1 < drawing.paths.size(); i += 2) {
        drawing.paths[i + 1].start = drawing.steps_of(drawing.paths[i]).back().to;
        drawing.paths[i].style = 0;
        drawing.paths[i + 1].style = i % 4 == 0 ? 1 : 0;
    }
    const Places before = places_of(drawing);
    merge_paths(drawing);
    EXPECT_EQ(drawing.paths.size(), 30u);
    EXPECT_EQ(places_of(drawing), before);
}

TEST(PathOrder, OpaquePathsAreSolidOrNotThere) {
    Random random(3);
    VectorDrawing drawing = random_drawing(random, 5);
    drawing.styles.resize(4);
    drawing.styles[0].opacity = 0.49f;
    drawing.styles[1].opacity = 0.5f;
    for (std::size_t i = 0; i < drawing.paths.size(); ++i) drawing.paths[i].style = i < 5 ? 0 : i % 2 + 1;
    for (VectorGroup& group : drawing.groups) group.is_hidden = false;
    const OpaquePaths made = make_opaque(drawing);
    EXPECT_EQ(made.left_out, 5u);
    EXPECT_EQ(made.solid, 2u);
    ASSERT_EQ(drawing.groups.size(), 1u);
    EXPECT_EQ(drawing.groups[0].path_count, 5u);
    EXPECT_EQ(drawing.paths.size(), 5u);
    for (const VectorStyle& style : drawing.styles) EXPECT_EQ(style.opacity, 1);
}

/// What is pale as a whole stays; what is much paler than others of its set goes.
TEST(PathOrder, OpaqueIsMeasuredByTheStrongestOfASet) {
    Random random(3);
    VectorDrawing drawing = random_drawing(random, 3);
    ASSERT_EQ(drawing.paths.size(), 6u);
    drawing.groups.resize(3);
    for (std::size_t i = 0; i < 3; ++i) {
        drawing.groups[i].first_path = 2 * i;
        drawing.groups[i].path_count = 2;
        drawing.groups[i].set = i < 2 ? 0 : 1;
        drawing.groups[i].is_hidden = false;
    }
    const float opacities[] = {0.3f, 0.1f, 0.2f, 0.14f, 1, 0.4f};
    drawing.styles.assign(6, drawing.styles[0]);
    for (std::uint32_t i = 0; i < 6; ++i) {
        drawing.styles[i].opacity = opacities[i];
        drawing.paths[i].style = i;
    }
    const OpaquePaths made = make_opaque(drawing);
    EXPECT_EQ(made.left_out, 3u);
    EXPECT_EQ(made.solid, 2u);
    ASSERT_EQ(drawing.groups.size(), 3u);
    for (const VectorGroup& group : drawing.groups) EXPECT_EQ(group.path_count, 1u);
}

TEST(PathOrder, HairlinesAreAllAlike) {
    Random random(3);
    VectorDrawing drawing = random_drawing(random, 5);
    drawing.styles[0].width_px = 0;
    drawing.styles[1].dash_px = {3, 2};
    make_hairlines(0.05, drawing);
    for (const VectorStyle& style : drawing.styles) {
        EXPECT_FLOAT_EQ(style.width_px, 0.05f);
        EXPECT_TRUE(style.dash_px.empty());
    }
}

TEST(ViewSheet, ViewsShareLayersAndHaveNames) {
    Random random(1);
    VectorDrawing sheet;
    const VectorDrawing front = random_drawing(random, 3), top = random_drawing(random, 4);
    add_view(front, "front", sheet);
    add_view(top, "top", sheet);
    ASSERT_EQ(sheet.groups.size(), 4u);
    EXPECT_TRUE(sheet.groups[0].is_hidden && sheet.groups[1].is_hidden);
    EXPECT_FALSE(sheet.groups[2].is_hidden || sheet.groups[3].is_hidden);
    Places both = places_of(front);
    both.merge(places_of(top));
    EXPECT_EQ(places_of(sheet), both);
    const std::string text = svg_of(sheet);
    EXPECT_NE(text.find("id=\"hidden-front-s0-silhouette\""), std::string::npos);
    EXPECT_NE(text.find("id=\"visible-top-s0-silhouette\""), std::string::npos);
    EXPECT_EQ(text.find("layer-visible-2"), std::string::npos);
}

}  // namespace
}  // namespace burin
