#include "view/projection.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"
#include "view/depth_plane.h"
#include "view/screen_polygon.h"

namespace burin {
namespace {

using test::Random;

Projection perspective() { return {false, 500, {320, 240}, 1e-4}; }
Projection orthographic() { return {true, 40, {320, 240}, 0}; }

TEST(Projection, DepthIsAffineOverAPlane) {
    for (const Projection& p : {perspective(), orthographic()}) {
        for (int trial = 0; trial < 2000; ++trial) {
            Random random(static_cast<std::uint64_t>(trial));
            glm::dvec3 corners[3];
            for (auto& c : corners) c = random.in_box(4) - glm::dvec3(0, 0, 6);
            const DepthPlane plane = exact_depth_plane(p, corners);
            const double u = random.real(0, 1), v = random.real(0, 1 - u);
            const glm::dvec3 inside = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
            const double expected = p.nearness(inside);
            const double scale = plane.highest - plane.lowest + std::abs(expected);
            ASSERT_NEAR(plane.nearness(p.to_pixel(inside)), expected, 1e-6 * scale) << trial;
            ASSERT_NEAR(p.distance(p.nearness(inside)), -inside.z, 1e-9 * -inside.z);
        }
    }
}

TEST(Projection, NearerIsLarger) {
    for (const Projection& p : {perspective(), orthographic()}) {
        EXPECT_GT(p.nearness({0, 0, -1}), p.nearness({0, 0, -2}));
        EXPECT_GT(p.nearness({0, 0, -2}), p.nearness({0, 0, -1000}));
    }
}

TEST(ProjectTriangle, NeighboursShareTheirSnappedEdgeWhereverItIsClipped) {
    for (const Projection& p : {perspective(), orthographic()}) {
        int clipped = 0;
        for (int trial = 0; trial < 3000; ++trial) {
            Random random(static_cast<std::uint64_t>(trial));
            const double size = trial % 3 == 0 ? 3 : (trial % 3 == 1 ? 400 : 1e5);
            const glm::dvec3 a = random.in_box(size), b = random.in_box(size);
            const glm::dvec3 c = random.in_box(size), d = random.in_box(size);
            const glm::dvec3 left[3] = {a, b, c}, right[3] = {b, a, d};
            const ScreenPolygon l = project_triangle(p, left), r = project_triangle(p, right);
            clipped += l.count > 3;
            // Each visible end of the common edge, or its cut, is a corner of both.
            const glm::dvec3 ends[2] = {a, b};
            for (const glm::dvec3& end : ends) {
                if (-end.z <= p.near_distance) continue;
                const glm::dvec2 pixel = p.to_pixel(end);
                if (glm::distance(pixel, p.center_px) > 1000) continue;
                const SubpixelPoint snapped{static_cast<int>(snap_to_subpixels(pixel.x)),
                                            static_cast<int>(snap_to_subpixels(pixel.y))};
                for (const ScreenPolygon& polygon : {l, r}) {
                    bool found = false;
                    for (int i = 0; i < polygon.count; ++i)
                        found = found || polygon.corners[static_cast<std::size_t>(i)] == snapped;
                    ASSERT_TRUE(found) << "trial " << trial;
                }
            }
        }
        EXPECT_GT(clipped, 100) << "the test must reach the clipper";
    }
}

TEST(ProjectTriangle, CornersStayWithinTheGuardBand) {
    for (int trial = 0; trial < 3000; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        glm::dvec3 corners[3];
        const double size = std::pow(10.0, random.real(-6, 20));
        for (auto& c : corners) c = random.in_box(size);
        const ScreenPolygon polygon = project_triangle(perspective(), corners);
        ASSERT_TRUE(polygon.count == 0 || polygon.count >= 3);
        ASSERT_LE(polygon.count, ScreenPolygon::kMaxCorners);
        for (int i = 0; i < polygon.count; ++i) {
            const SubpixelPoint c = polygon.corners[static_cast<std::size_t>(i)];
            ASSERT_LE(std::abs(c.x), 256 * (65536 + 321));
            ASSERT_LE(std::abs(c.y), 256 * (65536 + 241));
        }
    }
}

TEST(ProjectTriangle, WhatLiesBehindTheEyeIsGone) {
    const glm::dvec3 behind[3] = {{0, 0, 1}, {1, 0, 2}, {0, 1, 3}};
    EXPECT_EQ(project_triangle(perspective(), behind).count, 0);
    EXPECT_EQ(project_triangle(orthographic(), behind).count, 0);
    const glm::dvec3 through_the_eye_plane[3] = {{-1, 0, -5}, {1, 0, -5}, {0, -1, 5}};
    EXPECT_GE(project_triangle(perspective(), through_the_eye_plane).count, 3);
}

TEST(DepthPlane, SnappedPlanesOfNeighboursAgreeAlongTheirEdge) {
    for (const Projection& p : {perspective(), orthographic()}) {
        for (int trial = 0; trial < 1000; ++trial) {
            Random random(static_cast<std::uint64_t>(trial));
            glm::dvec3 v[4];
            for (auto& c : v) c = random.in_box(2) - glm::dvec3(0, 0, 6);
            const glm::dvec3 left[3] = {v[0], v[1], v[2]}, right[3] = {v[1], v[0], v[3]};
            const DepthPlane l = snapped_depth_plane(p, left), r = snapped_depth_plane(p, right);
            const auto snapped = [&](const glm::dvec3& c) {
                const glm::dvec2 pixel = p.to_pixel(c);
                return glm::dvec2(snap_to_subpixels(pixel.x), snap_to_subpixels(pixel.y)) / 256.0;
            };
            const glm::dvec2 on_edge = glm::mix(snapped(v[0]), snapped(v[1]), random.real(0, 1));
            ASSERT_NEAR(l.extended_to(on_edge), r.extended_to(on_edge), 1e-9 * std::abs(l.lowest)) << trial;
        }
    }
}

TEST(DepthPlane, EdgeOnTrianglesGiveFiniteDepths) {
    const glm::dvec3 edge_on[3] = {{0, 0, -1}, {0, 0, -2}, {0, 1, -2}};
    for (const Projection& p : {perspective(), orthographic()}) {
        const DepthPlane plane = exact_depth_plane(p, edge_on);
        for (const glm::dvec2 pixel : {glm::dvec2(320, 240), glm::dvec2(0, 0), glm::dvec2(321, 100)}) {
            EXPECT_TRUE(std::isfinite(plane.nearness(pixel)));
            EXPECT_GE(plane.nearness(pixel), plane.lowest);
            EXPECT_LE(plane.nearness(pixel), plane.highest);
        }
    }
}

}  // namespace
}  // namespace burin
