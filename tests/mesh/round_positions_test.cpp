// Models that are far larger than what they are made of: single precision alone would blur that.

#include "mesh/round_positions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/build_meshes.h"
#include "mesh/shapes.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

constexpr glm::dvec3 kFar(500000.12, 0.41, 4600000.07);

void add(PolygonSoup& soup, const PolygonSoup& other, const glm::dvec3& at) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const glm::dvec3& p : other.positions) soup.positions.push_back(p + at);
    for (std::size_t i = 0; i < other.polygon_count(); ++i) {
        std::vector<std::uint32_t> corners(other.polygon(i).begin(), other.polygon(i).end());
        for (std::uint32_t& v : corners) v += first;
        soup.add_polygon(corners);
    }
    soup.object_names = {"object"};
}

/// The largest distance of a place of the soup from the mesh's vertex that is nearest to it.
double largest_error(const PolygonSoup& soup, const Mesh& mesh) {
    double largest = 0;
    for (const glm::dvec3& p : soup.positions) {
        double least = 1e300;
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
            least = std::min(least, glm::distance(mesh.position(v), p));
        largest = std::max(largest, least);
    }
    return largest;
}

Mesh one_mesh(const PolygonSoup& soup) {
    std::vector<Mesh> meshes = build_meshes(soup, {});
    EXPECT_EQ(meshes.size(), 1u);
    test::expect_consistent(meshes.front(), "the mesh");
    return meshes.front();
}

TEST(RoundPositions, KeepPartsFarFromAMarker) {
    // Either of them may have most of the corners.
    for (const bool is_marker_fine : {false, true}) {
        PolygonSoup soup;
        add(soup, is_marker_fine ? make_sphere(0.5, 48, 24) : make_box({1, 1, 1}), glm::dvec3(0.0));
        add(soup, make_box({0.5, 0.4, 0.3}), kFar);
        add(soup, make_sphere(0.2, 12, 6), kFar + glm::dvec3(0.1, 0.9, 0.2));
        const Mesh mesh = one_mesh(soup);
        EXPECT_TRUE(mesh.has_residuals());
        EXPECT_LT(largest_error(soup, mesh), 2e-7);
        EXPECT_EQ(mesh.repairs.degenerate_polygons, 0u);
        EXPECT_EQ(count_edges(mesh).border, 0u);
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            EXPECT_GT(glm::length(mesh.polygon_area_vector(t)), 0);
    }
}

TEST(RoundPositions, KeepHalfHereAndHalfThere) {
    PolygonSoup soup;
    add(soup, make_sphere(0.5, 24, 12), kFar);
    add(soup, make_sphere(0.5, 24, 12), -kFar);
    const Mesh mesh = one_mesh(soup);
    EXPECT_LT(largest_error(soup, mesh), 3e-7);
    EXPECT_EQ(mesh.positions.size(), 2 * one_mesh(make_sphere(0.5, 24, 12)).positions.size());
}

TEST(RoundPositions, ATiltedGroundPassesUnderTheThingOnIt) {
    const glm::dvec3 u(0.6, 0.64, 0.48), v(-0.8, 0.48, 0.36);
    PolygonSoup soup;
    soup.object_names = {"object"};
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        soup.positions.push_back(1e7 * x * u + 1e7 * y * v);
    soup.add_polygon(std::vector<std::uint32_t>{0, 1, 2, 3});
    add(soup, make_box({0.7, 0.7, 0.7}), glm::dvec3(0.0));
    const Mesh mesh = one_mesh(soup);
    EXPECT_LT(largest_error(soup, mesh), 1e-6);
    const glm::dvec3 normal = glm::cross(u, v);
    double error = 0;
    for (std::uint32_t i = 0; i < 4; ++i) error = std::max(error, std::abs(glm::dot(mesh.position(i), normal)));
    EXPECT_LT(error, 1e-6);
}

