// Which triangles a tile gets.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>
#include <vector>

#include "tests/kernels/random_triangles.h"
#include "tests/support/kernels.h"

namespace burin {
namespace {

using namespace test;

/// What Cull::triangles() finds of all triangles: once for each tile, and the others.
struct Culled {
    Culled(const TileKernels& kernels, Triangles& triangles, const TileGrid& grid)
        : keys(4 * triangles.count() + kRoomBehindCulled), others(triangles.count() + kRoomBehindCulled) {
        std::vector<std::uint32_t> numbers(keys.size()), blocks(keys.size());
        std::vector<float> highest(keys.size());
        CulledTriangles found{keys.data(), numbers.data(), highest.data(), blocks.data(), 0, others.data(), 0};
        kernels.cull.triangles(triangles.mesh, 0, triangles.count(), grid, triangles.facing.data(), found);
        keys.resize(found.count);
        others.resize(found.other_count);
        for (std::size_t i = 0; i < found.count; ++i) kept.push_back({numbers[i], highest[i], blocks[i]});
    }
    std::vector<std::uint32_t> keys, others;
    std::vector<TileTriangle> kept;
};

TEST(CullKernels, CullingLosesNoSample) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const int per_pixel = 2 << seed % 3;
        Triangles triangles(100 + seed, per_pixel, 0, 0);
        triangles.vertices[5].x = ScreenVertex::kOffScreen;    // of triangle 1
        triangles.vertices[7].x += 4 * kLargestSmallTriangle;  // of triangle 2
        const TileGrid grid{0, 0, 100, 90, 1, 8 - std::countr_zero(static_cast<unsigned>(per_pixel)), 7, false};
        for (const TileKernels* kernels : all_kernels()) {
            const Culled culled(*kernels, triangles, grid);
            const std::vector<TileTriangle>& kept = culled.kept;
            const std::size_t found = kept.size();
            EXPECT_LT(found, triangles.count());
            const auto place_of = [&](std::uint32_t t) {
                return static_cast<std::size_t>(
                    std::find_if(kept.begin(), kept.end(), [t](const TileTriangle& k) { return k.triangle == t; }) -
                    kept.begin());
            };
            const auto key_of = [&](std::uint32_t t) {
                return place_of(t) == found ? 0xFFFFu : culled.keys[place_of(t)];
            };
            EXPECT_EQ(culled.others, (std::vector<std::uint32_t>{1, 2}));
            for (std::uint32_t t = 3; t < triangles.count(); ++t) {
                const std::int64_t area = triangles.area(t);
                EXPECT_EQ(triangles.facing[t], area == 0 ? edge_on : area > 0 ? clockwise : counterclockwise);
                SampleTile tile;
                tile.reset(0, 0, 101, 91, per_pixel);
                if (area != 0) draw_slowly(triangles, t, tile);
                const bool covers = std::any_of(tile.ids.begin(), tile.ids.end(),
                                                [](std::uint32_t id) { return id != SampleTile::kBackground; });
                if (!covers) continue;
                ASSERT_EQ(key_of(t), tile_key(0, area > 0 ? wound_clockwise : wound_counterclockwise))
                    << kernels->name << " seed " << seed;
                const TileTriangle& own = kept[place_of(t)];
                EXPECT_EQ(own.highest, in_tile(triangles, t, tile).highest);
                for (int row = 0; row < tile.rows; ++row) {
                    for (int column = 0; column < tile.columns; ++column) {
                        if (tile.ids[tile.index(column, row)] == SampleTile::kBackground) continue;
                        EXPECT_TRUE(column / kBlockSamples >= own.first_column() &&
                                    column / kBlockSamples <= own.last_column() &&
                                    row / kBlockSamples >= own.first_row() && row / kBlockSamples <= own.last_row());
                    }
                }
            }
        }
    }
}

// What is level with what is noted in the order of a tile's list, so pictures depend on it.
TEST(CullKernels, CullingListsInOneOrder) {
    constexpr int kShift = 5, kTiles = 4, kSize = kTiles << kShift, kPerPixel = 2;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Triangles triangles(700 + seed, kPerPixel, 0, 0);
        const TileGrid grid{
            0, 0, kSize, kSize, kTiles, 8 - std::countr_zero(static_cast<unsigned>(kPerPixel)), kShift, seed % 2 == 0};
        const Culled first(*all_kernels().front(), triangles, grid);
        for (const TileKernels* kernels : all_kernels()) {
            const Culled culled(*kernels, triangles, grid);
            EXPECT_EQ(culled.keys, first.keys) << kernels->name << " seed " << seed;
            EXPECT_EQ(culled.others, first.others) << kernels->name << " seed " << seed;
            const auto is_same = [](const TileTriangle& a, const TileTriangle& b) {
                return a.triangle == b.triangle && a.blocks == b.blocks;
            };
            EXPECT_TRUE(std::ranges::equal(culled.kept, first.kept, is_same)) << kernels->name << " seed " << seed;
        }
    }
}

