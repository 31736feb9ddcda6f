// narrow_range() against is_fold_wide(), place by place.

#include <gtest/gtest.h>

#include "abuffer/edges/fold_width.h"
#include "abuffer/screen/triangle_bins.h"
#include "tests/support/drawing.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"

namespace burin::fold_range_test {
namespace {

using namespace test;

constexpr int kSize = 200;

/// A plate in front, walls of many triangles along two of its sides that lead away from the eye, with flanges at their
/// back rims or without. `lean`: how far walls lean over their depth.
PolygonSoup plate_with_walls(Random& random, double lean) {
    PolygonSoup soup;
    const int columns = random.integer(1, 12),
              rows = random.integer(0, 1) == 0 ? random.integer(1, 6) : random.integer(60, 90);
    const bool has_flange = random.integer(0, 1) == 0;  // else the walls end
    const auto add = [&](const glm::dvec3& p) {
        soup.positions.push_back(p);
        return static_cast<std::uint32_t>(soup.positions.size() - 1);
    };
    const auto polygon = [&](std::initializer_list<std::uint32_t> corners) {
        soup.add_polygon(std::vector<std::uint32_t>(corners));
    };
    for (const bool is_upright : {true, false}) {
        const double side = random.real(0.2, 0.6), flange = random.integer(0, 1) == 0 ? 0.3 : -0.3;
        const auto place = [&](double along, double depth, double out) {
            const double across = side + out + lean * depth;
            return is_upright ? glm::dvec3(across, along, -depth) : glm::dvec3(along, across, -depth);
        };
        std::vector<std::vector<std::uint32_t>> grid(static_cast<std::size_t>(rows + 1));
        for (int r = 0; r <= rows; ++r) {
            for (int c = 0; c <= columns; ++c) {
                const bool is_inner = r > 0 && r < rows && c > 0 && c < columns;
                const double along = -0.7 + 1.4 * (c + (is_inner ? random.real(-0.3, 0.3) : 0)) / columns;
                grid[static_cast<std::size_t>(r)].push_back(
                    add(place(along, 0.5 * (r + (is_inner ? random.real(-0.3, 0.3) : 0)) / rows, 0)));
            }
        }
        for (std::size_t r = 0; r + 1 < grid.size(); ++r) {
            for (std::size_t c = 0; c + 1 < grid[r].size(); ++c) {
                polygon({grid[r][c], grid[r][c + 1], grid[r + 1][c + 1]});
                polygon({grid[r][c], grid[r + 1][c + 1], grid[r + 1][c]});
            }
        }
        for (const std::size_t r :
             {std::size_t{0}, grid.size() - 1}) {  // a strip along the front rim, and perhaps one along the back rim
            if (r > 0 && !has_flange) continue;
            for (std::size_t c = 0; c + 1 < grid[r].size(); ++c) {
                const double depth = r == 0 ? 0 : 0.5, out = r == 0 ? -0.1 : flange;
                const double from = -0.7 + 1.4 * static_cast<double>(c) / columns,
                             to = -0.7 + 1.4 * static_cast<double>(c + 1) / columns;
                polygon({grid[r][c], grid[r][c + 1], add(place(to, depth, out)), add(place(from, depth, out))});
            }
        }
    }
    return soup;
}

TEST(FoldRange, NothingInItIsWide) {
    int inside = 0, narrow = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Random random(seed);
        const Scene scene = scene_of({plate_with_walls(random, seed % 3 == 0 ? 1e-5 : 0)});
        Camera camera = perspective_camera({0, 0, 4}, {0, 0, 0});
        camera.orthographic = true;
        camera.height = 2;
        const Frame frame = make_frame(scene, camera, kSize, kSize, {0, 0, kSize, kSize});
        ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
        const TriangleBins bins(screen, frame.crop, 2, best_kernels(), 1);  // finds out which way triangles face
        const ScreenMesh& mesh = screen.mesh(0);
        for (HalfEdge h = 0; h < 3 * mesh.triangle_count; ++h) {
            const ScreenVertex &a = mesh.vertices[mesh.corners[h]],
                               &b = mesh.vertices[mesh.corners[h - h % 3 + (h + 1) % 3]];
            const glm::dvec2 from(a.x, a.y), to(b.x, b.y);
            if (from == to) continue;
            const auto is_wide_at = [&](double t) {
                const double nearness = glm::mix(static_cast<double>(a.nearness), static_cast<double>(b.nearness), t);
                return is_fold_wide(mesh, h, from + (to - from) * t, nearness, 1e-6);
            };
            const double at = random.real(0.01, 0.99);
            const OpenRange range = narrow_range(mesh, h, from + (to - from) * at);
            narrow += !is_wide_at(at);
            if (!(range.low < range.high)) continue;
            const int axis = from.x != to.x ? 0 : 1;
            ASSERT_TRUE(range.contains((from + (to - from) * at)[axis])) << "seed " << seed;
            for (int k = 0; k < 50; ++k) {
                const double t = random.real(0, 1);
                if (!range.contains((from + (to - from) * t)[axis])) continue;
                ASSERT_FALSE(is_wide_at(t)) << "seed " << seed << " half-edge " << h << " at " << t;
                ++inside;
            }
        }
    }
    EXPECT_GT(inside, 2000);
    EXPECT_GT(narrow, 500);
}

}  // namespace
}  // namespace burin::fold_range_test
