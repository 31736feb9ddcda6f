// TileKernels::Walk::find_smooth() against FastDecision::is_smooth(), which asks one pair of samples after the other.

#include <gtest/gtest.h>

#include <vector>

#include "abuffer/samples/fast_decision.h"
#include "abuffer/samples/surface_tile.h"
#include "mesh/shapes.h"
#include "tests/support/drawing.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"
#include "tests/support/rough_sphere.h"

namespace burin::smooth_pairs_test {
namespace {

using namespace test;

constexpr int kWidth = 90, kHeight = 70;

struct Counts {
    int smooth = 0, rough = 0;

    void operator+=(const Counts& c) {
        smooth += c.smooth;
        rough += c.rough;
    }
};

/// All neighbours with something at the first one, whatever lies between them; for each mesh of the scene.
Counts compare(const Scene& scene, glm::dvec3 eye, int samples) {
    const Frame frame = make_frame(scene, perspective_camera(eye, {0, 0, 0}), kWidth, kHeight, {0, 0, kWidth, kHeight});
    ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
    const TriangleBins bins(screen, frame.crop, samples, best_kernels(), 1);
    SurfaceTile tile(frame, screen, bins, samples, best_kernels());
    const FastDecision fast(screen, frame.criteria);
    const std::int32_t pitch = kSubpixelsPerPixel / samples;
    Counts counts;
    for (std::size_t t = 0; t < bins.tile_count(); ++t) {
        tile.draw(t);
        SampleTile s = tile.samples();
        std::vector<SamplePair> pairs;
        std::vector<NeighbourSamples> neighbours;
        const auto add = [&](int column, int row, bool down) {
            const std::size_t a = s.index(column, row), b = down ? s.index(column, row + 1) : s.index(column + 1, row);
            if (s.ids[a] == SampleTile::kBackground || s.ids[a] >> 1 == s.ids[b] >> 1) return;
            pairs.push_back(SamplePair::at(column - s.first_column, row - s.first_row, down));
            neighbours.push_back({column * pitch + pitch / 2,
                                  row * pitch + pitch / 2,
                                  pitch,
                                  down,
                                  {tile.surface_at(a), tile.surface_at(b)}});
        };
        for (int row = s.first_row; row + 1 < s.first_row + s.rows; ++row) {
            for (int column = s.first_column; column + 1 < s.first_column + s.columns; ++column) {
                add(column, row, false);
                add(column, row, true);
            }
        }
        const SampleView view{s.nearness.data(),
                              s.ids.data(),
                              s.first_column,
                              s.first_row,
                              s.columns,
                              s.rows,
                              s.stride,
                              samples,
                              0,
                              0,
                              nullptr,
                              nullptr,
                              0};
        for (const TileKernels* kernels : all_kernels()) {
            for (std::uint32_t i = 0; i < frame.surfaces.instances.size(); ++i) {
                std::vector<std::uint8_t> is_smooth(pairs.size(), 7);
                kernels->walk.find_smooth(view, screen.mesh(i), fast.smooth_limits(), pairs.data(), pairs.size(),
                                          is_smooth.data());
                for (std::size_t p = 0; p < pairs.size(); ++p) {
                    const bool expected = neighbours[p].surfaces[0].instance == i && fast.is_smooth(neighbours[p]);
                    EXPECT_EQ(is_smooth[p], expected ? 1 : 0) << kernels->name << ", pair " << p << " of tile " << t;
                    if (neighbours[p].surfaces[0].instance != i) continue;
                    ++(expected ? counts.smooth : counts.rough);
                }
            }
        }
    }
    return counts;
}

TEST(SmoothPairs, ManyAtOnceAreAsEachAlone) {
    Counts sum;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        std::vector<PolygonSoup> objects;
        objects.push_back(rough_sphere(random, random.integer(40, 260), random.real(0, 4), random.real(0.2, 8)));
        objects.push_back(make_torus(0.9, 0.3, random.integer(5, 90), random.integer(5, 60)));
        sum += compare(scene_of(std::move(objects)), random.direction() * random.real(2.0, 9.0),
                       1 << random.integer(1, 3));
    }
    EXPECT_GT(sum.smooth, 20000);
    EXPECT_GT(sum.rough, 20000);
}

/// Walls that are nearly edge-on, slivers and sharp edges end a smooth surface.
TEST(SmoothPairs, WallsAndSharpEdges) {
    Counts sum;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        std::vector<PolygonSoup> objects{make_cylinder(0.6, 0.6, 6, random.integer(40, 2000)),
                                         rough_sphere(random, 300, 20, 30)};
        const glm::dvec3 eye(random.real(-0.01, 0.01), 9, random.real(-0.01, 0.01));
        sum += compare(scene_of(std::move(objects)), eye, 4);
    }
    EXPECT_GT(sum.smooth, 1000);
    EXPECT_GT(sum.rough, 1000);
}

/// Needles between the triangles of a sheet, a few thousandths of a sample wide.
TEST(SmoothPairs, Slivers) {
    Counts sum;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        PolygonSoup sheet = make_plane(3, 3, 160, 160);
        for (std::size_t i = 0; i + 1 < sheet.positions.size(); i += 3) {
            sheet.positions[i] = glm::mix(sheet.positions[i + 1], sheet.positions[i], random.real(0, 3e-3));
        }
        sum += compare(scene_of({std::move(sheet)}), {random.real(-1, 1), 3, random.real(-1, 1)}, 8);
    }
    EXPECT_GT(sum.smooth, 1000);
    EXPECT_GT(sum.rough, 1000);
}

}  // namespace
}  // namespace burin::smooth_pairs_test
