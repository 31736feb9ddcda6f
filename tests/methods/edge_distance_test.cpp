// Distances to edges: all ways of finding them agree, and what goes wrong without their tricks.

#include "methods/wire/edge_distance.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace burin::edge_distance_test {
namespace {

/// A triangle as a camera sees it: pixels in a picture of 640 x 480, and w.
struct View {
    glm::dvec2 p[3];
    glm::dvec3 w{1.0};
    glm::dvec3 homogeneous[3];
    bool behind[3] = {};
};

/// Corners in space, the camera at the origin looking along -z.
View view_of(const glm::dvec3 (&corners)[3]) {
    View v;
    for (int k = 0; k < 3; ++k) {
        v.w[k] = -corners[k].z;
        v.homogeneous[k] = {320 * v.w[k] + 400 * corners[k].x, 240 * v.w[k] - 400 * corners[k].y, v.w[k]};
        v.p[k] = glm::dvec2(v.homogeneous[k]) / v.w[k];
        v.behind[k] = v.w[k] < 0;
    }
    return v;
}

double area(const glm::dvec2 (&p)[3]) { return std::abs(cross(p[1] - p[0], p[2] - p[0])); }

double line_distance(glm::dvec2 a, glm::dvec2 b, glm::dvec2 at) {
    return std::abs(cross(b - a, at - a)) / glm::distance(a, b);
}

View random_view(test::Random& random) {
    for (;;) {
        glm::dvec3 corners[3];
        for (glm::dvec3& c : corners) c = {random.real(-2, 2), random.real(-1.5, 1.5), -random.real(2, 12)};
        const View v = view_of(corners);
        if (area(v.p) > 2000) return v;
    }
}

/// Neither of the tricks: an interpolator that is correct in perspective, as texture coordinates
/// have.
double perspective_distance(const EdgeChannel& channel, const glm::dvec3& w, const glm::dvec3& lambda) {
    const glm::dvec3 weight = lambda / w;
    return glm::dot(weight, channel) / (weight.x + weight.y + weight.z);
}

TEST(EdgeDistance, LinearAndPremultipliedPathsAgree) {
    double worst_without = 0;
    for (std::uint64_t trial = 0; trial < 300; ++trial) {
        test::Random random(trial);
        const View v = random_view(random);
        const glm::dvec3 height = altitudes(v.p);
        for (int i = 0; i < 20; ++i) {
            double a = random.real(0, 1), b = random.real(0, 1);
            if (a + b > 1) a = 1 - a, b = 1 - b;
            const glm::dvec2 at = v.p[0] + a * (v.p[1] - v.p[0]) + b * (v.p[2] - v.p[0]);
            const glm::dvec3 lambda = barycentric(v.p, at);
            for (int k = 0; k < 3; ++k) {
                EdgeChannel channel(0.0);
                channel[k] = height[k];
                const double truth = line_distance(v.p[(k + 1) % 3], v.p[(k + 2) % 3], at);
                EXPECT_NEAR(linear_distance(channel, lambda), truth, 1e-4) << trial;
                EXPECT_NEAR(premultiplied_distance(channel, v.w, lambda), truth, 1e-4) << trial;
                worst_without = std::max(worst_without, std::abs(perspective_distance(channel, v.w, lambda) - truth));
            }
        }
    }
    EXPECT_GT(worst_without, 20);
}

TEST(EdgeDistance, WithoutATrickLinesBendTowardsTheNearCorner) {
    // A long triangle into the distance: halfway along on the screen, the edge at the far end seems
    // much nearer than it is.
    const View v = view_of({{-1, -1, -2}, {1, -1, -2}, {0, -1, -40}});
    EdgeChannel to_near_edge(0.0);
    to_near_edge[2] = altitudes(v.p)[2];
    const glm::dvec2 at = 0.5 * v.p[2] + 0.25 * (v.p[0] + v.p[1]);
    const glm::dvec3 lambda = barycentric(v.p, at);
    EXPECT_NEAR(linear_distance(to_near_edge, lambda), 0.5 * altitudes(v.p)[2], 1e-9);
    EXPECT_LT(perspective_distance(to_near_edge, v.w, lambda), 0.1 * linear_distance(to_near_edge, lambda));
}

TEST(EdgeDistance, ScalingByTheWholeViewportDoublesDistances) {
    // Normalized coordinates run over two units: half the viewport is the scale, not all of it.
    const glm::dvec2 ndc[3] = {{-0.5, -0.4}, {0.6, -0.3}, {0.1, 0.7}};
    glm::dvec2 half[3], whole[3];
    for (int k = 0; k < 3; ++k) {
        half[k] = ndc[k] * glm::dvec2(320, 240);
        whole[k] = ndc[k] * glm::dvec2(640, 480);
    }
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(altitudes(whole)[k], 2 * altitudes(half)[k], 1e-9);
}

TEST(EdgeDistance, PolygonsOfAnySizeAreExact) {
    for (std::uint64_t trial = 0; trial < 30; ++trial) {
        test::Random random(trial);
        const int count = 4 + static_cast<int>(trial % 6);
        std::vector<glm::dvec2> polygon;
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * 3.14159265358979 * (i + random.real(0, 0.6)) / count;
            polygon.push_back(glm::dvec2(300, 200) + glm::dvec2(180 * std::cos(angle), 120 * std::sin(angle)));
        }
        const auto corner = [&](int i) { return polygon[static_cast<std::size_t>(i % count)]; };
        // A fan of triangles, each with a signed distance per edge of the polygon at its corners.
        for (int t = 1; t + 1 < count; ++t) {
            const glm::dvec2 p[3] = {corner(0), corner(t), corner(t + 1)};
            const glm::dvec2 at = 0.2 * p[0] + 0.5 * p[1] + 0.3 * p[2];
            double least = kNoEdge, truth = kNoEdge;
            for (int e = 0; e < count; ++e) {
                const glm::dvec3 line = line_through({corner(e), 1.0}, {corner(e + 1), 1.0});
                const EdgeChannel channel(signed_distance(line, p[0]), signed_distance(line, p[1]),
                                          signed_distance(line, p[2]));
                least = std::min(least, std::abs(linear_distance(channel, barycentric(p, at))));
                truth = std::min(truth, segment_distance(corner(e), corner(e + 1), at).distance);
            }
            EXPECT_NEAR(least, truth, 1e-9) << trial;
        }
    }
}

