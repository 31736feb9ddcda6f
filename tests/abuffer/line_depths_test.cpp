#include "abuffer/hiding/line_depths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <set>
#include <vector>

#include "tests/support/kernels.h"
#include "tests/support/random.h"

namespace burin::line_depths_test {
namespace {

using namespace test;

TEST(LineDepths, TellWhereALineMayBeHidden) {
    int visited = 0, left_out = 0;
    for (std::uint64_t trial = 0; trial < 60; ++trial) {
        Random random(trial);
        const PixelTiles all({-32, 0, 160, 96}, 32);
        const PixelTiles tiles = trial % 2 == 0 ? all : all.only({1, 3});
        std::vector<WholeLine> lines(static_cast<std::size_t>(random.integer(1, 12)));
        const double reach = std::pow(2.0, random.integer(0, 8));
        for (WholeLine& l : lines) {
            l.from = glm::dvec2(random.real(-60, 190), random.real(-30, 130)) * 256.0;
            l.to = l.from + glm::dvec2(random.real(-reach, reach), random.real(-reach, reach)) * 256.0;
            if (random.integer(0, 5) == 0) l.to.y = l.from.y;
            l.nearness_from = random.real(0, 1);
            l.nearness_to = random.real(0, 1);
        }
        const LineDepths depths(lines, tiles, [](const WholeLine&) { return 0.0; });
        for (int box = 0; box < 200; ++box) {
            const glm::ivec2 low(random.integer(-60 * 256, 190 * 256), random.integer(-30 * 256, 130 * 256));
            const glm::ivec2 high = low + glm::ivec2(random.integer(0, 2000), random.integer(0, 2000));
            const auto highest = static_cast<float>(random.real(0, 1));
            std::set<std::uint32_t> found;
            depths.for_tiles(low, high, highest, [&](std::uint32_t tile) { EXPECT_TRUE(found.insert(tile).second); });
            std::set<std::uint32_t> touched;
            tiles.visit(low, high, [&](std::uint32_t tile) { touched.insert(tile); });
            // What is near in depth and closer than a block's width must be visited or may be; all else must not.
            for (const std::uint32_t tile : touched) {
                const PixelRect r = tiles.tile(tile);
                bool must = false, may = false;
                for (const WholeLine& l : lines) {
                    if (!(static_cast<double>(highest) > std::min(l.nearness_from, l.nearness_to) - 1e-6)) continue;
                    for (int step = 0; step <= 4000; ++step) {
                        const glm::dvec2 p = glm::mix(l.from, l.to, step / 4000.0);
                        const glm::dvec2 beside =
                            glm::max(glm::max(glm::dvec2(low) - p, p - glm::dvec2(high)), glm::dvec2(0.0));
                        const glm::dvec2 tile_low = glm::dvec2(r.x0, r.y0) * 256.0,
                                         tile_high = glm::dvec2(r.x1, r.y1) * 256.0;
                        const bool is_in_tile =
                            p.x >= tile_low.x && p.y >= tile_low.y && p.x < tile_high.x && p.y < tile_high.y;
                        must = must || (is_in_tile && beside == glm::dvec2(0.0) &&
                                        static_cast<double>(highest) > std::min(l.nearness_from, l.nearness_to) + 1e-6);
                        may = may || std::max(beside.x, beside.y) < 1024 + 600;
                    }
                }
                if (must) {
                    EXPECT_TRUE(found.contains(tile)) << "trial " << trial;
                }
                // Lines from beside the picture may be noted along its border, which is not checked here.
                const bool is_inner = r.x0 > -32 && r.x1 < 160 && r.y0 > 0 && r.y1 < 96;
                if (!may && is_inner) {
                    EXPECT_FALSE(found.contains(tile)) << "trial " << trial;
                }
                visited += must;
                left_out += !found.contains(tile);
            }
        }
    }
    EXPECT_GT(visited, 100);
    EXPECT_GT(left_out, 200);
}

/// The kernel finds what for_tiles() finds of small triangles, in the same tiles, and leaves out none of the others.
TEST(LineDepths, KernelsFindWhatMayHideALine) {
    std::size_t found_count = 0, left_out = 0, in_one_tile = 0, in_several_tiles = 0;
    for (std::uint64_t trial = 0; trial < 300; ++trial) {
        Random random(trial);
        const PixelTiles all({-32, 0, 160, 96}, 32);
        const PixelTiles tiles = trial % 2 == 0 ? all : all.only({1, 3});
        std::vector<WholeLine> lines(static_cast<std::size_t>(random.integer(1, 12)));
        for (WholeLine& l : lines) {
            l.from = glm::dvec2(random.real(-60, 190), random.real(-30, 130)) * 256.0;
            l.to = l.from + glm::dvec2(random.real(-40, 40), random.real(-40, 40)) * 256.0;
            l.nearness_from = l.nearness_to = random.real(0, 1);
        }
        const LineDepths depths(lines, tiles, [](const WholeLine&) { return 0.0; });
        std::vector<ScreenVertex> vertices;
        std::vector<std::uint32_t> corners;
        const auto count = static_cast<std::uint32_t>(random.integer(1, 300));
        for (std::uint32_t t = 0; t < count; ++t) {
            int x = random.integer(-60 * 256, 190 * 256), y = random.integer(-30 * 256, 130 * 256);
            if (random.integer(0, 2) == 0) x = random.integer(-1, 5) * 32 * 256;  // where tiles meet
            if (random.integer(0, 2) == 0) y = random.integer(0, 3) * 32 * 256;
            const int size = 1 << random.integer(2, 11);
            for (int k = 0; k < 3; ++k) {
                corners.push_back(static_cast<std::uint32_t>(vertices.size()));
                vertices.push_back({x + random.integer(-size, size), y + random.integer(-size, size),
                                    static_cast<float>(random.real(0, 1))});
            }
            if (random.integer(0, 20) == 0) vertices.back().x = ScreenVertex::kOffScreen;
        }
        ScreenMesh mesh;
        mesh.vertices = vertices.data();
        mesh.corners = corners.data();
        const auto begin = static_cast<std::uint32_t>(random.integer(0, static_cast<int>(count) - 1));
        std::vector<std::vector<std::uint32_t>> found, of_tile;
        for (const TileKernels* kernels : all_kernels()) {
            found.emplace_back(4 * (count - begin) + kRoomBehindCulled);
            of_tile.emplace_back(4 * (count - begin) + kRoomBehindCulled);
            const std::size_t n = kernels->hide.find_in_front(mesh, begin, count, depths.grid(), found.back().data(),
                                                              of_tile.back().data());
            found.back().resize(n);
            of_tile.back().resize(n);
            EXPECT_EQ(found.back(), found[0]) << kernels->name << " trial " << trial;
            EXPECT_EQ(of_tile.back(), of_tile[0]) << kernels->name << " trial " << trial;
        }
        for (std::uint32_t t = begin; t < count; ++t) {
            const ScreenVertex &a = vertices[3 * t], &b = vertices[3 * t + 1], &c = vertices[3 * t + 2];
            std::set<std::uint32_t> tiles_found, must;
            for (std::size_t i = 0; i < found[0].size(); ++i) {
                if (found[0][i] == t) {
                    EXPECT_TRUE(tiles_found.insert(of_tile[0][i]).second) << "trial " << trial << " triangle " << t;
                }
            }
            const bool is_found = !tiles_found.empty(),
                       needs_look = tiles_found == std::set<std::uint32_t>{kSeveralTiles};
            if (c.x == ScreenVertex::kOffScreen) {
                EXPECT_TRUE(needs_look) << "trial " << trial;
                continue;
            }
            const glm::ivec2 low(std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})),
                high(std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}));
            depths.for_tiles(low, high, std::max({a.nearness, b.nearness, c.nearness}),
                             [&](std::uint32_t tile) { must.insert(tile); });
            // What lies above or below the rows may be found in their border.
            const PixelRect rows = tiles.rect();
            const bool is_beside = high.y < rows.y0 * 256 || low.y >= rows.y1 * 256;
            if (!needs_look && !is_beside) {
                EXPECT_EQ(tiles_found, must) << "trial " << trial << " triangle " << t;
            }
            if (!needs_look) {
                EXPECT_TRUE(std::includes(tiles_found.begin(), tiles_found.end(), must.begin(), must.end()));
            }
            const bool is_small = high.x - low.x <= 1024 && high.y - low.y <= 1024;  // in two by two blocks at most
            if (is_small) {
                EXPECT_FALSE(needs_look) << "trial " << trial << " triangle " << t;
            }
            in_one_tile += tiles_found.size() == 1 && !needs_look;
            in_several_tiles += tiles_found.size() > 1;
            found_count += is_found;
            left_out += !is_found;
        }
    }
    EXPECT_GT(found_count, 500u);
    EXPECT_GT(left_out, 500u);
    EXPECT_GT(in_one_tile, 200u);
    EXPECT_GT(in_several_tiles, 50u);
}

}  // namespace
}  // namespace burin::line_depths_test
