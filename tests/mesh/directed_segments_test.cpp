// Segments found by direction and place are all that a search through all of them finds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <set>
#include <vector>

#include <glm/glm.hpp>

#include "mesh/directed_segments.h"
#include "tests/support/random.h"

namespace burin::directed_segments_test {
namespace {

using test::Random;
using Ends = DirectedSegments::Ends;

enum class Heap { any, sheets, through_a_point, alike, far_away };
constexpr Heap kHeaps[] = {Heap::any, Heap::sheets, Heap::through_a_point, Heap::alike, Heap::far_away};

std::vector<Ends> segments_in(Random& random, Heap heap, int count) {
    std::vector<Ends> segments;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 place = random.in_box(1), way = random.real(0.01, 1) * random.direction();
        const double height = random.integer(0, 9) / 10.0;
        switch (heap) {
            case Heap::any:
                segments.push_back({place, place + way});
                break;
            case Heap::sheets:
                segments.push_back({{place.x, place.y, height}, {place.x + way.x, place.y + way.y, height}});
                break;
            case Heap::through_a_point:
                segments.push_back({-way, way});
                break;
            case Heap::alike:
                segments.push_back({place, place + glm::dvec3(0.5, 0.25, 0)});
                break;
            case Heap::far_away:
                segments.push_back({place + 1e6, place + way + 1e6});
                break;
        }
    }
    segments.push_back({segments.front().a, segments.front().a});  // without a direction
    return segments;
}

/// One that has a direction.
const Ends& any_of(Random& random, const std::vector<Ends>& segments) {
    return segments[static_cast<std::size_t>(random.integer(0, static_cast<int>(segments.size()) - 2))];
}

glm::dvec3 nearest_place(const Ends& s, const glm::dvec3& p) {
    const glm::dvec3 way = s.b - s.a;
    const double square = glm::dot(way, way);
    return s.a + (square > 0 ? std::clamp(glm::dot(p - s.a, way) / square, 0.0, 1.0) : 0.0) * way;
}

double distance_to(const Ends& s, const glm::dvec3& p) { return glm::distance(p, nearest_place(s, p)); }

bool runs_along(const Ends& s, const glm::dvec3& direction) {
    const glm::dvec3 way = s.b - s.a;
    return std::abs(glm::dot(way, direction)) > DirectedSegments::kCosParallel * glm::length(way);
}

/// How near two segments come to each other, by ever smaller steps to and fro.
double distance_between(const Ends& s, const Ends& t) {
    double least = distance_to(s, t.a);
    for (int k = 0; k <= 16; ++k) {
        glm::dvec3 place = glm::mix(t.a, t.b, k / 16.0);
        for (int step = 0; step < 64; ++step) place = nearest_place(t, nearest_place(s, place));
        least = std::min(least, distance_to(s, place));
    }
    return least;
}

TEST(DirectedSegments, NearestAlongADirectionAreThoseOfASearchThroughAll) {
    int found = 0, empty = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        // Up to three squares along a side of the cube of directions.
        const std::vector<Ends> segments =
            segments_in(random, kHeaps[seed % std::size(kHeaps)], seed < 20 ? 300 : 8000);
        const DirectedSegments directed(segments);
        for (int k = 0; k < 60; ++k) {
            const Ends& own = any_of(random, segments);
            const glm::dvec3 direction = random.integer(0, 3) == 0 ? random.direction() : glm::normalize(own.b - own.a);
            const glm::dvec3 at = glm::mix(own.a, own.b, random.real(0, 1));
            const double widest = std::pow(10, random.real(-6, -1));
            std::set<std::uint32_t> expected, visited;
            double nearest = widest;
            for (std::uint32_t i = 0; i < segments.size(); ++i) {
                const double distance = distance_to(segments[i], at);
                if (!runs_along(segments[i], direction) || distance > widest) continue;
                expected.insert(i);
                nearest = std::min(nearest, distance);
            }
            directed.visit_nearest(direction, at, widest, [&](std::uint32_t i) { visited.insert(i); });
            ASSERT_TRUE(std::includes(visited.begin(), visited.end(), expected.begin(), expected.end())) << seed;
            found += !expected.empty();
            empty += expected.empty();
            double reach = widest;
            directed.visit_nearest(direction, at, reach, [&](std::uint32_t i) {
                if (runs_along(segments[i], direction)) reach = std::min(reach, distance_to(segments[i], at));
            });
            ASSERT_EQ(reach, nearest) << seed;
        }
    }
    EXPECT_GT(found, 1000);
    EXPECT_GT(empty, 100);
}

TEST(DirectedSegments, WhatIsNearASegmentIsWhatASearchThroughAllFinds) {
    int found = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        Random random(seed);
        const std::vector<Ends> segments = segments_in(random, kHeaps[seed % std::size(kHeaps)], seed < 5 ? 100 : 1500);
        const DirectedSegments directed(segments);
        for (int k = 0; k < 10; ++k) {
            const Ends& own = any_of(random, segments);
            const double margin = std::pow(10, random.real(-4, -1));
            std::set<std::uint32_t> near, along, visited, visited_along;
            const glm::dvec3 way = own.b - own.a, at = glm::mix(own.a, own.b, random.real(0, 1));
            const glm::dvec3 direction = glm::normalize(way);
            for (std::uint32_t i = 0; i < segments.size(); ++i) {
                if (distance_between(segments[i], own) > margin) continue;
                near.insert(i);
                if (runs_along(segments[i], direction) && distance_to(segments[i], at) <= 1) along.insert(i);
            }
            directed.visit_near(own.a, own.b, margin, [&](std::uint32_t i) {
                visited.insert(i);
                return true;
            });
            ASSERT_TRUE(std::includes(visited.begin(), visited.end(), near.begin(), near.end())) << seed;
            const double reach = 1;
            directed.visit_nearest(direction, at, reach, own.a, own.b, margin,
                                   [&](std::uint32_t i) { visited_along.insert(i); });
            ASSERT_TRUE(std::includes(visited_along.begin(), visited_along.end(), along.begin(), along.end())) << seed;
            found += static_cast<int>(along.size());
        }
    }
    EXPECT_GT(found, 500);
}

/// In a heap few are looked at: of those that lie all over each other, those of one direction near the place.
TEST(DirectedSegments, FewOfAHeapAreVisited) {
    Random random(1);
    for (const Heap heap : {Heap::any, Heap::sheets, Heap::through_a_point}) {
        const std::vector<Ends> segments = segments_in(random, heap, 20000);
        const DirectedSegments directed(segments);
        std::size_t visits = 0;
        for (int k = 0; k < 200; ++k) {
            const Ends& own = any_of(random, segments);
            const double reach = 1e-6;
            directed.visit_nearest(glm::normalize(own.b - own.a), own.b, reach, [&](std::uint32_t) { ++visits; });
        }
        EXPECT_LT(visits / 200, segments.size() / 100);
    }
}

TEST(DirectedSegments, AVisitEndsWhenItSaysSo) {
    Random random(2);
    const std::vector<Ends> segments = segments_in(random, Heap::any, 5000);
    const DirectedSegments directed(segments);
    int visits = 0;
    directed.visit_near(glm::dvec3(-1), glm::dvec3(1), 1, [&](std::uint32_t) { return ++visits < 10; });
    EXPECT_EQ(visits, 10);
}

}  // namespace
}  // namespace burin::directed_segments_test