TEST(EdgeDistance, ConcavePolygonsHaveFalseLines) {
    // The L of scene S-CONCAVE: the edge at x = 120 runs on into the lower part.
    const glm::dvec3 line = line_through({120, 40, 1}, {120, 130, 1});
    const glm::dvec2 at(120.5, 180);
    EXPECT_NEAR(std::abs(signed_distance(line, at)), 0.5, 1e-12);
    EXPECT_GT(segment_distance({120, 40}, {120, 130}, at).distance, 49);
}

TEST(EdgeDistance, CasesLinesAndHeightsAgree) {
    int seen[8] = {};
    for (std::uint64_t trial = 0; trial < 600; ++trial) {
        test::Random random(trial);
        glm::dvec3 corners[3];
        int number = 0;
        for (int k = 0; k < 3; ++k) {
            corners[k] = {random.real(-2, 2), random.real(-1.5, 1.5),
                          random.real(0.2, 5) * (random.integer(0, 1) ? 1 : -1)};
            number = 2 * number + (corners[k].z > 0);
        }
        const View v = view_of(corners);
        for (int i = 0; i < 4; ++i) {
            const glm::dvec2 at(random.real(0, 640), random.real(0, 480));
            const glm::dvec3 d = solid_wireframe_distances(v.p, v.behind, at);
            for (int k = 0; k < 3; ++k) {
                const int a = (k + 1) % 3, b = (k + 2) % 3;
                if (v.behind[a] && v.behind[b]) {
                    EXPECT_EQ(d[k], kNoEdge) << "an edge behind the eye";
                    continue;
                }
                const double truth = std::abs(signed_distance(line_through(v.homogeneous[a], v.homogeneous[b]), at));
                EXPECT_NEAR(std::abs(d[k]), truth, 1e-6 * (1 + glm::length(v.p[a]) + glm::length(v.p[b])))
                    << trial << " case " << number;
                ++seen[number];
            }
        }
    }
    for (int n = 0; n < 7; ++n) EXPECT_GT(seen[n], 0) << "case " << n;
    EXPECT_EQ(seen[7], 0);
}

