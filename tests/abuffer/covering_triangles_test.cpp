#include "abuffer/fine/covering_triangles.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "abuffer/edges/occluder.h"
#include "abuffer/fine/fine_cells.h"
#include "abuffer/fine/fine_edges.h"
#include "abuffer/screen/triangle_bins.h"
#include "kernels/screen_triangles.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::covering_triangles_test {
namespace {

using namespace test;

/// Triangles of all sizes, some a line or a point, some behind the eye.
PolygonSoup random_triangles(Random& random, int count) {
    PolygonSoup soup;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 place = random.in_box(1) * glm::dvec3(1, 1, i % 10 == 0 ? 8 : 0.5);
        const double size = random.real(0.01, i % 4 == 0 ? 0.2 : 6);
        const glm::dvec3 along = size * random.direction();
        const glm::dvec3 across = i % 9 == 0 ? 2.0 * along : size * random.direction();
        for (const glm::dvec3& p : {place, place + along, place + across}) {
            soup.corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
            soup.positions.push_back(p);
        }
    }
    return soup;
}

/// Whether a triangle has all corners of a block in it, exactly: its corners are rounded to whole numbers of 24 bits,
/// and products of their distances have 64 bits, as many as this type keeps.
bool has_corners(const CrossedTriangle& t, glm::ivec2 corner) {
    using Exact = long double;
    bool has_left = false, has_right = false;
    for (const glm::ivec2& p : {corner, corner + glm::ivec2(2048, 0), corner + glm::ivec2(0, 2048), corner + 2048}) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            const Exact along_x = Exact{t.x[next]} - t.x[k], along_y = Exact{t.y[next]} - t.y[k];
            const Exact to_left = along_x * (p.y - Exact{t.y[k]}), to_right = along_y * (p.x - Exact{t.x[k]});
            has_left |= to_left > to_right;
            has_right |= to_left < to_right;
        }
    }
    return has_left != has_right;
}

TEST(CoveringTriangles, AreThoseWithAllCornersOfABlockAndAreInEachCell) {
    std::size_t covering = 0, partly = 0, sorted = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Random random(seed);
        constexpr int kSize = 96;
        const Scene scene = scene_of({random_triangles(random, seed % 2 == 0 ? 40 : 1500)});
        const Frame frame =
            make_frame(scene, perspective_camera({0, 0, 4}, {0, 0, 0}), kSize, kSize, {0, 0, kSize, kSize});
        ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
        const TriangleBins bins(screen, {0, 0, kSize, kSize}, 2, best_kernels(), 1);  // it says how triangles face
        std::vector<CrossedTriangle> triangles;
        for (std::uint32_t n = 0; n < screen.triangle_count(); ++n) {
            const Facing facing = screen.facing(n);
            const auto [a, b, c] = screen.triangle(screen.surface_of(n)).corners;
            triangles.push_back(crossed_triangle(a, b, c, facing, n));
        }
        FineCells cells(screen, best_kernels());
        for (int k = 0; k < 20; ++k) {
            const glm::ivec2 corner = 2048 * glm::ivec2(random.integer(0, 11), random.integer(0, 11)) + 64;
            std::size_t expected = 0;
            for (const CrossedTriangle& t : triangles)
                expected += screen.facing(t.number) != off_screen && has_corners(t, corner);
            ASSERT_EQ(count_covering(screen, triangles, corner), expected) << "seed " << seed;
            cells.set(triangles, corner, 1000);
            ASSERT_GE(cells.triangles_per_cell(), expected) << "seed " << seed;
            covering += expected;
            partly += triangles.size() - expected;
            sorted += cells.triangles_per_cell() < triangles.size();
        }
    }
    EXPECT_GT(covering, 1000u);
    EXPECT_GT(partly, 1000u);
    EXPECT_GT(sorted, 10u);
}

}  // namespace
}  // namespace burin::covering_triangles_test
