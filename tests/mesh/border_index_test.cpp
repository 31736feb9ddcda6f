#include "mesh/border_index.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/build_meshes.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/support/random.h"

namespace burin::border_index_test {
namespace {

using test::Random;
using test::soup_of;
using Segment = BorderIndex::Segment;

/// The definition, written down once more.
std::optional<HalfEdge> partner_by_search(const std::vector<Segment>& segments, const Segment& own,
                                          const glm::dvec3& at, double reach_part = 0.05) {
    const glm::dvec3 along = glm::dvec3(own.b) - glm::dvec3(own.a);
    double nearest = reach_part * glm::length(along);
    std::optional<HalfEdge> partner;
    for (const Segment& s : segments) {
        const glm::dvec3 a(s.a), d = glm::dvec3(s.b) - a;
        const double t = std::clamp(glm::dot(at - a, d) / glm::dot(d, d), 0.0, 1.0);
        const double distance = glm::length(at - (a + t * d));
        const double cosine = glm::dot(along, d) / (glm::length(along) * glm::length(d));
        if (s.polygon == own.polygon || std::abs(cosine) <= 0.9 || distance >= nearest) continue;
        nearest = distance;
        partner = s.half_edge;
    }
    return partner;
}

TEST(BorderIndex, AgreesWithASearchThroughAllSegments) {
    int found = 0, asked = 0;
    constexpr std::size_t kAll = 1000;
    BorderIndex::SeamCandidates candidates;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        Random random(seed);
        std::vector<Segment> segments;
        // Lengths over several orders of magnitude, most of them along common directions.
        const double spread = random.real(0, 3);
        const glm::dvec3 main_direction = random.direction();
        HalfEdge h = 0;
        for (int i = random.integer(1, 150); i > 0; --i) {
            const glm::dvec3 middle = random.in_box(1);
            const glm::dvec3 direction = glm::normalize(main_direction + 0.3 * random.in_box(1));
            const glm::dvec3 half = std::pow(10.0, random.real(-spread, 1)) * direction;
            h += static_cast<HalfEdge>(random.integer(1, 5));
            segments.push_back({h, static_cast<std::uint32_t>(random.integer(0, 20)), glm::vec3(middle - half),
                                glm::vec3(middle + half)});
        }
        const BorderIndex index(segments);
        for (const Segment& own : segments) {
            const glm::dvec3 at = glm::mix(glm::dvec3(own.a), glm::dvec3(own.b), random.real(0, 1));
            const auto expected = partner_by_search(segments, own, at, index.reach_part());
            ASSERT_EQ(index.seam_partner(own.half_edge, at), expected)
                << "seed " << seed << ", half-edge " << own.half_edge;
            ASSERT_TRUE(index.find_candidates(own.half_edge, kAll, candidates));
            ASSERT_EQ(candidates.nearest(at), expected) << "seed " << seed << ", half-edge " << own.half_edge;
            found += expected.has_value();
            ++asked;
        }
    }
    EXPECT_GT(found, asked / 10) << "the test must reach both answers";
    EXPECT_LT(found, asked * 9 / 10);
}

TEST(BorderIndex, OneLongEdgeHasManyShortPartners) {
    std::vector<Segment> segments{{0, 0, {0, 0, 0}, {1, 0, 0}}};
    for (HalfEdge h = 1; h <= 10000; ++h) {
        const auto x = static_cast<float>(h);
        segments.push_back({h, h, {(x - 1) / 10000, 1e-6f, 0}, {x / 10000, 1e-6f, 0}});
    }
    const BorderIndex index(segments);
    for (HalfEdge h = 1; h <= 10000; ++h) {
        const glm::dvec3 middle = 0.5 * (glm::dvec3(segments[h].a) + glm::dvec3(segments[h].b));
        ASSERT_EQ(index.seam_partner(h, middle), 0u) << h;
        ASSERT_EQ(index.seam_partner(0, {middle.x, 0, 0}), h);
    }
    // The reach is that of the long edge, not of the others.
    EXPECT_TRUE(index.seam_partner(0, {0.5, 0.049, 0}).has_value());
    EXPECT_FALSE(index.seam_partner(0, {0.5, 0.051, 0}).has_value());
}

TEST(BorderIndex, EqualSegmentsGiveTheFirst) {
    std::vector<Segment> segments;
    for (HalfEdge h = 0; h < 100; ++h) segments.push_back({2 * h, h, {0, 0, 0}, {1, 0, 0}});
    const BorderIndex index(segments);
    EXPECT_EQ(index.seam_partner(0, {0.5, 0, 0}), 2u);
    for (HalfEdge h = 1; h < 100; ++h) EXPECT_EQ(index.seam_partner(2 * h, {0.5, 0, 0}), 0u);
}

TEST(BorderIndex, OnlyBorderEdgesHavePartners) {
    EXPECT_FALSE(BorderIndex().seam_partner(0, {0, 0, 0}).has_value());
    EXPECT_FALSE(BorderIndex(std::vector<Segment>{}).seam_partner(0, {0, 0, 0}).has_value());
    const BorderIndex index({{4, 0, {0, 0, 0}, {1, 0, 0}}, {6, 1, {0, 0, 0}, {1, 0, 0}}});
    EXPECT_FALSE(index.seam_partner(5, {0.5, 0, 0}).has_value());
    EXPECT_FALSE(index.seam_partner(7, {0.5, 0, 0}).has_value());
    EXPECT_EQ(index.seam_partner(4, {0.5, 0, 0}), 6u);
}

TEST(BorderIndex, CoordinatesMayHaveAnySize) {
    for (const float size : {1e-37f, 1e-30f, 1e-10f, 1.0f, 1e10f, 1e20f, 1e30f}) {
        std::vector<Segment> segments;
        for (HalfEdge h = 0; h < 20; ++h) {
            segments.push_back(
                {h, h, {size * static_cast<float>(h / 2), 0, 0}, {size * static_cast<float>(h / 2), size, 0}});
        }
        const BorderIndex index(segments);
        for (HalfEdge h = 0; h < 20; ++h) {
            const glm::dvec3 middle = 0.5 * (glm::dvec3(segments[h].a) + glm::dvec3(segments[h].b));
            EXPECT_EQ(index.seam_partner(h, middle), h ^ 1u) << size;
        }
    }
}

/// A patch between the quarter circle of radius 1 and one of radius `other`, in quadrilaterals.
void add_ring_patch(PolygonSoup& soup, double other, int steps) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (int i = 0; i <= steps; ++i) {
        const double angle = 0.5 * std::numbers::pi * i / steps;
        for (const double r : {1.0, other}) soup.positions.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    }
    for (int i = 0; i < steps; ++i) {
        const std::uint32_t v = first + 2 * static_cast<std::uint32_t>(i);
        const std::uint32_t quad[4] = {v, v + 1, v + 3, v + 2};
        soup.add_polygon(quad);
    }
}

