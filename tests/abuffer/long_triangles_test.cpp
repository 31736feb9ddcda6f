// Long triangles are sorted to what they touch, not to all that their boxes touch.

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "abuffer/fine/fine_blocks.h"
#include "abuffer/hiding/occluder_bins.h"
#include "tests/support/drawing.h"
#include "tests/support/kernels.h"
#include "tests/support/polygon_rect.h"
#include "tests/support/random.h"

namespace burin::long_triangles_test {
namespace {

using namespace test;

constexpr int kWidth = 400, kHeight = 300;
/// So far away from a long triangle nothing lists it; short ones may be listed all over their boxes. 1/256 pixel.
constexpr double kBeside = 2 * 256, kAnywhere = 1e9;

/// Long thin triangles in all directions, some of them behind the eye, and a few large ones.
Scene long_triangles(Random& random, int count) {
    PolygonSoup soup;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 from = 1.5 * random.in_box(1) * glm::dvec3(1, 1, i % 8 == 0 ? 4 : 1),
                         along = random.real(1, 4) * random.direction();
        const glm::dvec3 across = random.real(0.005, i % 5 == 0 ? 1 : 0.02) * random.direction();
        for (const glm::dvec3& p : {from, from + along, from + 0.5 * along + across}) {
            soup.corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
            soup.positions.push_back(p);
        }
    }
    return scene_of({soup});
}

ScreenPolygon polygon_of(const ScreenSurfaces& screen, SurfaceId s) {
    if (screen.facing(screen.number_of(s)) == off_screen) return screen.surfaces().screen_polygon(s);
    ScreenPolygon polygon;
    for (const ScreenVertex& v : screen.triangle(s).corners)
        polygon.corners[static_cast<std::size_t>(polygon.count++)] = {v.x, v.y};
    return polygon;
}

/// The lesser one of the extents of its box.
int width_of(const ScreenPolygon& polygon) {
    const auto corners = std::span(polygon.corners).first(static_cast<std::size_t>(polygon.count));
    if (corners.empty()) return 0;
    const auto [x0, x1] = std::minmax_element(corners.begin(), corners.end(), [](auto p, auto q) { return p.x < q.x; });
    const auto [y0, y1] = std::minmax_element(corners.begin(), corners.end(), [](auto p, auto q) { return p.y < q.y; });
    return std::min(x1->x - x0->x, y1->y - y0->y);
}

/// Whether a polygon's box has more than a width or a height in common with a rectangle.
bool covers_more(const ScreenPolygon& polygon, const PixelRect& rect, double size) {
    glm::dvec2 low(1e9), high(-1e9);
    for (int i = 0; i < polygon.count; ++i) {
        const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
        low = glm::min(low, glm::dvec2(p.x, p.y));
        high = glm::max(high, glm::dvec2(p.x, p.y));
    }
    const glm::dvec2 common =
        glm::min(high, glm::dvec2(rect.x1, rect.y1) * 256.0) - glm::max(low, glm::dvec2(rect.x0, rect.y0) * 256.0);
    return std::max(common.x, common.y) > size;
}

struct Counts {
    int listed = 0, left_out = 0;
};

/// What it touches, it is listed in; what it does not come near of its box, it is not.
void expect_listed(const ScreenPolygon& polygon, const PixelRect& rect, double beside, bool is_listed, Counts& counts) {
    const glm::dvec2 low = glm::dvec2(rect.x0, rect.y0) * 256.0, high = glm::dvec2(rect.x1, rect.y1) * 256.0;
    if (touches(polygon, low, high - 1.0)) {  // it is half open
        ASSERT_TRUE(is_listed);
        ++counts.listed;
    } else if (!touches(polygon, low - beside, high + beside)) {
        ASSERT_FALSE(is_listed);
        ++counts.left_out;
    }
}

TEST(LongTriangles, AreInTilesOfLayersThatTheyTouch) {
    Counts counts;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const Scene scene = long_triangles(random, 120);
        const Frame frame =
            make_frame(scene, perspective_camera({0, 0, 4}, {0, 0, 0}), kWidth, kHeight, {0, 0, kWidth, kHeight});
        ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
        const TriangleBins facings(screen, frame.crop, 2, best_kernels(), 1);
        const PixelTiles tiles({0, 0, 416, 320}, 32);
        // Behind all, in each block of 4 x 4 pixels.
        std::vector<WholeLine> lines(80);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const double y = 256.0 * (4.0 * static_cast<double>(i) + 2);
            lines[i].from = {0, y};
            lines[i].to = {416 * 256.0, y};
            lines[i].nearness_from = lines[i].nearness_to = -1e6;
        }
        const LineDepths depths(lines, tiles, [](const WholeLine&) { return 0.0; });
        const OccluderBins bins(screen, best_kernels(), tiles, 1, &depths);
        for (std::uint32_t n = 0; n < screen.triangle_count(); ++n) {
            if (screen.facing(n) == edge_on) continue;
            const ScreenPolygon polygon = polygon_of(screen, screen.surface_of(n));
            const bool is_long = width_of(polygon) > 32 * 256;
            for (std::size_t tile = 0; tile < tiles.count(); ++tile) {
                const PixelRect rect = tiles.tile(tile);
                const bool is_inner = rect.x0 > 0 && rect.y0 > 0 && rect.x1 < 416 && rect.y1 < 320;
                if (!is_inner) continue;  // those at the border stand for what is beyond it
                const auto list = bins.triangles(tile);
                const bool is_listed = std::any_of(list.begin(), list.end(),
                                                   [n](std::uint32_t v) { return (v & ~OccluderBins::kClipped) == n; });
                ASSERT_NO_FATAL_FAILURE(expect_listed(polygon, rect, is_long ? kBeside : kAnywhere, is_listed, counts));
            }
        }
    }
    EXPECT_GT(counts.listed, 2000);
    EXPECT_GT(counts.left_out, 20000);
}