TEST(RoundPositions, FlatStaysFlat) {
    PolygonSoup soup;
    soup.object_names = {"object"};
    for (const auto& [x, z] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        soup.positions.push_back({1234567.8 * x, 0.1, 1234567.8 * z});
    soup.add_polygon(std::vector<std::uint32_t>{0, 1, 2, 3});
    add(soup, make_box({1, 1, 1}), {3.3, 0.6, 7.7});
    const Mesh mesh = one_mesh(soup);
    for (std::uint32_t v = 1; v < 4; ++v) EXPECT_EQ(mesh.local_position(v).y, mesh.local_position(0).y);
}

TEST(RoundPositions, WeldWhatDiffersByTheNoiseOfDoubles) {
    Random random(3);
    PolygonSoup soup;
    const PolygonSoup part = make_sphere(0.5, 16, 8);
    add(soup, make_box({1, 1, 1}), glm::dvec3(0.0));
    for (std::size_t i = 0; i < part.polygon_count(); ++i) {  // each polygon has corners of its own
        std::vector<std::uint32_t> corners;
        for (const std::uint32_t v : part.polygon(i)) {
            corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
            glm::dvec3 p = glm::round(part.positions[v] * 1024.0) / 1024.0 + glm::floor(kFar);
            if (random.integer(0, 1) == 0) p.z = std::nextafter(p.z, 0.0);
            soup.positions.push_back(p);
        }
        soup.add_polygon(corners);
    }
    EXPECT_EQ(count_edges(one_mesh(soup)).border, 0u);
}

TEST(RoundPositions, SubdivisionKeepsThem) {
    PolygonSoup soup;
    add(soup, make_box({1, 1, 1}), glm::dvec3(0.0));
    add(soup, make_box({1, 1, 1}), kFar);
    MeshOptions options;
    options.subdivision_levels = 2;
    const Mesh mesh = build_meshes(soup, options).front(), near = build_meshes(make_box({1, 1, 1}), options).front();
    ASSERT_EQ(mesh.positions.size(), 2 * near.positions.size());
    PolygonSoup expected;
    for (std::uint32_t v = 0; v < near.positions.size(); ++v) expected.positions.push_back(near.position(v) + kFar);
    EXPECT_LT(largest_error(expected, mesh), 5e-7);
}

TEST(RoundPositions, EachObjectIsKept) {
    PolygonSoup soup;
    add(soup, make_box({1, 1, 1}), glm::dvec3(0.0));
    add(soup, make_box({0.3, 0.3, 0.3}), kFar);
    soup.object_names = {"marker", "part"};
    soup.polygon_object.assign(soup.polygon_count(), 1);
    std::fill_n(soup.polygon_object.begin(), 6, 0u);
    const std::vector<Mesh> meshes = build_meshes(soup, {});
    ASSERT_EQ(meshes.size(), 2u);
    for (const Mesh& mesh : meshes) EXPECT_EQ(mesh.triangles.size(), 12u);
}

TEST(RoundPositions, UsualModelsNeedNoResiduals) {
    for (const PolygonSoup& soup :
         {make_box({1, 1, 1}), make_sphere(0.5, 256, 128), make_cylinder(0.01, 0.01, 30, 64), make_teapot(10)}) {
        EXPECT_FALSE(one_mesh(soup).has_residuals());
        PolygonSoup far;
        add(far, soup, kFar);
        EXPECT_FALSE(one_mesh(far).has_residuals());
    }
    PolygonSoup on_ground;  // a hundred times as large
    add(on_ground, make_box({100, 1, 100}), glm::dvec3(0.0));
    add(on_ground, make_sphere(0.5, 48, 24), {0, 1, 0});
    EXPECT_FALSE(one_mesh(on_ground).has_residuals());
}

TEST(RoundPositions, AModelInOnePlaceHasItsOriginThere) {
    PolygonSoup soup;
    soup.positions = {{5, 6, 7}, {5, 6, 7}, {5, 6, 7}};
    soup.corners = {0, 1, 2};
    const RoundedPositions rounded = round_positions(soup);
    EXPECT_EQ(rounded.origin, glm::dvec3(5, 6, 7));
    EXPECT_EQ(rounded.positions[0], glm::vec3(0));
    EXPECT_TRUE(rounded.residuals.empty());
}

}  // namespace
}  // namespace burin
