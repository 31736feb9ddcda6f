// Where triangles are in front of lines: the kernel beside clip_where_hidden().

#include "abuffer/edges/occluder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/kernels.h"
#include "tests/support/random.h"

namespace burin::occluder_test {
namespace {

using namespace test;

struct Expected {
    std::uint32_t triangle;
    bool is_any, is_level;
    double begin, end, level_begin, level_end;
};

/// Corners on few places, so that lines meet them and run along edges.
Occluder random_triangle(Random& random, int places) {
    Occluder t{};
    const auto place = [&] { return static_cast<double>(random.integer(0, places)); };
    double area = 0;
    while (area == 0) {
        for (std::size_t k = 0; k < 3; ++k) {
            t.x[k] = place();
            t.y[k] = place();
        }
        area = (t.x[1] - t.x[0]) * (t.y[2] - t.y[0]) - (t.y[1] - t.y[0]) * (t.x[2] - t.x[0]);
    }
    if (area < 0) {
        std::swap(t.x[1], t.x[2]);
        std::swap(t.y[1], t.y[2]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t n = (k + 1) % 3;
        t.owns_edge[k] = t.y[n] < t.y[k] || (t.y[n] == t.y[k] && t.x[n] > t.x[k]);
    }
    t.nearness = random.integer(-2, 6);
    t.per_x = random.integer(0, 1) == 0 ? 0 : random.real(-1, 1) / places;
    t.per_y = random.integer(0, 1) == 0 ? 0 : random.real(-1, 1) / places;
    t.slack = std::abs(t.per_x) + std::abs(t.per_y);
    return t;
}

TEST(Occluder, TheKernelClipsAsOneByOne) {
    Random random(21);
    int hidden = 0, partly = 0, level = 0, along_edges = 0;
    for (int round = 0; round < 20000; ++round) {
        std::vector<Occluder> triangles(static_cast<std::size_t>(random.integer(0, 9)));
        const int places = random.integer(0, 1) == 0 ? 8 : 5000;
        const auto place = [&] { return static_cast<double>(random.integer(0, places)); };
        for (Occluder& t : triangles) t = random_triangle(random, places);
        WholeLine line;
        while (line.from == line.to) {
            line.from = {place(), place()};
            line.to = {place(), place()};
        }
        line.nearness_from = random.integer(0, 4);
        line.nearness_to = random.integer(0, 1) == 0 ? line.nearness_from : random.real(0, 4);
        double begin = 0, end = 1;
        if (random.integer(0, 2) == 0) {
            begin = random.real(0, 0.5);
            end = random.real(0.5, 1);
        }
        const double slack = random.integer(0, 1) == 0 ? 0 : 0.25;
        const glm::dvec2 a = glm::mix(line.from, line.to, begin), b = glm::mix(line.from, line.to, end);
        std::vector<Expected> expected;
        std::vector<const TrianglePlane*> planes;
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
            const Occluder& t = triangles[i];
            planes.push_back(&t);
            const double certain = slack + t.slack;
            const double at_begin = t.nearness_at(a) - line.nearness_at(begin),
                         at_end = t.nearness_at(b) - line.nearness_at(end);
            if (std::max(at_begin, at_end) < -certain) continue;
            Expected e{i, false, false, begin, end, begin, end};
            e.is_level = std::min(at_begin, at_end) <= certain &&
                         clip_where_hidden(line, -certain, t, e.level_begin, e.level_end);
            e.is_any = clip_where_hidden(line, certain, t, e.begin, e.end);
            double first = begin, last = end;
            along_edges += clip_where_hidden(line, certain, t, first, last, true) && !e.is_any;
            if (e.is_any || e.is_level) expected.push_back(e);
            hidden += e.is_any;
            partly += e.is_any && (e.begin > begin || e.end < end);
            level += e.is_level;
        }
        const PlaneLine plane_line{
            {line.from.x, line.to.x, a.x, b.x},
            {line.from.y, line.to.y, a.y, b.y},
            {line.nearness_from, line.nearness_to, line.nearness_at(begin), line.nearness_at(end)},
            begin,
            end,
            slack};
        for (const TileKernels* kernels : all_kernels()) {
            std::vector<HiddenPart> parts(triangles.size());
            parts.resize(kernels->hide.clip(planes.data(), planes.size(), plane_line, parts.data()));
            ASSERT_EQ(parts.size(), expected.size()) << kernels->name << " round " << round;
            for (std::size_t k = 0; k < parts.size(); ++k) {
                const HiddenPart& p = parts[k];
                const Expected& e = expected[k];
                EXPECT_TRUE(p.triangle == e.triangle && p.is_any == e.is_any && p.is_level == e.is_level)
                    << kernels->name << " round " << round;
                EXPECT_TRUE(!e.is_level || (p.level_begin == e.level_begin && p.level_end == e.level_end))
                    << kernels->name << " round " << round;
                if (!e.is_any) continue;
                EXPECT_TRUE(p.begin == e.begin && p.end == e.end) << kernels->name << " round " << round;
            }
        }
    }
    EXPECT_GT(hidden, 1500);
    EXPECT_GT(partly, 1000);
    EXPECT_GT(level, 3000);
    EXPECT_GT(along_edges, 5);
}

TEST(Occluder, TheKernelClipsTwiceAsOnceAndAgain) {
    int any = 0, only_most = 0, along_edges = 0, none = 0;
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        Random random(seed);
        const int places = random.integer(0, 1) == 0 ? 8 : 5000;
        const Occluder t = random_triangle(random, places);
        WholeLine line;
        while (line.from == line.to) {
            for (glm::dvec2* end : {&line.from, &line.to})
                *end = {random.integer(0, places), random.integer(0, places)};
        }
        line.nearness_from = random.integer(-2, 6);
        line.nearness_to = random.integer(0, 1) == 0 ? line.nearness_from : random.integer(-2, 6);
        const double begin = random.real(0, 0.5), end = random.real(0.5, 1);
        const double slack = random.integer(0, 2) * 0.5, least = -random.integer(0, 2) * 0.5;
        double most_begin = begin, most_end = end, own_begin = begin, own_end = end;
        const bool is_any_most = clip_where_hidden(line, least, t, most_begin, most_end, true);
        const bool is_any = is_any_most && clip_where_hidden(line, slack, t, own_begin, own_end);
        const PlaneLine clipped{
            {line.from.x, line.to.x}, {line.from.y, line.to.y}, {line.nearness_from, line.nearness_to}, begin, end, 0};
        for (const TileKernels* kernels : all_kernels()) {
            HiddenParts parts;
            kernels->fine.clip_twice(t, clipped, least, slack, parts);
            ASSERT_EQ(parts.is_any_most, is_any_most) << kernels->name << " seed " << seed;
            if (!is_any_most) continue;
            ASSERT_EQ(parts.is_any, is_any) << kernels->name << " seed " << seed;
            ASSERT_EQ(std::pair(parts.most_begin, parts.most_end), std::pair(most_begin, most_end))
                << kernels->name << " seed " << seed;
            if (is_any) {
                ASSERT_EQ(std::pair(parts.begin, parts.end), std::pair(own_begin, own_end))
                    << kernels->name << " seed " << seed;
            }
        }
        ++(is_any ? any : is_any_most ? only_most : none);
        if (!is_any_most) continue;
        double without_edges_begin = begin, without_edges_end = end;
        along_edges += clip_where_hidden(line, least, t, without_edges_begin, without_edges_end) ? 0 : 1;
    }
    EXPECT_GT(any, 1000);
    EXPECT_GT(only_most, 200);
    EXPECT_GT(along_edges, 20);
    EXPECT_GT(none, 5000);
}

TEST(Occluder, FewNumbersAreSorted) {
    Random random(7);
    for (int round = 0; round < 2000; ++round) {
        std::vector<double> values(static_cast<std::size_t>(random.integer(0, 70)));
        for (double& v : values) v = random.integer(0, 1) == 0 ? random.real(0, 1) : random.integer(0, 4) / 4.0;
        std::vector<double> expected = values;
        std::sort(expected.begin(), expected.end());
        std::vector<double> read = values;
        read.resize(values.size() + 3);
        for (const TileKernels* kernels : all_kernels()) {
            std::vector<double> sorted(values.size());
            kernels->sort.few(read.data(), values.size(), sorted.data());
            EXPECT_EQ(sorted, expected) << kernels->name << " round " << round;
        }
    }
}

}  // namespace
}  // namespace burin::occluder_test
