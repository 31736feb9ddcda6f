// Heaps of surfaces that are level with each other in every sample of a tile.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "abuffer/samples/surface_tile.h"
#include "tests/support/drawing.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"

namespace burin::level_heap_test {
namespace {

using namespace test;

constexpr int kSize = 48, kSamples = 2;

/// Large triangles, small ones and copies, all in one place but for less than a pixel.
Scene heap(int count) {
    Random random(1);
    std::vector<PolygonSoup> objects;
    for (int i = 0; i < count; ++i) {
        const auto at = [&](double x, double y) {
            return i % 3 == 0 ? glm::dvec3(x, y, 0) : glm::dvec3(x, y, 0) + random.in_box(1);
        };
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

/// Which triangle is seen at every sample of the first tile. `most`: how many contests are noted
/// before they are selected.
struct HeapSamples {
    std::vector<std::uint32_t> ids;
    std::vector<float> nearness;
    std::size_t room_for_contests;
    int covered;
};

HeapSamples samples_of(const Scene& scene, const TileKernels& kernels, std::size_t most) {
    const Frame frame = make_frame(scene, pixel_camera(kSize, kSize), kSize, kSize, {0, 0, kSize, kSize});
    ScreenSurfaces screen(frame.surfaces, frame.criteria, kernels, 1);
    const TriangleBins bins(screen, frame.crop, kSamples, kernels, 1);
    SurfaceTile tile(frame, screen, bins, kSamples, kernels, most);
    tile.draw(0);
    const SampleTile& s = tile.samples();
    HeapSamples found{{}, {}, tile.room_for_contests(), 0};
    for (int row = 0; row < s.rows; ++row) {
        for (int column = 0; column < s.columns; ++column) {
            found.ids.push_back(s.ids[s.index(column, row)]);
            found.nearness.push_back(s.nearness[s.index(column, row)]);
            found.covered += found.ids.back() != SampleTile::kBackground ? 1 : 0;
        }
    }
    return found;
}

/// However few of the places where surfaces are level are noted before they are selected, the
/// samples are the same.
TEST(LevelHeap, DependsOnNoRoom) {
    constexpr std::size_t kAll = std::size_t{1} << 24;
    for (const int count : {60, 200}) {
        const Scene scene = heap(count);
        for (const TileKernels* const kernels : all_kernels()) {
            const HeapSamples whole = samples_of(scene, *kernels, kAll);
            EXPECT_GT(whole.covered, 3000);
            EXPECT_GT(whole.room_for_contests, static_cast<std::size_t>(count) / 2 * kSize * kSize)
                << "not enough are level";
            for (const std::size_t most : {std::size_t{60000}, std::size_t{20000}, std::size_t{100}}) {
                const HeapSamples selected = samples_of(scene, *kernels, most);
                EXPECT_EQ(selected.ids, whole.ids) << kernels->name << ", " << count << " surfaces, " << most;
                EXPECT_EQ(selected.nearness, whole.nearness) << kernels->name << ", " << count << " surfaces, " << most;
            }
        }
    }
}

/// What is noted takes the same memory however many surfaces lie in one place, and the first of
/// those that are equally near is seen.
TEST(LevelHeap, TakesTheSameMemoryForAnyNumber) {
    const PolygonSoup one = soup_of({{2, 3, 0}, {46, 5, 0}, {9, 45, 0}}, {{0, 1, 2}});
    std::size_t room = 0;
    for (const int count : {200, 1000, 3000}) {
        const Scene scene = scene_of(std::vector<PolygonSoup>(static_cast<std::size_t>(count), one));
        const HeapSamples found = samples_of(scene, best_kernels(), 20000);
        if (room == 0) room = found.room_for_contests;
        EXPECT_EQ(found.room_for_contests, room) << count;
        EXPECT_LT(room, 3 * Contests::kMostAtSample * 4 * kSize * kSize);
        for (const std::uint32_t id : found.ids) ASSERT_TRUE(id >> 1 == 0 || id == SampleTile::kBackground) << count;
        EXPECT_GT(found.covered, 3000);
    }
}

/// Sheets that all meet in one line, and are coincident: the first of those that take part is seen,
/// right of it where the last one is the nearest.
Scene fan(int count) {
    std::vector<PolygonSoup> objects;
    for (int i = 0; i < count; ++i) {
        const double rise = 0.01 * i / count / 24;
        const auto at = [&](double x, double y) { return glm::dvec3(x, y, rise * (x - 24)); };
        objects.push_back(soup_of({at(0, 0), at(48, 0), at(48, 48), at(0, 48)}, {{0, 1, 2, 3}}));
    }
    return scene_of(std::move(objects));
}

TEST(LevelHeap, TheNearestTakePart) {
    constexpr int kAll = static_cast<int>(Contests::kMostAtSample) + 1;  // and the one that is seen
    constexpr std::size_t kAtRight = 2 * kSize - 1;
    for (const TileKernels* const kernels : all_kernels()) {
        for (const int more : {0, 1, 7, 50}) {
            for (const std::size_t most : {std::size_t{1} << 24, std::size_t{100}}) {
                const Scene scene = fan(kAll + more);
                const HeapSamples found = samples_of(scene, *kernels, most);
                const std::size_t columns = 2 * kSize + 1;
                for (std::size_t row = 0; row < 2 * kSize; row += 7) {
                    const auto object_at = [&](std::size_t column) {
                        return found.ids[row * columns + column] / 2 / 2;
                    };  // of two triangles each
                    EXPECT_EQ(object_at(kAtRight), more) << kernels->name << " " << most;
                    EXPECT_EQ(object_at(0), 0) << kernels->name << " " << most;
                }
            }
        }
    }
}

}  // namespace
}  // namespace burin::level_heap_test