TEST(SeamPartner, PatchesAlongOneCurveAreSeamsOfEachOther) {
    for (const auto& [inner_steps, outer_steps] : {std::pair{16, 17}, {16, 24}, {20, 40}, {30, 30}}) {
        PolygonSoup soup = soup_of({}, {});
        add_ring_patch(soup, 0.5, inner_steps);
        add_ring_patch(soup, 2.0, outer_steps);
        const std::vector<Mesh> meshes = build_meshes(soup, {});
        const Mesh& mesh = meshes.at(0);
        int seams = 0;
        for (const Segment& s : mesh.borders.segments()) {
            const bool on_curve = std::abs(glm::length(s.a) - 1) < 1e-5 && std::abs(glm::length(s.b) - 1) < 1e-5;
            for (const double t : {0.1, 0.5, 0.8}) {
                const auto partner =
                    mesh.borders.seam_partner(s.half_edge, glm::mix(glm::dvec3(s.a), glm::dvec3(s.b), t));
                if (!on_curve) {
                    ASSERT_FALSE(partner.has_value()) << "far from the other patch";
                    continue;
                }
                ASSERT_TRUE(partner.has_value()) << inner_steps << ' ' << outer_steps;
                const bool own_inner = mesh.polygon_of(s.half_edge / 3) < static_cast<std::uint32_t>(inner_steps);
                const bool partner_inner = mesh.polygon_of(*partner / 3) < static_cast<std::uint32_t>(inner_steps);
                ASSERT_NE(own_inner, partner_inner) << "a seam joins the two patches";
            }
            seams += on_curve;
        }
        // Equal tessellations are welded along the curve: nothing is left of the seam.
        EXPECT_EQ(seams, inner_steps == outer_steps ? 0 : inner_steps + outer_steps);
        EXPECT_EQ(count_edges(mesh).seam, static_cast<std::uint64_t>(seams));
    }
}

TEST(SeamPartner, SlitsWiderThanATwentiethOfTheEdgeAreNoSeams) {
    for (const double slit : {0.049, 0.051, 0.5}) {
        const PolygonSoup soup = soup_of({{0, 0, 0},
                                          {1, 0, 0},
                                          {1, -1, 0},
                                          {0, -1, 0},
                                          {0, slit, 0},
                                          {1, slit, 0},
                                          {1, 1 + slit, 0},
                                          {0, 1 + slit, 0}},
                                         {{0, 1, 2, 3}, {4, 5, 6, 7}});
        EXPECT_EQ(count_edges(build_meshes(soup, {}).at(0)).seam, slit < 0.05 ? 2u : 0u) << slit;
    }
}

TEST(SeamPartner, EdgesAtAnAngleAreNoSeams) {
    // Two squares that meet at a point of their edges, under various angles.
    for (const double degrees : {0.0, 20.0, 30.0, 90.0, 150.0, 165.0}) {
        const double a = degrees * std::numbers::pi / 180;
        const glm::dvec3 along(std::cos(a), std::sin(a), 0), up(0, 0, 1);
        const PolygonSoup soup =
            soup_of({{-1, 0, 0}, {1, 0, 0}, {1, 0, -1}, {-1, 0, -1}, -along, along, along + up, -along + up},
                    {{0, 1, 2, 3}, {4, 5, 6, 7}});
        const bool nearly_parallel = std::abs(std::cos(a)) > 0.9;
        EXPECT_EQ(count_edges(build_meshes(soup, {}).at(0)).seam, nearly_parallel && degrees > 0 ? 2u : 0u) << degrees;
    }
}

TEST(SeamPartner, APolygonIsNoSeamOfItself) {
    // A sliver whose long sides are nearer than a twentieth of their length.
    EXPECT_EQ(
        count_edges(build_meshes(soup_of({{0, 0, 0}, {1, 0, 0}, {1, 0.01, 0}, {0, 0.01, 0}}, {{0, 1, 2, 3}}), {}).at(0))
            .seam,
        0u);
}

}  // namespace
}  // namespace burin::border_index_test
