// Borders of heaps of long thin polygons, whose boxes lie over each other by the hundred.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/border_index.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;
using Segment = BorderIndex::Segment;

/// Two long borders each, of one polygon: in all directions, or through a point.
std::vector<Segment> straws(Random& random, int count, bool meet) {
    std::vector<Segment> segments;
    HalfEdge h = 0;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 from = meet ? glm::dvec3(0.0) : random.in_box(0.4),
                         along = random.real(0.3, 1) * random.direction();
        for (int side = 0; side < 2; ++side) {
            const glm::dvec3 beside = 0.002 * random.direction();
            h += static_cast<HalfEdge>(random.integer(1, 4));
            segments.push_back({h, static_cast<std::uint32_t>(i), glm::vec3(meet ? from : from + beside),
                                glm::vec3(from + along + beside)});
        }
    }
    return segments;
}

double distance_to(const Segment& s, const glm::dvec3& p) {
    const glm::dvec3 a(s.a), d = glm::dvec3(s.b) - a;
    return glm::distance(p, a + d * std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0));
}

/// The definition, written down once more.
std::optional<HalfEdge> partner_by_search(const std::vector<Segment>& segments, const Segment& own,
                                          const glm::dvec3& at, double reach_part = 0.05) {
    const glm::dvec3 along = glm::dvec3(own.b) - glm::dvec3(own.a);
    double nearest = reach_part * glm::length(along);
    std::optional<HalfEdge> partner;
    for (const Segment& s : segments) {
        const glm::dvec3 d = glm::dvec3(s.b) - glm::dvec3(s.a);
        const bool is_parallel = std::abs(glm::dot(along, d)) > 0.9 * glm::length(along) * glm::length(d);
        if (s.polygon == own.polygon || !is_parallel || distance_to(s, at) >= nearest) continue;
        nearest = distance_to(s, at);
        partner = s.half_edge;
    }
    return partner;
}

TEST(BorderCrowd, PartnersAreThoseOfASearchThroughAll) {
    int found = 0, asked = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Random random(seed);
        const std::vector<Segment> segments = straws(random, 400, seed % 3 == 0);
        const BorderIndex index(segments);
        ASSERT_TRUE(index.has_crowds());
        for (const Segment& own : segments) {
            const glm::dvec3 at = glm::mix(glm::dvec3(own.a), glm::dvec3(own.b), random.real(0, 1));
            const auto expected = partner_by_search(segments, own, at, index.reach_part());
            ASSERT_EQ(index.seam_partner(own.half_edge, at), expected) << "seed " << seed;
            found += expected.has_value();
            ++asked;
        }
    }
    EXPECT_GT(found, asked / 5);
    EXPECT_LT(found, asked * 9 / 10);
}

/// Where the partner passes near a line of sight it is found; where it does not, there is the same
/// one or none.
TEST(BorderCrowd, WhatIsSeenNearAPlaceIsFoundAlongTheLineOfSight) {
    int seen = 0, unseen = 0, left_out = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Random random(seed);
        const std::vector<Segment> segments = straws(random, 400, seed % 3 == 0);
        const BorderIndex index(segments);
        for (const Segment& own : segments) {
            const glm::dvec3 at = glm::mix(glm::dvec3(own.a), glm::dvec3(own.b), random.real(0, 1));
            BorderIndex::Sight sight;
            sight.direction = random.direction();
            sight.radius = random.real(0.002, 0.02);
            sight.growth = random.integer(0, 1) == 0 ? 0 : random.real(0, 0.01);
            const auto expected = partner_by_search(segments, own, at, index.reach_part()),
                       partner = index.seam_partner(own.half_edge, at, sight);
            if (partner) {
                ASSERT_EQ(partner, expected) << "seed " << seed;
            }
            if (!expected) continue;
            const Segment& other = *std::find_if(segments.begin(), segments.end(),
                                                 [&](const Segment& s) { return s.half_edge == *expected; });
            bool is_seen = false;
            for (int step = 0; step <= 2000 && !is_seen; ++step) {
                const glm::dvec3 off = glm::mix(glm::dvec3(other.a), glm::dvec3(other.b), step / 2000.0) - at;
                const double away = glm::dot(off, sight.direction);
                is_seen = glm::length(off - away * sight.direction) < sight.radius + sight.growth * std::abs(away);
            }
            if (is_seen) {
                ASSERT_EQ(partner, expected) << "seed " << seed;
            }
            seen += is_seen;
            unseen += !is_seen;
            left_out += !partner;
        }
    }
    EXPECT_GT(seen, 300);
    EXPECT_GT(left_out, unseen / 2);
    EXPECT_GT(left_out, 300);
}

