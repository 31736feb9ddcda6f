#include "abuffer/fine/fine_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "abuffer/edges/occluder.h"
#include "tests/support/drawing.h"
#include "tests/support/polygon_rect.h"
#include "tests/support/random.h"

namespace burin::fine_blocks_test {
namespace {

using namespace test;

constexpr int kWidth = 144, kHeight = 120;

/// Triangles of all sizes, some without room for a sample, some behind the eye.
PolygonSoup random_triangles(Random& random, int count) {
    PolygonSoup soup;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 place = random.in_box(2.5) * glm::dvec3(1, 1, i % 10 == 0 ? 3 : 0.5);
        const bool is_thin = i % 2 == 0;  // and along a row or column of samples
        const glm::dvec3 axis = i % 4 == 0 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 along = (is_thin ? axis : random.direction()) * random.real(0.01, i % 7 == 0 ? 4 : 0.3);
        const glm::dvec3 across = random.direction() * random.real(0.001, is_thin ? 0.004 : 0.3);
        for (const glm::dvec3& p : {place, place + along, place + 0.5 * along + across}) {
            soup.corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
            soup.positions.push_back(p);
        }
    }
    return soup;
}

struct Box {
    glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
    void reach(glm::dvec2 p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    bool touches(const Box& b) const {
        return low.x <= b.high.x && high.x >= b.low.x && low.y <= b.high.y && high.y >= b.low.y;
    }
};

/// What a triangle covers, in 1/256 pixel, and its greatest nearness.
struct Cover {
    Box box;
    ScreenPolygon polygon;
    double nearest;
};
Cover cover_of(const ScreenSurfaces& screen, SurfaceId s) {
    Cover cover{{}, {}, -std::numeric_limits<double>::infinity()};
    if (screen.facing(screen.number_of(s)) == off_screen) {
        cover.polygon = screen.surfaces().screen_polygon(s);
        for (int i = 0; i < cover.polygon.count; ++i) {
            const SubpixelPoint p = cover.polygon.corners[static_cast<std::size_t>(i)];
            cover.box.reach({p.x, p.y});
            cover.nearest = std::numeric_limits<double>::infinity();
        }
        return cover;
    }
    for (const ScreenVertex& v : screen.triangle(s).corners) {
        cover.box.reach({v.x, v.y});
        cover.polygon.corners[static_cast<std::size_t>(cover.polygon.count++)] = {v.x, v.y};
        cover.nearest = std::max(cover.nearest, static_cast<double>(v.nearness));
    }
    return cover;
}

/// Every triangle in front of a candidate is in its block's list, once, seen or not.
TEST(FineBlocks, HaveAllThatMayHideTheirCandidates) {
    std::size_t hiding = 0, thin_ones = 0, large_beside_borders = 0;
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        Random random(seed);
        const Scene scene = scene_of({random_triangles(random, 300), random_triangles(random, 50)});
        const Frame frame =
            make_frame(scene, perspective_camera({0, 0, 4}, {0, 0, 0}), kWidth, kHeight, {0, 0, kWidth, kHeight});
        const int per_pixel = 2 << seed % 2, tile_samples = 32 << seed % 3;
        ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
        constexpr bool kKeepsThin = true;
        const TriangleBins bins(screen, frame.crop, per_pixel, best_kernels(), 1, tile_samples, kKeepsThin);
        FineBlocks blocks(screen, bins, best_kernels(), per_pixel);
        const SampleBlocks grid(per_pixel);
        std::set<std::uint32_t> large_ones;
        for (std::uint32_t i = 0; i < bins.large_count(); ++i)
            large_ones.insert(screen.number_of(bins.large(i).surface));
        // What is beside a border may lie in the tiles around.
        const bool has_borders = seed % 4 >= 2;
        for (std::size_t tile = 0; tile < bins.tile_count(); ++tile) {
            const PixelRect rect = bins.tile(tile);
            std::vector<FineCandidate> candidates(12);
            for (FineCandidate& c : candidates) {
                c.part.block_x = random.integer(rect.x0 / kMergeBlockPx, rect.x1 / kMergeBlockPx - 1);
                c.part.block_y = random.integer(rect.y0 / kMergeBlockPx, rect.y1 / kMergeBlockPx - 1);
                const glm::dvec2 corner(grid.begin(c.part.block_x), grid.begin(c.part.block_y));
                const double size = 256.0 * kMergeBlockPx;
                c.line.from = corner + (size - 1) * glm::dvec2(random.real(0, 1), random.real(0, 1));
                c.line.to = glm::clamp(c.line.from + 300.0 * glm::dvec2(random.real(-1, 1), random.real(-1, 1)), corner,
                                       corner + size - 1.0);  // blocks are half open
                c.line.nearness_from = random.real(-0.1, 0.3);
                c.line.nearness_to = c.line.nearness_from + random.real(-0.01, 0.01);
                if (has_borders) c.line.classes = LineClass::border;
                c.part.begin = 0;
                c.part.end = 1;
            }
            blocks.fill(tile, candidates);
            std::vector<std::size_t> block_of(candidates.size(), blocks.count());
            for (std::size_t b = 0; b < blocks.count(); ++b) {
                for (const std::uint32_t i : blocks.candidates(b)) block_of[i] = b;
            }
            for (std::uint32_t n = 0; n < screen.triangle_count(); ++n) {
                if (screen.facing(n) == edge_on) continue;
                const Cover cover = cover_of(screen, screen.surface_of(n));
                for (std::size_t i = 0; i < candidates.size(); ++i) {
                    const WholeLine& line = candidates[i].line;
                    Box box;
                    box.reach(line.from);
                    box.reach(line.to);
                    if (!box.touches(cover.box) || !touches(cover.polygon, box.low, box.high) ||
                        cover.nearest <= std::min(line.nearness_from, line.nearness_to))
                        continue;
                    ASSERT_LT(block_of[i], blocks.count());
                    const std::vector<CrossedTriangle>& listed = blocks.triangles(block_of[i]);
                    const auto count = std::count_if(listed.begin(), listed.end(),
                                                     [n](const CrossedTriangle& t) { return t.number == n; });
                    ASSERT_GE(count, 1) << "seed " << seed << " tile " << tile << " triangle " << n;
                    if (!has_borders || large_ones.count(n) > 0) {
                        ASSERT_EQ(count, 1) << "seed " << seed << " tile " << tile << " triangle " << n;
                        large_beside_borders += has_borders ? 1 : 0;
                    }
                    ++hiding;
                    const double pitch = 256.0 / per_pixel;
                    const glm::dvec2 low = glm::ceil(cover.box.low / pitch - 0.5),
                                     high = glm::floor(cover.box.high / pitch - 0.5);
                    thin_ones += low.x > high.x || low.y > high.y ? 1 : 0;
                }
            }
        }
    }
    EXPECT_GT(hiding, 1000u);
    EXPECT_GT(thin_ones, 100u);
    EXPECT_GT(large_beside_borders, 100u);
}

}  // namespace
}  // namespace burin::fine_blocks_test
