// The curvature of meshes is that of the surfaces that they stand for.

#include "lines/mesh_curvature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "mesh/build_meshes.h"
#include "mesh/shapes.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

constexpr double kPi = std::numbers::pi;
const double kCosCrease = std::cos(40 * kPi / 180);

Mesh mesh_of(PolygonSoup soup) { return build_meshes(std::move(soup), {}).at(0); }

/// Calls visit(triangle, place, weights) for each corner of each triangle.
template <typename Visit>
void each_corner(const Mesh& mesh, const Visit& visit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            std::array<double, 3> weights{};
            weights[k] = 1;
            visit(t, mesh.position(mesh.triangles[t][k]), weights);
        }
    }
}

/// The curvature of a surface along a way, seen from the side of `outwards`.
double along(const MeshCurvature& curvature, std::uint32_t triangle, const std::array<double, 3>& weights,
             const glm::dvec3& outwards, const glm::dvec3& way, const glm::dmat3& from_view = glm::dmat3(1.0)) {
    return radial_curvature(curvature, triangle, weights, from_view, outwards, glm::normalize(outwards + 3.0 * way));
}

/// make_torus(), with each quadrilateral cut into triangles in one way.
PolygonSoup triangle_torus(double radius, double tube, std::uint32_t segments, std::uint32_t tube_segments) {
    PolygonSoup soup;
    soup.object_names = {"torus"};
    soup.materials.resize(1);
    for (std::uint32_t i = 0; i < segments; ++i) {
        for (std::uint32_t j = 0; j < tube_segments; ++j) {
            const double u = 2 * kPi * i / segments, v = 2 * kPi * j / tube_segments, r = radius + tube * std::cos(v);
            soup.positions.emplace_back(r * std::cos(u), tube * std::sin(v), r * std::sin(u));
            const std::uint32_t next_i = (i + 1) % segments, next_j = (j + 1) % tube_segments, n = tube_segments;
            soup.add_polygon(std::array{i * n + j, next_i * n + j, next_i * n + next_j});
            soup.add_polygon(std::array{i * n + j, next_i * n + next_j, i * n + next_j});
        }
    }
    return soup;
}

TEST(MeshCurvature, OfATorusIsThatOfItsTubeWithinThreeInAThousand) {
    constexpr double kRadius = 1, kTube = 0.4;
    for (const bool is_cut : {true, false}) {
        const Mesh mesh = mesh_of(is_cut ? triangle_torus(kRadius, kTube, 64, 32) : make_torus(kRadius, kTube, 64, 32));
        const MeshCurvature curvature = make_curvature(mesh, kCosCrease, 1);
        double worst = 0, worst_around = 0;
        each_corner(mesh, [&](std::uint32_t t, glm::dvec3 p, const std::array<double, 3>& weights) {
            const glm::dvec3 out = glm::normalize(glm::dvec3(p.x, 0, p.z)), normal = (p - kRadius * out) / kTube;
            const glm::dvec3 around(-out.z, 0, out.x), tube = glm::cross(normal, around);
            worst = std::max(worst, std::abs(along(curvature, t, weights, normal, tube) * kTube - 1));
            const double across = glm::dot(normal, out) / (kRadius + kTube * glm::dot(normal, out));
            worst_around = std::max(worst_around, std::abs(along(curvature, t, weights, normal, around) - across));
            EXPECT_NEAR(along(curvature, t, weights, -normal, tube) * kTube, -1, 0.01)
                << "from inside it bends towards the eye";
        });
        EXPECT_LT(worst, 0.003);
        EXPECT_LT(worst_around, 0.04);
    }
}

/// Diagonals of polygons say nothing of the surface: twice as many segments make a quarter of the error.
TEST(MeshCurvature, BecomesExactWithTheSquareOfTheSegments) {
    double errors[2];
    for (int fine = 0; fine < 2; ++fine) {
        const Mesh mesh = mesh_of(make_torus(1, 0.4, 64 << fine, 32 << fine));
        const MeshCurvature curvature = make_curvature(mesh, kCosCrease, 1);
        errors[fine] = 0;
        each_corner(mesh, [&](std::uint32_t t, glm::dvec3 p, const std::array<double, 3>& weights) {
            const glm::dvec3 out = glm::normalize(glm::dvec3(p.x, 0, p.z)), normal = (p - out) / 0.4;
            const double expected = glm::dot(normal, out) / (1 + 0.4 * glm::dot(normal, out));
            const double found = along(curvature, t, weights, normal, {-out.z, 0, out.x});
            errors[fine] = std::max(errors[fine], std::abs(found - expected));
        });
    }
    EXPECT_LT(errors[1], 0.3 * errors[0]);
}