/// What runs along a part of an edge has the partners of all places on that part, and few others.
TEST(BorderCrowd, StretchesHaveThePartnersOfTheirPlaces) {
    std::size_t places = 0, listed = 0, with_partner = 0, of_whole = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        Random random(seed);
        const std::vector<Segment> segments = straws(random, 300, seed % 3 == 0);
        const BorderIndex index(segments);
        BorderIndex::SeamCandidates along, whole;
        for (std::size_t i = 0; i < segments.size(); i += 7) {
            const Segment& own = segments[i];
            ASSERT_TRUE(index.find_along(own.half_edge, BorderIndex::kMostNear, whole));
            for (int k = 0; k < 16; ++k) {
                ASSERT_TRUE(index.find_along(own.half_edge, {k / 16.0, (k + 1) / 16.0}, BorderIndex::kMostNear, along));
                listed += along.segments().size();
                of_whole += whole.segments().size();
                for (int step = 0; step <= 20; ++step, ++places) {
                    const double share = (k + step / 20.0) / 16;
                    const glm::dvec3 at = glm::mix(glm::dvec3(own.a), glm::dvec3(own.b), share);
                    const auto expected = index.seam_partner(own.half_edge, at);
                    ASSERT_EQ(along.nearest(at), expected) << "seed " << seed << " share " << share;
                    with_partner += expected.has_value();
                }
            }
        }
    }
    EXPECT_GT(with_partner, places / 10);
    EXPECT_LT(listed, of_whole / 4);
}

TEST(BorderCrowd, NearOnesAreAllThatMayBePartnersAnywhere) {
    int few = 0, many = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Random random(seed);
        const std::vector<Segment> segments = straws(random, 500, seed % 4 == 0);
        const BorderIndex index(segments);
        BorderIndex::SeamCandidates near;
        for (std::size_t i = 0; i < segments.size(); i += 5) {
            const Segment& own = segments[i];
            const std::size_t most = seed % 2 == 0 ? BorderIndex::kMostNear : 40;
            // Counts the borders within its reach somewhere, by sampling: a few at the limit are missing.
            std::size_t least = 0;
            const glm::dvec3 along = glm::dvec3(own.b) - glm::dvec3(own.a);
            const double reach = index.reach_part() * glm::length(along);
            for (const Segment& s : segments) {
                bool is_near = false;
                for (int step = 0; step <= 40 && !is_near; ++step) {
                    is_near = distance_to(s, glm::mix(glm::dvec3(own.a), glm::dvec3(own.b), step / 40.0)) < reach;
                }
                least += is_near;
            }
            if (!index.find_near(own.half_edge, most, near)) {
                ++many;
                ASSERT_GT(2 * least, most);
                ASSERT_TRUE(near.segments().empty());
                continue;
            }
            ++few;
            ASSERT_LE(least, most);
            for (int step = 0; step <= 20; ++step) {
                const glm::dvec3 at = glm::mix(glm::dvec3(own.a), glm::dvec3(own.b), step / 20.0);
                ASSERT_EQ(near.nearest(at), index.seam_partner(own.half_edge, at)) << "seed " << seed;
            }
        }
    }
    EXPECT_GT(few, 100);
    EXPECT_GT(many, 100);
}

/// Those along an edge are counted by sampling, by which a few at the limit are missing.
std::size_t count_along(const std::vector<Segment>& segments, const Segment& own, double reach) {
    const glm::dvec3 along = own.b - own.a;
    return static_cast<std::size_t>(std::count_if(segments.begin(), segments.end(), [&](const Segment& s) {
        const glm::dvec3 way = s.b - s.a;
        if (s.polygon == own.polygon || !(std::abs(glm::dot(along, way)) > 0.9 * glm::length(along) * glm::length(way)))
            return false;
        for (int step = 0; step <= 40; ++step) {
            if (distance_to(s, glm::mix(own.a, own.b, step / 40.0)) < reach) return true;
        }
        return false;
    }));
}

