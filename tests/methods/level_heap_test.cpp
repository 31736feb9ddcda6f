// Heaps of surfaces that are level with each other in every sample of a tile.

#include <gtest/gtest.h>

#include <algorithm>

#include "methods/abuffer/samples/surface_tile.h"
#include "tests/support/drawing.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

constexpr int kSize = 48, kSamples = 2;

/// Large triangles, small ones and copies, all in one place but for less than a pixel.
Scene heap(int count) {
    Random random(1);
    std::vector<PolygonSoup> objects;
    for (int i = 0; i < count; ++i) {
        const auto at = [&](double x, double y) { return i % 3 == 0 ? glm::dvec3(x, y, 0) : glm::dvec3(x, y, 0) + random.in_box(1); };
        if (i % 4 != 3) {
            objects.push_back(soup_of({at(2, 3), at(46, 5), at(9, 45)}, {{0, 1, 2}}));
            continue;
        }
        PolygonSoup small;
        for (int k = 0; k < 30; ++k) {
            const double x = 3 + k, y = 5 + 7 * (k % 5);
            const auto first = static_cast<std::uint32_t>(small.positions.size());
            for (const glm::dvec3& p : {at(x, y), at(x + 9, y + 1), at(x + 2, y + 8)}) small.positions.push_back(p);
            const std::uint32_t corners[3] = {first, first + 1, first + 2};
            small.add_polygon(corners);
        }
        objects.push_back(std::move(small));
    }
    return scene_of(std::move(objects));
}

/// However few of the places where surfaces are level are noted at a time, the samples are the same.
TEST(LevelHeap, IsSettledBandByBand) {
    const Scene scene = heap(60);
    const Frame frame = make_frame(scene, pixel_camera(kSize, kSize), kSize, kSize, {0, 0, kSize, kSize});
    for (const TileKernels* const kernels : all_kernels()) {
        ScreenSurfaces screen(frame.surfaces, frame.criteria, *kernels, 1);
        const TriangleBins bins(screen, frame.crop, kSamples, *kernels, 1);
        SurfaceTile whole(frame, screen, bins, kSamples, *kernels);
        whole.draw(0);
        const int columns = whole.samples().columns;
        EXPECT_GT(whole.room_for_contests(), 30u * kSize * kSize);
        for (const std::size_t most : {std::size_t{20000}, std::size_t{9000}, std::size_t{100}}) {
            SurfaceTile in_bands(frame, screen, bins, kSamples, *kernels, most);
            in_bands.draw(0);
            // A row at a time is the least; kernels draw and note some rows below it, too.
            EXPECT_LE(in_bands.room_for_contests(), std::max(most + most / 8, whole.room_for_contests() / 4)) << most;
            const SampleTile &a = whole.samples(), &b = in_bands.samples();
            int different = 0, covered = 0;
            for (int row = 0; row < a.rows; ++row) {
                for (int column = 0; column < columns; ++column) {
                    const std::size_t at = a.index(column, row);
                    different += a.ids[at] != b.ids[at] || a.nearness[at] != b.nearness[at];
                    covered += a.ids[at] != SampleTile::kBackground;
                }
            }
            EXPECT_EQ(different, 0) << "of " << covered << " with " << most;
            EXPECT_GT(covered, 3000);
        }
    }
}

}  // namespace
}  // namespace burin