TEST(EdgeDistance, NearClippingAgreesWithLines) {
    for (std::uint64_t trial = 0; trial < 200; ++trial) {
        test::Random random(trial);
        const glm::dvec3 front(random.real(-2, 2), random.real(-1.5, 1.5), -random.real(1, 6));
        const glm::dvec3 back(random.real(-2, 2), random.real(-1.5, 1.5), random.real(0.2, 6));
        const double part = (-0.1 - front.z) / (back.z - front.z);
        const View whole = view_of({front, back, front}), cut = view_of({front, front + part * (back - front), front});
        const glm::dvec2 at(random.real(0, 640), random.real(0, 480));
        const double by_line = std::abs(signed_distance(line_through(whole.homogeneous[0], whole.homogeneous[1]), at));
        EXPECT_NEAR(line_distance(cut.p[0], cut.p[1], at), by_line, 1e-6) << trial;
    }
}

TEST(EdgeDistance, ACornerInTheEyesPlaneNeedsLines) {
    const View v = view_of({{-0.5, 0.2, -3}, {0.7, 0.9, 0}, {0.3, -0.6, -4}});
    EXPECT_FALSE(std::isfinite(v.p[1].x));
    // The line towards a point at infinity: from the corner in its direction.
    const glm::dvec3 line = line_through(v.homogeneous[0], v.homogeneous[1]);
    const glm::dvec2 at =
        v.p[0] + 50.0 * glm::normalize(glm::dvec2(0.7, -0.9)) + 7.0 * glm::normalize(glm::dvec2(0.9, 0.7));
    EXPECT_NEAR(std::abs(signed_distance(line, at)), 7, 1e-9);
    const glm::dvec3 by_cases = solid_wireframe_distances(v.p, {false, true, false}, at);
    EXPECT_FALSE(by_cases[2] < 1e9) << "the table of cases has no answer";
}

TEST(EdgeDistance, PointsThatCoincideAreNoLine) {
    EXPECT_FALSE(is_line(line_through({1, 2, 1}, {2, 4, 2})));
    EXPECT_TRUE(is_line(line_through({1, 2, 1}, {2, 4, 1})));
}

TEST(EdgeDistance, SegmentsHaveRoundEnds) {
    const auto beyond = segment_distance({10, 10}, {20, 10}, {23, 14});
    EXPECT_DOUBLE_EQ(beyond.distance, 5);
    EXPECT_DOUBLE_EQ(beyond.along, 10);
    const auto before = segment_distance({10, 10}, {20, 10}, {7, 6});
    EXPECT_DOUBLE_EQ(before.distance, 5);
    EXPECT_DOUBLE_EQ(before.along, 0);
    const auto beside = segment_distance({10, 10}, {20, 10}, {13, 8});
    EXPECT_DOUBLE_EQ(beside.distance, 2);
    EXPECT_DOUBLE_EQ(beside.along, 3);
    EXPECT_DOUBLE_EQ(segment_distance({1, 1}, {1, 1}, {4, 5}).distance, 5);
}

TEST(EdgeDistance, BarycentricThresholdsGiveWidthsInProportionToSize) {
    // The flaw that heights in pixels mend: the distance at which a coordinate reaches .05.
    const glm::dvec2 small[3] = {{0, 0}, {40, 0}, {10, 30}};
    glm::dvec2 large[3];
    for (int k = 0; k < 3; ++k) large[k] = 4.0 * small[k];
    const auto width_by_threshold = [](const glm::dvec2(&p)[3]) { return 0.05 * altitudes(p)[2]; };
    EXPECT_NEAR(width_by_threshold(large) / width_by_threshold(small), 4, 1e-12);
    const auto distance_above_edge = [](const glm::dvec2(&p)[3]) {
        EdgeChannel channel(0.0);
        channel[2] = altitudes(p)[2];
        return linear_distance(channel, barycentric(p, 0.6 * p[0] + 0.4 * p[1] + glm::dvec2(0, 1.5)));
    };
    EXPECT_NEAR(distance_above_edge(small), 1.5, 1e-12);
    EXPECT_NEAR(distance_above_edge(large), 1.5, 1e-12);
}

TEST(EdgeDistance, AnEdgeMovedAwayIsQOnItselfAndItsHeightAtTheOppositeCorner) {
    const glm::dvec2 p[3] = {{0, 0}, {40, 0}, {10, 30}};
    const EdgeChannel channel = channel_moved_away(2, altitudes(p)[2], 100);
    EXPECT_NEAR(linear_distance(channel, barycentric(p, {17, 0})), 100, 1e-9);
    EXPECT_NEAR(linear_distance(channel, barycentric(p, p[2])), 30, 1e-9);
}

}  // namespace
}  // namespace burin::edge_distance_test