TEST(MeshCurvature, OfABallIsTheSameInAllDirections) {
    const Mesh mesh = mesh_of(make_sphere(2, 64, 32));
    const MeshCurvature curvature = make_curvature(mesh, kCosCrease, 1);
    Random random(1);
    each_corner(mesh, [&](std::uint32_t t, glm::dvec3 p, const std::array<double, 3>& weights) {
        const glm::dvec3 normal = p / 2.0, way = glm::normalize(glm::cross(normal, random.direction()));
        EXPECT_NEAR(along(curvature, t, weights, normal, way), 0.5, 2e-4) << p.x << ' ' << p.y << ' ' << p.z;
    });
}

/// An ellipsoid is a ball that is scaled: as a mesh, or by its object's matrix, which may turn and mirror it, too.
TEST(MeshCurvature, OfAnEllipsoidIsThatOfItsEquation) {
    const glm::dvec3 size(1, 2, 0.7);
    PolygonSoup soup = make_sphere(1, 96, 48);
    const Mesh ball = mesh_of(soup);
    for (glm::dvec3& p : soup.positions) p *= size;
    const Mesh scaled = mesh_of(soup);
    const MeshCurvature of_ball = make_curvature(ball, kCosCrease, 1),
                        of_scaled = make_curvature(scaled, kCosCrease, 1);
    const glm::dmat3 turn(glm::dvec3(0, 0, 1), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0));  // mirrors
    const glm::dmat3 scale(glm::dvec3(size.x, 0, 0), glm::dvec3(0, size.y, 0), glm::dvec3(0, 0, size.z));
    const glm::dmat3 from_view = glm::inverse(turn * scale);
    Random random(2);
    // The largest error away from the poles, where polygons are needles; `unscaled` gives places on the ball.
    const auto worst = [&](const Mesh& mesh, const MeshCurvature& curvature, const glm::dvec3& unscaled,
                           const glm::dmat3& to_view, const glm::dmat3& back) {
        double most = 0;
        each_corner(mesh, [&](std::uint32_t t, glm::dvec3 p, const std::array<double, 3>& weights) {
            const glm::dvec3 on_ball = p / unscaled, gradient = on_ball / size, normal = glm::normalize(gradient);
            if (std::abs(on_ball.y) > 0.95) return;
            const glm::dvec3 way = glm::normalize(glm::cross(normal, random.direction()));
            const double expected = glm::dot(way, way / (size * size)) / glm::length(gradient);
            const double found = along(curvature, t, weights, to_view * normal, to_view * way, back);
            most = std::max(most, std::abs(found / expected - 1));
        });
        return most;
    };
    EXPECT_LT(worst(ball, of_ball, glm::dvec3(1.0), turn, from_view), 0.001);
    EXPECT_LT(worst(scaled, of_scaled, size, glm::dmat3(1.0), glm::dmat3(1.0)), 0.03);
}

/// The wall ends at the caps: their flat polygons say nothing of it.
TEST(MeshCurvature, OfACylinderIsAroundItAlone) {
    const Mesh mesh = mesh_of(make_cylinder(0.5, 0.5, 3, 64));
    const MeshCurvature curvature = make_curvature(mesh, kCosCrease, 1);
    std::size_t on_wall = 0;
    each_corner(mesh, [&](std::uint32_t t, glm::dvec3 p, const std::array<double, 3>& weights) {
        const glm::dvec3 area = mesh.polygon_area_vector(t);
        if (std::abs(area.y) > 0.5 * glm::length(area)) {
            EXPECT_NEAR(along(curvature, t, weights, {0, 1, 0}, {1, 0, 0}), 0, 1e-6);
            return;
        }
        ++on_wall;
        const glm::dvec3 normal = glm::normalize(glm::dvec3(p.x, 0, p.z)), around(-normal.z, 0, normal.x);
        EXPECT_NEAR(along(curvature, t, weights, normal, around), 2, 0.01);
        EXPECT_NEAR(along(curvature, t, weights, normal, {0, 1, 0}), 0, 1e-5);
        EXPECT_NEAR(along(curvature, t, weights, normal, glm::normalize(around + glm::dvec3(0, 1, 0))), 1, 0.01);
    });
    EXPECT_EQ(on_wall, 64u * 6);
}