TEST(BorderCrowd, ThoseAlongAnEdgeAreAllThatMayBePartnersAnywhere) {
    int few = 0, many = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Random random(seed);
        const std::vector<Segment> segments = straws(random, 500, seed % 4 == 0);
        const BorderIndex index(segments);
        BorderIndex::SeamCandidates listed;
        for (std::size_t i = 0; i < segments.size(); i += 5) {
            const Segment& own = segments[i];
            const std::size_t least = count_along(segments, own, index.reach_part() * glm::distance(own.a, own.b));
            const std::size_t most = seed % 2 == 0 ? BorderIndex::kMostNear : 3;
            if (!index.find_along(own.half_edge, most, listed)) {
                ++many;
                ASSERT_GT(2 * least, most) << "seed " << seed;
                ASSERT_TRUE(listed.segments().empty());
                continue;
            }
            ++few;
            ASSERT_LE(least, most) << "seed " << seed;
            for (int step = 0; step <= 20; ++step) {
                const glm::dvec3 at = glm::mix(own.a, own.b, step / 20.0);
                ASSERT_EQ(listed.nearest(at), index.seam_partner(own.half_edge, at)) << "seed " << seed;
            }
        }
    }
    EXPECT_GT(few, 100);
    EXPECT_GT(many, 10);
}

/// Needles through a point: boxes around their long borders nearly all have one middle, and their short ends lie far
/// away from it.
std::vector<Segment> pins(Random& random, std::uint32_t count) {
    std::vector<Segment> segments;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 tip = random.direction(), off = random.in_box(0.01);
        const std::array<glm::dvec3, 3> corners{tip, -tip + off, -tip - off};
        for (HalfEdge k = 0; k < 3; ++k) segments.push_back({3 * i + k, i, corners[k], corners[(k + 1) % 3]});
    }
    return segments;
}

/// The definition of what may lie beside a border, written down once more.
TEST(BorderCrowd, CandidatesAreThoseWhoseBoxesAreInReach) {
    std::size_t listed = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        Random random(seed);
        const std::vector<Segment> segments = seed % 2 == 0 ? pins(random, 200) : straws(random, 300, false);
        const BorderIndex index(segments);
        ASSERT_TRUE(index.has_crowds());
        for (const Segment& own : segments) {
            const glm::dvec3 along = own.b - own.a;
            const double reach = index.reach_part() * glm::length(along);
            const auto touches = [&](const Segment& s) {
                return glm::all(glm::lessThan(glm::min(s.a, s.b), glm::max(own.a, own.b) + reach)) &&
                       glm::all(glm::lessThan(glm::min(own.a, own.b) - reach, glm::max(s.a, s.b)));
            };
            std::vector<HalfEdge> expected, found;
            std::size_t touching = 0;
            for (const Segment& s : segments) {
                if (!touches(s)) continue;
                ++touching;
                const glm::dvec3 way = s.b - s.a;
                const bool is_parallel = std::abs(glm::dot(along, way)) > 0.9 * glm::length(along) * glm::length(way);
                if (s.polygon != own.polygon && is_parallel) expected.push_back(s.half_edge);
            }
            BorderIndex::SeamCandidates candidates;
            ASSERT_TRUE(index.find_candidates(own.half_edge, touching, candidates)) << "seed " << seed;
            for (const Segment& s : candidates.segments()) found.push_back(s.half_edge);
            std::sort(found.begin(), found.end());
            ASSERT_EQ(found, expected) << "seed " << seed;
            ASSERT_FALSE(index.find_candidates(own.half_edge, touching - 1, candidates)) << "seed " << seed;
            std::vector<std::uint32_t> in_box;
            index.find_in_box(glm::min(own.a, own.b), glm::max(own.a, own.b), in_box);
            ASSERT_TRUE(std::any_of(in_box.begin(), in_box.end(),
                                    [&](std::uint32_t i) { return segments[i].half_edge == own.half_edge; }));
            listed += found.size();
        }
    }
    EXPECT_GT(listed, 10000u);
}

TEST(BorderCrowd, MoreThanAskedForAreNotListed) {
    std::vector<Segment> segments;
    for (HalfEdge h = 0; h < 60; ++h) segments.push_back({h, h, {0, 0, 0}, {1, static_cast<float>(h) / 10000, 0}});
    const BorderIndex index(segments);
    BorderIndex::SeamCandidates candidates;
    EXPECT_TRUE(index.find_candidates(0, 60, candidates));
    EXPECT_EQ(candidates.segments().size(), 59u);
    EXPECT_FALSE(index.find_candidates(0, 59, candidates));
    EXPECT_TRUE(candidates.segments().empty());
    EXPECT_TRUE(index.find_near(0, 60, candidates));
    EXPECT_EQ(candidates.segments().size(), 59u);
    EXPECT_FALSE(index.find_near(0, 59, candidates));
    EXPECT_TRUE(candidates.segments().empty());
}