/// Each tile on its own lists what the grid as a whole does for it.
TEST(CullKernels, TrianglesOfSeveralTilesAreListedForEach) {
    constexpr int kShift = 5, kTiles = 4, kSize = 1 << kShift;
    std::size_t in_several = 0, in_many = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const int per_pixel = 2 << seed % 3;
        Triangles triangles(300 + seed, per_pixel, 0, 0);
        const TileGrid grid{0,
                            0,
                            kTiles * kSize,
                            kTiles * kSize,
                            kTiles,
                            8 - std::countr_zero(static_cast<unsigned>(per_pixel)),
                            kShift,
                            seed % 2 == 0};
        for (const TileKernels* kernels : all_kernels()) {
            const Culled culled(*kernels, triangles, grid);
            std::vector<int> times(triangles.count());
            for (int tile = 0; tile < kTiles * kTiles; ++tile) {
                // As a picture of its own, the tile has only what may touch it.
                TileGrid own = grid;
                own.first_column = tile % kTiles * kSize;
                own.first_row = tile / kTiles * kSize;
                own.width = own.height = kSize;
                own.columns = 1;
                const Culled expected(*kernels, triangles, own);
                std::vector<std::array<std::uint32_t, 3>> listed, alone;
                for (std::size_t i = 0; i < culled.kept.size(); ++i) {
                    const std::uint32_t kind = culled.keys[i] % kTriangleKinds;
                    if (culled.keys[i] / kTriangleKinds != static_cast<std::uint32_t>(tile)) continue;
                    listed.push_back({culled.kept[i].triangle, kind, culled.kept[i].blocks});
                    ++times[culled.kept[i].triangle];
                }
                for (std::size_t i = 0; i < expected.kept.size(); ++i) {
                    const std::uint32_t t = expected.kept[i].triangle;
                    const bool is_other =
                        std::find(culled.others.begin(), culled.others.end(), t) != culled.others.end();
                    in_many += is_other ? 1 : 0;
                    if (!is_other) alone.push_back({t, expected.keys[i], expected.kept[i].blocks});
                }
                std::sort(listed.begin(), listed.end());
                std::sort(alone.begin(), alone.end());
                EXPECT_EQ(listed, alone) << kernels->name << " seed " << seed << " tile " << tile;
            }
            in_several +=
                static_cast<std::size_t>(std::count_if(times.begin(), times.end(), [](int n) { return n > 1; }));
        }
    }
    EXPECT_GT(in_several, 1000u);
    EXPECT_GT(in_many, 100u);
}

/// What touches no sample is listed if it is asked for, with the blocks of the samples around it.
TEST(CullKernels, ThinTrianglesAreKeptIfWanted) {
    Random random(7);
    std::size_t thin_count = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const int per_pixel = 2 << seed % 3, pitch = kSubpixelsPerPixel / per_pixel;
        Triangles triangles(200 + seed, per_pixel, 0, 0);
        for (ScreenVertex& v : triangles.vertices) {  // most of them flat
            if (random.integer(0, 1) == 0) v.y = (v.y & ~(pitch - 1)) + random.integer(0, pitch - 1);
        }
        for (std::size_t t = 0; t < triangles.count(); t += 2) {
            const int y = triangles.vertices[3 * t].y & ~(pitch - 1);
            for (std::size_t k = 0; k < 3; ++k)
                triangles.vertices[3 * t + k].y = y + pitch / 2 + random.integer(1, pitch - 1);
        }
        TileGrid grid{0, 0, 100, 90, 1, 8 - std::countr_zero(static_cast<unsigned>(per_pixel)), 7, true};
        for (const TileKernels* kernels : all_kernels()) {
            const auto cull = [&] {
                const Culled culled(*kernels, triangles, grid);
                std::vector<std::pair<TileTriangle, std::uint32_t>> kept;
                for (std::size_t i = 0; i < culled.kept.size(); ++i) kept.push_back({culled.kept[i], culled.keys[i]});
                return kept;
            };
            grid.keeps_thin = true;
            const auto all = cull();
            for (std::uint32_t t = 0; t < triangles.count(); ++t) {
                const ScreenVertex v[3] = {triangles.corner(t, 0), triangles.corner(t, 1), triangles.corner(t, 2)};
                const auto [x0, x1] = std::minmax({v[0].x, v[1].x, v[2].x});
                const auto [y0, y1] = std::minmax({v[0].y, v[1].y, v[2].y});
                const auto at = [&](int sample) { return sample * pitch + pitch / 2; };
                const bool is_in_grid = x1 >= at(0) && x0 <= at(grid.width) && y1 >= at(0) && y0 <= at(grid.height);
                const auto own =
                    std::find_if(all.begin(), all.end(), [t](const auto& k) { return k.first.triangle == t; });
                ASSERT_EQ(own != all.end(), is_in_grid && triangles.area(t) != 0)
                    << kernels->name << " seed " << seed << " triangle " << t;
                if (own == all.end() || own->second != tile_key(0, thin)) continue;
                ++thin_count;
                const auto block = [&](double place, bool up, int last) {
                    const double sample = (place - pitch / 2) / pitch;
                    return std::clamp(static_cast<int>(up ? std::ceil(sample) : std::floor(sample)), 0, last) /
                           kBlockSamples;
                };
                EXPECT_LE(own->first.first_column(), block(x0, true, grid.width));
                EXPECT_GE(own->first.last_column(), block(x1, false, grid.width));
                EXPECT_LE(own->first.first_row(), block(y0, true, grid.height));
                EXPECT_GE(own->first.last_row(), block(y1, false, grid.height));
                EXPECT_LE(own->first.first_row(), own->first.last_row());
                EXPECT_LE(own->first.first_column(), own->first.last_column());
                // Between two samples: those on either side.
                if (block(y0, true, grid.height) > block(y1, false, grid.height)) {
                    EXPECT_LE(own->first.first_row(), block(y1, false, grid.height));
                    EXPECT_GE(own->first.last_row(), block(y0, true, grid.height));
                }
            }
            grid.keeps_thin = false;
            std::vector<std::uint32_t> expected, found;
            for (const auto& [t, key] : all) {
                if (key != tile_key(0, thin)) expected.push_back(t.triangle);
            }
            for (const auto& [t, key] : cull()) found.push_back(t.triangle);
            EXPECT_EQ(found, expected);
        }
    }
    EXPECT_GT(thin_count, 500u);
}

}  // namespace
}  // namespace burin