/// Its tip has no normal, and the rest is as round as its place says.
TEST(MeshCurvature, OfAConeIsKnownAroundItsTip) {
    const Mesh mesh = mesh_of(make_cylinder(1, 0, 1, 64));
    const MeshCurvature curvature = make_curvature(mesh, kCosCrease, 1);
    each_corner(mesh, [&](std::uint32_t t, glm::dvec3 p, const std::array<double, 3>& weights) {
        const glm::dvec3 area = mesh.polygon_area_vector(t);
        if (area.y < 0) return;
        const glm::dvec3 out(p.x, 0, p.z);
        if (glm::length(out) < 0.5) return;
        const glm::dvec3 normal = glm::normalize(out + glm::dvec3(0, 1, 0)), around(-out.z, 0, out.x);
        EXPECT_NEAR(along(curvature, t, weights, normal, around), std::sqrt(0.5), 0.01);
    });
}

TEST(MeshCurvature, DependsOnNeitherThreadsNorTheOrderOfTriangles) {
    PolygonSoup soup = make_torus(1, 0.3, 100, 60);
    const Mesh mesh = mesh_of(soup);
    const MeshCurvature one = make_curvature(mesh, kCosCrease, 1), four = make_curvature(mesh, kCosCrease, 4);
    ASSERT_EQ(one.vertices.size(), four.vertices.size());
    for (std::size_t i = 0; i < one.vertices.size(); ++i) {
        EXPECT_EQ(one.vertices[i].normal, four.vertices[i].normal);
        EXPECT_EQ(one.vertices[i].turn, four.vertices[i].turn);
    }
}

/// Whatever the polygons are, there is a number.
TEST(MeshCurvature, IsFiniteForAnyMesh) {
    for (std::uint64_t trial = 0; trial < 60; ++trial) {
        Random random(trial);
        PolygonSoup soup;
        soup.object_names = {"noise"};
        soup.materials.resize(1);
        const double scale = std::pow(10.0, random.integer(-30, 25)), flat = random.integer(0, 2) * 1e-9;
        for (int i = 0; i < 40; ++i) {
            glm::dvec3 p = random.in_box(1);
            if (trial % 3 == 0) p.z *= flat;
            if (trial % 4 == 1) p = glm::round(2.0 * p);
            soup.positions.push_back(scale * p);
        }
        for (int i = 0; i < 120; ++i) {
            std::vector<std::uint32_t> polygon;
            for (int k = random.integer(3, 5); k > 0; --k)
                polygon.push_back(static_cast<std::uint32_t>(random.integer(0, 39)));
            soup.add_polygon(polygon);
        }
        const std::vector<Mesh> meshes = build_meshes(soup, {});
        if (meshes.empty()) continue;
        const Mesh& mesh = meshes[0];
        const MeshCurvature curvature = make_curvature(mesh, trial % 2 == 0 ? -1 : kCosCrease, 1);
        for (const VertexCurvature& v : curvature.vertices) {
            for (const float number : v.turn) ASSERT_TRUE(std::isfinite(number)) << trial;
        }
        each_corner(mesh, [&](std::uint32_t t, glm::dvec3, const std::array<double, 3>& weights) {
            for (const double thin : {1.0, 0.0, 1e-200}) {
                const glm::dmat3 from_view =
                    glm::inverse(glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, thin, 0), glm::dvec3(0, 0, 1)));
                const double kr =
                    radial_curvature(curvature, t, weights, from_view, random.direction(), random.direction());
                ASSERT_TRUE(std::isfinite(static_cast<float>(kr))) << trial << ' ' << thin;
            }
        });
    }
}

}  // namespace
}  // namespace burin