/// However many borders lie over each other, few are in reach of one; equal ones are.
TEST(BorderCrowd, ReachIsHalvedUntilFewAreInReach) {
    for (const double jitter : {1e-2, 1e-4, 1e-6, 0.0}) {
        Random random(2);
        std::vector<Segment> segments;
        for (HalfEdge h = 0; h < 500; ++h) {
            const glm::dvec3 a = jitter * random.in_box(1), b = glm::dvec3(1, 2, 3) + jitter * random.in_box(1);
            segments.push_back({h, h, a, b});
        }
        const BorderIndex index(segments);
        EXPECT_LE(index.reach_part(), 0.025);
        double in_reach = 0;
        for (const Segment& own : segments) {
            const glm::dvec3 middle = 0.5 * (own.a + own.b);
            for (const Segment& s : segments)
                in_reach += s.polygon != own.polygon &&
                            distance_to(s, middle) <= index.reach_part() * glm::distance(own.a, own.b);
        }
        if (jitter > 0) {
            EXPECT_LE(in_reach / 500, 6) << jitter;
            EXPECT_GE(in_reach / 500, 1) << jitter;
        } else {
            EXPECT_EQ(index.seam_partner(5, {0.5, 1, 1.5}), HalfEdge{0});
        }
    }
}

TEST(BorderCrowd, OnePolygonHasNoPartners) {
    std::vector<Segment> segments;
    for (HalfEdge h = 0; h < 100; ++h) segments.push_back({h, 7, {0, 0, 0}, {1, 0, 0}});
    EXPECT_EQ(BorderIndex(segments).reach_part(), 0);
    EXPECT_EQ(BorderIndex(segments).seam_partner(0, {0.5, 0, 0}), std::nullopt);
    EXPECT_FALSE(BorderIndex(segments).has_partners());
    BorderIndex::SeamCandidates along;
    EXPECT_TRUE(BorderIndex(segments).find_along(0, {0.2, 0.4}, 1, along));
    EXPECT_TRUE(along.segments().empty());
}

/// Boxes of short segments tell enough by themselves.
TEST(BorderCrowd, OrdinaryBordersAreNone) {
    std::vector<Segment> segments;
    for (HalfEdge h = 0; h < 10000; ++h) {
        const double a = 0.01 * h, b = 0.01 * (h + 1);
        segments.push_back({h, h, {std::cos(a), std::sin(a), 0.001 * a}, {std::cos(b), std::sin(b), 0.001 * b}});
    }
    EXPECT_FALSE(BorderIndex(segments).has_crowds());
    EXPECT_FALSE(BorderIndex().has_crowds());
}

/// A search looks at few pieces of many segments.
TEST(BorderCrowd, SearchesLookAtFewPieces) {
    Random random(1);
    std::vector<SegmentPiece> pieces;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const glm::vec3 low(random.in_box(1));
        pieces.push_back({low, low + glm::vec3(0.02f), i});
    }
    const SegmentTree tree(pieces);
    std::size_t visited = 0;
    for (int i = 0; i < 1000; ++i) {
        double reach = 0.05;
        const glm::dvec3 at = random.in_box(1);
        std::size_t nearest = 0;
        tree.visit_nearest(at, reach, [&](std::uint32_t p) {
            ++visited;
            const glm::dvec3 outside =
                glm::max(glm::max(glm::dvec3(pieces[p].low) - at, at - glm::dvec3(pieces[p].high)), glm::dvec3(0.0));
            if (glm::length(outside) < reach) {
                reach = glm::length(outside);
                nearest = p + 1;
            }
        });
        double least = 0.05;
        for (const SegmentPiece& p : pieces) {
            least = std::min(least, glm::length(glm::max(glm::max(glm::dvec3(p.low) - at, at - glm::dvec3(p.high)),
                                                         glm::dvec3(0.0))));
        }
        ASSERT_EQ(reach, least);
        ASSERT_EQ(nearest != 0, least < 0.05);
    }
    EXPECT_LT(visited, 100u * 1000u);
}

}  // namespace
}  // namespace burin
