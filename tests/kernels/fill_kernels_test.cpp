// What pixels get from samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "abuffer/samples/sample_tile.h"
#include "kernels/tile_kernels.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"
#include "view/projection.h"

namespace burin {
namespace {

using namespace test;

TEST(FillKernels, CoveredSamplesAreCounted) {
    Random random(5);
    for (const int s : {2, 4, 8}) {
        SampleTile tile;
        tile.reset(0, 0, 65, 65, s);
        // Runs and noise.
        for (std::size_t i = 0; i < tile.ids.size(); ++i) {
            const bool is_noise = i / 16 % 2 == 0, is_covered = is_noise ? random.integer(0, 1) == 0 : i / 32 % 2 == 0;
            tile.ids[i] = is_covered ? random.bits() >> 1 : SampleTile::kBackground;
        }
        for (const TileKernels* kernels : all_kernels()) {
            std::uint8_t counts[64 + 7];
            kernels->fill.count_covered(tile.ids.data(), tile.stride, s, 64 / s, counts);
            for (int x = 0; x < 64 / s; ++x) {
                int expected = 0;
                for (int i = 0; i < s * s; ++i) {
                    expected += tile.ids[tile.index(x * s + i % s, i / s)] != SampleTile::kBackground;
                }
                EXPECT_EQ(counts[x], expected) << kernels->name;
            }
        }
    }
}

// The distance that a pixel shows, from its ray and the plane of the triangle alone.
double distance_along_ray(const Projection& projection, const TriangleGeometry& geometry, glm::dvec2 pixel) {
    glm::dvec3 origin, ray;
    projection.view_ray(pixel, origin, ray);
    const glm::dvec3 normal(geometry.normal[0], geometry.normal[1], geometry.normal[2]);
    const double at = (geometry.offset - glm::dot(normal, origin)) / glm::dot(normal, ray);
    return std::isfinite(at) ? std::clamp(at, geometry.nearest, geometry.farthest) : geometry.nearest;
}

TEST(FillKernels, PixelsLieInThePlanesOfTheirTriangles) {
    constexpr std::size_t kCount = 61;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        Random random(seed);
        Projection projection;
        projection.orthographic = seed % 2 == 1;
        projection.focal_px = random.real(50, 900);
        if (seed % 4 >= 2) projection.set_pixel_aspect(random.real(0.2, 5));
        projection.center_px = {random.real(0, 640), random.real(0, 480)};
        std::vector<TriangleGeometry> geometries(20);
        geometries[0].nearest = geometries[0].farthest = std::numeric_limits<double>::infinity();  // the background
        for (std::size_t i = 1; i < geometries.size(); ++i) {
            TriangleGeometry& geometry = geometries[i];
            for (double& n : geometry.normal) n = random.real(-1, 1);
            if (i == 1) geometry.normal[0] = geometry.normal[1] = geometry.normal[2] = 0;  // never met
            geometry.offset = random.real(-5, 0.5);
            geometry.nearest = random.real(0.1, 2);
            geometry.farthest = geometry.nearest + random.real(0, 5);
            for (float& n : geometry.world_normal) n = static_cast<float>(random.real(-1, 1));
            geometry.object_id = static_cast<std::uint32_t>(3 * i);
            geometry.material_id = geometry.object_id + 1;
            geometry.polygon_id = geometry.object_id + 2;
        }
        std::array<std::uint16_t, kCount> geometry_at;
        for (std::uint16_t& l : geometry_at) l = static_cast<std::uint16_t>(random.integer(0, 19));
        const int x0 = random.integer(0, 600), y = random.integer(0, 479);
        const glm::dvec2 focal = projection.focal_xy_px();
        const glm::dvec2 first = glm::dvec2(x0 + 0.5, y + 0.5) - projection.center_px;
        for (const TileKernels* kernels : all_kernels()) {
            std::array<float, kCount + 3> distance, normal[3];
            std::array<std::uint32_t, kCount + 3> ids[3];
            kernels->fill.geometry({projection.orthographic, first.x, first.y, focal.x, focal.y}, geometries.data(),
                                   geometry_at.data(), kCount,
                                   {distance.data(),
                                    {normal[0].data(), normal[1].data(), normal[2].data()},
                                    {ids[0].data(), ids[1].data(), ids[2].data()}});
            for (std::size_t i = 0; i < kCount; ++i) {
                const TriangleGeometry& geometry = geometries[geometry_at[i]];
                const double expected =
                    distance_along_ray(projection, geometry, glm::dvec2(x0 + 0.5 + static_cast<double>(i), y + 0.5));
                if (geometry_at[i] == 0) {
                    ASSERT_EQ(distance[i], std::numeric_limits<float>::infinity());
                } else {
                    ASSERT_NEAR(distance[i], expected, 1e-6 * expected)
                        << kernels->name << ", seed " << seed << ", pixel " << i;
                }
                for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(normal[c][i], geometry.world_normal[c]);
                ASSERT_EQ(ids[0][i], geometry.object_id);
                ASSERT_EQ(ids[1][i], geometry.material_id);
                ASSERT_EQ(ids[2][i], geometry.polygon_id);
            }
        }
    }
}

/// Equal to the bit to plain arithmetic, whatever the number of triangles; nothing behind them is written.
TEST(FillKernels, NormalsOfTrianglesAreUnitVectors) {
    Random random(7);
    std::size_t thin = 0;
    for (std::size_t count = 0; count < 200; ++count) {
        const float size = std::exp2(static_cast<float>(random.integer(-40, 40)));
        std::vector<glm::vec3> positions(6);
        for (glm::vec3& p : positions) {
            for (int c = 0; c < 3; ++c)
                p[c] = size * static_cast<float>(random.integer(-9, 9)) * (c == 1 ? 1e-3f : 1.0f);
        }
        std::vector<std::array<std::uint32_t, 3>> triangles(count);
        for (auto& corners : triangles) {
            for (std::uint32_t& corner : corners) corner = static_cast<std::uint32_t>(random.integer(0, 5));
        }
        const double thin_square = 1e-6 * random.integer(0, 4);
        for (const TileKernels* kernels : all_kernels()) {
            std::vector<float> normals(4 * count + 4, 7.0f);
            std::vector<std::uint8_t> is_thin(count + 1, 7);
            kernels->mesh.normals(&positions[0].x, count > 0 ? triangles[0].data() : nullptr, count, thin_square,
                                  normals.data(), is_thin.data());
            for (std::size_t t = 0; t < count; ++t) {
                const auto corner = [&](std::size_t k) { return glm::dvec3(positions[triangles[t][k]]); };
                const glm::dvec3 p = corner(1) - corner(0), q = corner(2) - corner(0), r = q - p,
                                 area = glm::cross(p, q);
                const double longest = std::max({glm::dot(p, p), glm::dot(q, q), glm::dot(r, r)}),
                             square = glm::dot(area, area);
                const glm::vec3 unit(area * (1 / std::max(std::sqrt(square), 1e-300)));
                for (int c = 0; c < 3; ++c)
                    EXPECT_EQ(normals[4 * t + static_cast<std::size_t>(c)], unit[c]) << kernels->name;
                EXPECT_EQ(normals[4 * t + 3], 0.0f);
                const bool expected = !(square > thin_square * longest * longest);
                EXPECT_EQ(is_thin[t], expected ? 1 : 0) << kernels->name;
                thin += expected ? 1 : 0;
            }
            EXPECT_EQ(normals[4 * count], 7.0f);
            EXPECT_EQ(is_thin[count], 7);
        }
    }
    EXPECT_GT(thin, 1000u);
}

/// Triangles have all sizes and proportions, and all kernels find the same.
TEST(FillKernels, RoughNormalsAreNearlyNormals) {
    std::size_t slivers = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        const auto count = static_cast<std::size_t>(random.integer(0, 40));
        const double size = std::exp2(random.integer(-60, 60)), flat = std::exp2(-random.integer(0, 14)),
                     away = random.integer(0, 2);
        std::vector<glm::vec3> positions(12);
        for (glm::vec3& p : positions)
            p = glm::vec3(size * (glm::dvec3(away, 2 * away, -away) + random.in_box(1) * glm::dvec3(1, flat, 1)));
        std::vector<std::array<std::uint32_t, 3>> triangles(count);
        for (auto& corners : triangles) {
            for (std::uint32_t& corner : corners) corner = static_cast<std::uint32_t>(random.integer(0, 11));
        }
        const double thin_square = seed % 2 == 0 ? 1e-6 : 1e-3;
        const std::uint32_t* const corners = count > 0 ? triangles[0].data() : nullptr;
        std::vector<float> normals(4 * count);
        std::vector<std::uint8_t> is_thin(count);
        baseline_kernels().mesh.normals(&positions[0].x, corners, count, thin_square, normals.data(), is_thin.data());
        std::vector<std::int16_t> first;
        for (const TileKernels* kernels : all_kernels()) {
            std::vector<std::int16_t> rough(4 * count + 4, 7);
            std::vector<std::uint8_t> found(count + 1, 7);
            kernels->mesh.rough_normals(&positions[0].x, corners, count, thin_square, rough.data(), found.data());
            for (std::size_t t = 0; t < count; ++t) {
                double square = 0;
                for (std::size_t c = 0; c < 3; ++c) {
                    const double error = rough[4 * t + c] - double{kRoughUnit} * double{normals[4 * t + c]};
                    square += error * error;
                }
                ASSERT_LT(square, 9) << kernels->name << ", seed " << seed << ", triangle " << t;
                ASSERT_EQ(rough[4 * t + 3], 0);
                ASSERT_EQ(found[t], is_thin[t] != 0 ? kMayBeSliver : 0)
                    << kernels->name << ", seed " << seed << ", triangle " << t;
                slivers += is_thin[t];
            }
            ASSERT_EQ(rough[4 * count], 7);
            ASSERT_EQ(found[count], 7);
            if (first.empty()) first = rough;
            ASSERT_EQ(rough, first) << kernels->name << ", seed " << seed;
        }
    }
    EXPECT_GT(slivers, 1000u);
}