TEST(LongTriangles, AreInBlocksThatTheyTouch) {
    Counts counts;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const Scene scene = long_triangles(random, 60);
        const Frame frame =
            make_frame(scene, perspective_camera({0, 0, 4}, {0, 0, 0}), kWidth, kHeight, {0, 0, kWidth, kHeight});
        const int per_pixel = 2 << seed % 2;
        ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
        constexpr bool kKeepsThin = true;
        const TriangleBins bins(screen, frame.crop, per_pixel, best_kernels(), 1, TileGrid::kTileSamples, kKeepsThin);
        FineBlocks blocks(screen, bins, best_kernels(), per_pixel);
        const SampleBlocks grid(per_pixel);
        for (std::size_t tile = 0; tile < bins.tile_count(); ++tile) {
            // A candidate behind all in each cell of each block.
            std::vector<FineCandidate> candidates;
            const PixelRect rect = bins.tile(tile);
            for (int y = rect.y0 / kMergeBlockPx; y < rect.y1 / kMergeBlockPx; ++y) {
                for (int x = rect.x0 / kMergeBlockPx; x < rect.x1 / kMergeBlockPx; ++x) {
                    FineCandidate c;
                    c.part.block_x = x;
                    c.part.block_y = y;
                    c.line.from = {grid.begin(x), grid.begin(y)};
                    c.line.to = c.line.from + 256.0 * kMergeBlockPx - 1.0;
                    c.line.nearness_from = c.line.nearness_to = -1e6;
                    c.part.begin = 0;
                    c.part.end = 1;
                    candidates.push_back(c);
                }
            }
            if (candidates.empty()) continue;
            blocks.fill(tile, candidates);
            for (std::size_t b = 0; b < blocks.count(); ++b) {
                const FinePart& part = candidates[blocks.candidates(b).front()].part;
                const PixelRect block{part.block_x * kMergeBlockPx, part.block_y * kMergeBlockPx,
                                      (part.block_x + 1) * kMergeBlockPx, (part.block_y + 1) * kMergeBlockPx};
                for (std::uint32_t n = 0; n < screen.triangle_count(); ++n) {
                    if (screen.facing(n) == edge_on) continue;
                    const auto& list = blocks.triangles(b);
                    const bool is_listed =
                        std::any_of(list.begin(), list.end(), [n](const CrossedTriangle& t) { return t.number == n; });
                    const ScreenPolygon polygon = polygon_of(screen, screen.surface_of(n));
                    const auto shifted = [&](ScreenPolygon p) {  // blocks begin half a sample later
                        for (SubpixelPoint& c : p.corners) c = {c.x - grid.half_pitch, c.y - grid.half_pitch};
                        return p;
                    };
                    // Up to two by two blocks of a tile are told by its box.
                    const bool is_long = width_of(polygon) > 3 * 256 * kMergeBlockPx &&
                                         covers_more(polygon, rect, 2.1 * 256 * kMergeBlockPx);
                    ASSERT_NO_FATAL_FAILURE(
                        expect_listed(shifted(polygon), block, is_long ? kBeside : kAnywhere, is_listed, counts));
                }
            }
        }
    }
    EXPECT_GT(counts.listed, 2000);
    EXPECT_GT(counts.left_out, 20000);
}

}  // namespace
}  // namespace burin::long_triangles_test
