// What runs of triangles say of all of theirs.

#include "abuffer/screen/triangle_bins.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/frame.h"
#include "tests/support/drawing.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"
#include "tests/support/rough_sphere.h"

namespace burin::triangle_bins_test {
namespace {

using namespace test;

/// One after the other.
void expect_summed_up(const TriangleRun& run) {
    TileTriangle all = run.triangles[0];
    std::uint32_t column0 = 31, column1 = 0, row0 = 31, row1 = 0;
    for (std::uint32_t i = 0; i < run.count; ++i) {
        const TileTriangle& t = run.triangles[i];
        all.highest = std::max(all.highest, t.highest);
        column0 = std::min(column0, static_cast<std::uint32_t>(t.first_column()));
        column1 = std::max(column1, static_cast<std::uint32_t>(t.last_column()));
        row0 = std::min(row0, static_cast<std::uint32_t>(t.first_row()));
        row1 = std::max(row1, static_cast<std::uint32_t>(t.last_row()));
    }
    ASSERT_EQ(run.highest, all.highest) << run.count;
    ASSERT_EQ(run.blocks, TileTriangle::pack(column0, column1, row0, row1)) << run.count;
}

TEST(TriangleBins, RunsThatFaceAwayAreSummedUp) {
    int short_ones = 0, long_ones = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const Scene scene =
            scene_of({rough_sphere(random, random.integer(8, 200), random.real(0, 8)), make_box({0.4, 0.9, 1.2})});
        const PixelRect picture{0, 0, 150, 110};
        const Frame frame = make_frame(scene, perspective_camera(random.direction() * random.real(2.0, 9.0), {0, 0, 0}),
                                       150, 110, picture);
        for (const TileKernels* kernels : all_kernels()) {
            ScreenSurfaces screen(frame.surfaces, frame.criteria, *kernels, 1);
            const TriangleBins bins(screen, picture, 1 << random.integer(1, 3), *kernels, 1);
            for (std::size_t tile = 0; tile < bins.tile_count(); ++tile) {
                for (const TriangleRun& run : bins.runs_in(tile)) {
                    if (run.kind != wound_clockwise) continue;
                    expect_summed_up(run);
                    ++(run.count < 8 ? short_ones : long_ones);
                }
            }
        }
    }
    EXPECT_GT(short_ones, 20);
    EXPECT_GT(long_ones, 500);
}

}  // namespace
}  // namespace burin::triangle_bins_test
