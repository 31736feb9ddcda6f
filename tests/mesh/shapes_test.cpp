#include "mesh/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "mesh/build_meshes.h"
#include "tests/mesh/mesh_checks.h"

namespace burin {
namespace {

constexpr double kPi = std::numbers::pi;

Mesh build(const PolygonSoup& soup) { return build_meshes(soup, {}).at(0); }

/// Closed, two-manifold, wound to be seen from outside, without a repair, and of this many polygons.
void expect_closed(const PolygonSoup& soup, std::size_t polygons, double volume, const std::string& what) {
    const Mesh mesh = build(soup);
    test::expect_consistent(mesh, what);
    const test::Winding winding = test::winding_of(mesh);
    EXPECT_EQ(winding.border, 0) << what;
    EXPECT_EQ(winding.non_manifold, 0) << what;
    EXPECT_EQ(winding.equal, 0) << what;
    EXPECT_GT(winding.opposite, 0) << what;
    EXPECT_EQ(mesh.polygon_count, polygons) << what;
    EXPECT_EQ(soup.polygon_count(), polygons) << what;
    EXPECT_EQ(mesh.repairs.welded_vertices, 0u) << what;
    EXPECT_EQ(soup.positions.size(), mesh.positions.size()) << what << ": vertices that nothing uses";
    EXPECT_EQ(mesh.repairs.degenerate_polygons + mesh.repairs.duplicate_polygons, 0u) << what;
    EXPECT_NEAR(test::volume_of(mesh), volume, 1e-5 * volume) << what;
    EXPECT_EQ(soup.object_names.size(), 1u) << what;
    EXPECT_EQ(soup.materials.size(), 1u) << what;
}

/// Area of the regular polygon that `segments` corners on a circle make.
double polygon_area(double radius, int segments) {
    return 0.5 * segments * radius * radius * std::sin(2 * kPi / segments);
}

TEST(Shapes, ABoxIsClosed) {
    for (const glm::dvec3 size : {glm::dvec3(1, 1, 1), glm::dvec3(0.01, 3, 200)}) {
        const PolygonSoup box = make_box(size);
        expect_closed(box, 6, size.x * size.y * size.z, "box");
        for (const glm::dvec3& p : box.positions) EXPECT_EQ(glm::abs(p), 0.5 * size);
    }
    EXPECT_EQ(count_edges(build(make_box({1, 1, 1}))).edges, 12u);
}

TEST(Shapes, ASphereIsClosed) {
    for (const auto& [segments, rings] : {std::pair{3, 2}, {4, 3}, {7, 5}, {32, 16}, {64, 2}}) {
        const PolygonSoup sphere = make_sphere(2.5, segments, rings);
        // Frusta between the rings: the volume of stacked layers of a prismatoid.
        double volume = 0;
        for (int r = 0; r < rings; ++r) {
            const double top = kPi * r / rings, bottom = kPi * (r + 1) / rings;
            const double a = polygon_area(2.5 * std::sin(top), segments),
                         b = polygon_area(2.5 * std::sin(bottom), segments);
            volume += 2.5 * (std::cos(top) - std::cos(bottom)) / 3 * (a + b + std::sqrt(a * b));
        }
        expect_closed(sphere, static_cast<std::size_t>(segments * rings), volume, "sphere " + std::to_string(segments));
        for (const glm::dvec3& p : sphere.positions) EXPECT_NEAR(glm::length(p), 2.5, 1e-14);
    }
}

TEST(Shapes, ACylinderIsClosed) {
    for (const int segments : {3, 4, 5, 32, 1000}) {
        for (const auto& [bottom, top] : {std::pair{1.0, 1.0}, {2.0, 0.5}, {0.5, 2.0}}) {
            const double a = polygon_area(bottom, segments), b = polygon_area(top, segments);
            expect_closed(make_cylinder(bottom, top, 3, segments), static_cast<std::size_t>(segments) + 2,
                          (a + b + std::sqrt(a * b)), "cylinder");
        }
    }
    const Mesh mesh = build(make_cylinder(1, 1, 2, 16));
    EXPECT_EQ(count_edges(mesh).edges, 48u) << "flat caps are one polygon each";
    EXPECT_EQ(mesh.name, "cylinder");
}

TEST(Shapes, AConeIsClosed) {
    for (const int segments : {3, 4, 5, 32, 1000}) {
        expect_closed(make_cylinder(1.5, 0, 2, segments), static_cast<std::size_t>(segments) + 1,
                      polygon_area(1.5, segments) * 2 / 3, "cone");
    }
    EXPECT_EQ(build(make_cylinder(1, 0, 2, 16)).name, "cone");
}

TEST(Shapes, ATorusIsClosed) {
    for (const auto& [segments, tube_segments] : {std::pair{3, 3}, {4, 8}, {5, 3}, {48, 24}}) {
        // Between two sections, a point at radius r goes 2 r sin(pi/n), over a section that is
        // foreshortened by cos(pi/n).
        const double volume =
            polygon_area(0.5, tube_segments) * 2 * segments * std::sin(kPi / segments) * 2 * std::cos(kPi / segments);
        expect_closed(make_torus(2, 0.5, segments, tube_segments), static_cast<std::size_t>(segments * tube_segments),
                      volume, "torus");
    }
}

TEST(Shapes, APlaneIsARectangleOfQuadrilaterals) {
    const PolygonSoup plane = make_plane(4, 6, 3, 5);
    const Mesh mesh = build(plane);
    test::expect_consistent(mesh, "plane");
    EXPECT_EQ(mesh.polygon_count, 15u);
    EXPECT_EQ(count_edges(mesh).border, 16u);
    EXPECT_EQ(test::winding_of(mesh).equal, 0);
    double area = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const glm::dvec3 twice = glm::cross(mesh.position(b) - mesh.position(a), mesh.position(c) - mesh.position(a));
        EXPECT_GT(twice.y, 0) << "seen from above";
        area += glm::length(twice) / 2;
    }
    EXPECT_NEAR(area, 24, 1e-6);
    for (const glm::dvec3& p : plane.positions) {
        EXPECT_EQ(p.y, 0);
        EXPECT_LE(std::abs(p.x), 2);
        EXPECT_LE(std::abs(p.z), 3);
    }
    EXPECT_EQ(build(make_plane(1, 1, 1, 1)).polygon_count, 1u);
}

TEST(Teapot, Has32Patches) {
    for (const std::size_t n : {1u, 2u, 5u, 8u}) {
        const PolygonSoup soup = make_teapot(static_cast<int>(n));
        EXPECT_EQ(soup.polygon_count(), 32 * n * n);
        EXPECT_EQ(soup.positions.size(), 32 * (n + 1) * (n + 1));
    }
}

TEST(Teapot, StandsOnTheGroundWithItsSpoutTowardsX) {
    glm::dvec3 low(1e9), high(-1e9);
    for (const glm::dvec3& p : make_teapot(10).positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    EXPECT_NEAR(low.y, 0, 1e-12);
    EXPECT_NEAR(high.y, 3.15, 1e-12);
    EXPECT_GT(high.x, 3.4);
    EXPECT_NEAR(low.x, -3, 0.01) << "the handle";
    EXPECT_NEAR(low.z, -2, 1e-12);
    EXPECT_NEAR(high.z, 2, 1e-12);
}

TEST(Teapot, PatchesAreStitchedExceptWhereNewellLeftThemOpen) {
    for (const int n : {2, 3, 7, 16}) {
        const Mesh mesh = build(make_teapot(n));
        test::expect_consistent(mesh, "teapot");
        const test::Winding winding = test::winding_of(mesh);
        EXPECT_EQ(winding.non_manifold, 0) << n;
        EXPECT_EQ(winding.equal, 0) << n << ": all patches are wound alike";
        int rim = 0, lid = 0, handle_top = 0, handle_bottom = 0, spout_base = 0, spout_tip = 0;
        for (const BorderIndex::Segment& s : mesh.borders.segments()) {
            const glm::dvec3 m = 0.5 * (glm::dvec3(s.a) + glm::dvec3(s.b));
            const double radius = std::hypot(m.x, m.z);
            // The mouth of the body and the edge of the lid lie at one height, at radii 1.4 and 1.3.
            if (std::abs(s.a.y - 2.4) < 1e-5 && std::abs(s.b.y - 2.4) < 1e-5 && radius < 1.41) {
                ++(std::hypot(s.a.x, s.a.z) > 1.35 ? rim : lid);
            } else if (m.x < 0) {
                ++(m.y > 1.5 ? handle_top : handle_bottom);
            } else {
                ++(m.y < 2 ? spout_base : spout_tip);
            }
        }
        EXPECT_EQ(rim, 4 * n);
        EXPECT_EQ(lid, 4 * n);
        EXPECT_EQ(handle_top, 2 * n) << "both ends of the handle are stuck into the body";
        EXPECT_EQ(handle_bottom, 2 * n);
        EXPECT_EQ(spout_base, 2 * n) << "so is the spout";
        EXPECT_EQ(spout_tip, 2 * n) << "and open at its tip";
        EXPECT_EQ(winding.border, 16 * n);
    }
}

TEST(Teapot, IsWoundToBeSeenFromOutside) {
    const Mesh mesh = build(make_teapot(8));
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::dvec3 p = mesh.position(a), q = mesh.position(b), r = mesh.position(c);
        const glm::dvec3 middle = (p + q + r) / 3.0, normal = glm::cross(q - p, r - p);
        // On the round belly, outwards is away from the axis; on the bottom, down.
        const double radius = std::hypot(middle.x, middle.z);
        const bool belly =
            middle.y > 0.3 && middle.y < 2.2 && radius > 1.45 && radius < 2.01 && std::abs(middle.z) > 0.7;
        if (belly) {
            ASSERT_GT(normal.x * middle.x + normal.z * middle.z, 0);
        }
        if (middle.y < 0.07 && radius < 1.4) {
            ASSERT_LT(normal.y, 0);
        }
    }
}

}  // namespace
}  // namespace burin