/// On rings of all lengths, wound alike and not, with angles on either side of the limit and at it.
TEST(FillKernels, CreasesAreWhatIsNotPlainlySmooth) {
    std::size_t creases = 0, smooth = 0, doubts = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const auto triangles = static_cast<std::size_t>(random.integer(1, 60));
        const std::size_t half_edges = 3 * triangles;
        std::vector<std::uint32_t> begins(half_edges), next(half_edges), order(half_edges);
        for (std::uint32_t& b : begins) b = static_cast<std::uint32_t>(random.integer(0, 5));
        std::iota(order.begin(), order.end(), 0u);
        for (std::size_t i = half_edges; i-- > 1;)
            std::swap(order[i], order[static_cast<std::size_t>(random.integer(0, static_cast<int>(i)))]);
        for (std::size_t i = 0; i < half_edges;) {
            const std::size_t length = std::min(
                half_edges - i, static_cast<std::size_t>(random.integer(0, 5) == 0 ? random.integer(1, 4) : 2));
            for (std::size_t k = 0; k < length; ++k) next[order[i + k]] = order[i + (k + 1) % length];
            i += length;
        }
        std::vector<std::int16_t> normals(4 * triangles);
        for (std::size_t t = 0; t < triangles; ++t) {
            const std::array<std::int16_t, 4> normal = random.integer(0, 2) > 0
                                                           ? std::array<std::int16_t, 4>{-19660, 26213, 0, 0}
                                                           : std::array<std::int16_t, 4>{0, 32767, 0, 0};
            std::copy(normal.begin(), normal.end(), normals.begin() + static_cast<std::ptrdiff_t>(4 * t));
        }
        const std::int32_t between = 26213 * 32767;
        const std::int32_t low = between + random.integer(-1, 1), high = low + random.integer(0, 2);
        const auto first = static_cast<std::size_t>(random.integer(0, static_cast<int>(triangles) - 1));
        for (const TileKernels* kernels : all_kernels()) {
            std::vector<std::uint8_t> found(triangles - first + 1, 8);
            std::vector<std::uint32_t> in_doubt(half_edges), expected_doubts;
            in_doubt.resize(kernels->mesh.find_creases(begins.data(), next.data(), normals.data(), first,
                                                       triangles - first, low, high, found.data(), in_doubt.data()));
            for (std::size_t t = first; t < triangles; ++t) {
                unsigned expected = 8;
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::size_t h = 3 * t + k, g = next[h];
                    std::int32_t cosine = 0;
                    for (std::size_t c = 0; c < 3; ++c) cosine += normals[4 * t + c] * normals[4 * (g / 3) + c];
                    const bool is_pair = g != h && next[g] == h && begins[g] != begins[h];
                    const bool is_smooth = is_pair && cosine > high;
                    expected |= is_smooth ? 0u : 1u << k;
                    if (is_pair && !is_smooth && cosine >= low)
                        expected_doubts.push_back(static_cast<std::uint32_t>(h));
                    ++(is_smooth ? smooth : creases);
                }
                ASSERT_EQ(found[t - first], expected) << kernels->name << ", seed " << seed << ", triangle " << t;
            }
            ASSERT_EQ(in_doubt, expected_doubts) << kernels->name << ", seed " << seed;
            EXPECT_EQ(found.back(), 8);
            doubts += in_doubt.size();
        }
    }
    EXPECT_GT(doubts, 1000u);
    EXPECT_GT(creases, 1000u);
    EXPECT_GT(smooth, 1000u);
}

}  // namespace
}  // namespace burin
