#include "methods/abuffer/line_depths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <set>
#include <vector>

#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

TEST(LineDepths, TellWhereALineMayBeHidden) {
    int visited = 0, left_out = 0;
    for (std::uint64_t trial = 0; trial < 60; ++trial) {
        Random random(trial);
        const PixelTiles all({-32, 0, 160, 96}, 32);
        const PixelTiles tiles = trial % 2 == 0 ? all : all.only({1, 3});
        std::vector<LayerLine> lines(static_cast<std::size_t>(random.integer(1, 12)));
        const double reach = std::pow(2.0, random.integer(0, 8));
        for (LayerLine& l : lines) {
            l.from = glm::dvec2(random.real(-60, 190), random.real(-30, 130)) * 256.0;
            l.to = l.from + glm::dvec2(random.real(-reach, reach), random.real(-reach, reach)) * 256.0;
            if (random.integer(0, 5) == 0) l.to.y = l.from.y;
            l.nearness_from = random.real(0, 1);
            l.nearness_to = random.real(0, 1);
        }
        const LineDepths depths(lines, tiles);
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
                for (const LayerLine& l : lines) {
                    if (!(static_cast<double>(highest) > std::min(l.nearness_from, l.nearness_to) - 1e-6)) continue;
                    for (int step = 0; step <= 4000; ++step) {
                        const glm::dvec2 p = glm::mix(l.from, l.to, step / 4000.0);
                        const glm::dvec2 beside = glm::max(glm::max(glm::dvec2(low) - p, p - glm::dvec2(high)), glm::dvec2(0.0));
                        const glm::dvec2 tile_low = glm::dvec2(r.x0, r.y0) * 256.0, tile_high = glm::dvec2(r.x1, r.y1) * 256.0;
                        const bool is_in_tile = p.x >= tile_low.x && p.y >= tile_low.y && p.x < tile_high.x && p.y < tile_high.y;
                        must = must || (is_in_tile && beside == glm::dvec2(0.0) &&
                                        static_cast<double>(highest) > std::min(l.nearness_from, l.nearness_to) + 1e-6);
                        may = may || std::max(beside.x, beside.y) < 1024 + 600;
                    }
                }
                if (must) { EXPECT_TRUE(found.contains(tile)) << "trial " << trial; }
                // Lines from beside the picture may be noted along its border, which is not checked here.
                const bool is_inner = r.x0 > -32 && r.x1 < 160 && r.y0 > 0 && r.y1 < 96;
                if (!may && is_inner) { EXPECT_FALSE(found.contains(tile)) << "trial " << trial; }
                visited += must;
                left_out += !found.contains(tile);
            }
        }
    }
    EXPECT_GT(visited, 100);
    EXPECT_GT(left_out, 200);
}

}  // namespace
}  // namespace burin
