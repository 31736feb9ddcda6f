// TileKernels::Walk::over_mesh() against FastWalker::walk(), which takes one walk after the other.

#include "abuffer/samples/walks_ahead.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "abuffer/samples/surface_tile.h"
#include "mesh/shapes.h"
#include "tests/support/drawing.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"
#include "tests/support/rough_sphere.h"
#include "tests/support/terraces.h"

namespace burin::walks_ahead_test {
namespace {

using namespace test;

constexpr int kWidth = 90, kHeight = 70;

struct Counts {
    int arrived = 0, folded = 0, crossed = 0, stopped = 0, over_slivers = 0;

    void operator+=(const Counts& c) {
        arrived += c.arrived;
        folded += c.folded;
        crossed += c.crossed;
        stopped += c.stopped;
        over_slivers += c.over_slivers;
    }
};

/// Equal to the bit, steps included.
void expect_equal(const FastWalk& ahead, const FastWalk& alone, bool has_steps) {
    EXPECT_EQ(ahead.end, alone.end);
    EXPECT_EQ(ahead.triangle, alone.triangle);
    EXPECT_EQ(ahead.half_edge, alone.half_edge);
    EXPECT_EQ(ahead.fraction, alone.fraction);
    if (!has_steps) return;
    ASSERT_EQ(ahead.step_count, alone.step_count);
    for (int k = 0; k < ahead.step_count; ++k) {
        EXPECT_EQ(ahead.steps[k].triangle, alone.steps[k].triangle);
        EXPECT_EQ(ahead.steps[k].exit, alone.steps[k].exit);
        EXPECT_EQ(ahead.steps[k].entered, alone.steps[k].entered);
        EXPECT_EQ(ahead.steps[k].left, alone.steps[k].left);
    }
}

void expect_equal_classes(const FastWalk& ahead, const FastWalk& alone) {
    EXPECT_EQ(ahead.crossed, alone.crossed);
    EXPECT_EQ(ahead.crease_cosine, alone.crease_cosine);
    if (alone.crossed.empty()) return;
    EXPECT_EQ(ahead.crossed_edge.half_edge, alone.crossed_edge.half_edge);
    EXPECT_EQ(ahead.crossed_fraction, alone.crossed_fraction);
}

bool is_over_sliver(const FastWalk& walk, std::uint32_t instance, const SurfaceSet& surfaces) {
    return std::any_of(walk.steps + 1, walk.steps + walk.step_count, [&](const FastWalk::Step& step) {
        return is_sliver(surfaces, {instance, step.triangle});
    });
}

/// Pairs of a tile that show different triangles.
std::vector<NeighbourSamples> pairs_of(const SurfaceTile& tile, int samples) {
    const std::int32_t pitch = kSubpixelsPerPixel / samples;
    const SampleTile& s = tile.samples();
    std::vector<NeighbourSamples> pairs;
    const auto add = [&](int column, int row, bool down) {
        const std::size_t a = s.index(column, row), b = down ? s.index(column, row + 1) : s.index(column + 1, row);
        if (s.ids[a] >> 1 == s.ids[b] >> 1) return;
        pairs.push_back({column * pitch + pitch / 2,
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
    return pairs;
}

Counts compare(const Scene& scene, const Camera& camera, int samples) {
    const Frame frame = make_frame(scene, camera, kWidth, kHeight, {0, 0, kWidth, kHeight});
    ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
    const TriangleBins bins(screen, frame.crop, samples, best_kernels(), 1);
    SurfaceTile tile(frame, screen, bins, samples, best_kernels());
    FastWalker walker(screen, frame.criteria);
    Counts counts;
    for (const TileKernels* kernels : all_kernels()) {
        SCOPED_TRACE(kernels->name);
        const auto mesh_walks = std::make_unique<MeshWalks>();
        WalksAhead ahead(screen, *kernels, walker, *mesh_walks);
        for (std::size_t t = 0; t < bins.tile_count(); ++t) {
            tile.draw(t);
            const std::vector<NeighbourSamples> pairs = pairs_of(tile, samples);
            for (std::size_t begin = 0; begin < pairs.size(); begin += WalksAhead::kMostPairs) {
                const std::size_t count = std::min(pairs.size() - begin, WalksAhead::kMostPairs);
                ahead.walk({pairs.data() + begin, count});
                for (std::size_t i = 0; i < 2 * count; ++i) {
                    const NeighbourSamples& pair = pairs[begin + i / 2];
                    const FastWalk* const known = ahead.known(i / 2)[i % 2];
                    if (known == nullptr) continue;
                    SCOPED_TRACE(begin + i / 2);
                    FastWalk alone;
                    walker.walk(pair, i % 2 == 1, alone);
                    const SurfaceId other = pair.surfaces[1 - i % 2];
                    const bool is_through = alone.end == FastWalk::arrived &&
                                            SurfaceId{pair.surfaces[i % 2].instance, alone.triangle} == other;
                    const bool has_steps = !other.is_background() && !is_through;
                    expect_equal(*known, alone, has_steps);
                    if (is_through) expect_equal_classes(*known, alone);
                    if (testing::Test::HasFailure()) return counts;
                    ++(alone.end == FastWalk::arrived ? counts.arrived : counts.folded);
                    counts.crossed += is_through && !alone.crossed.empty() ? 1 : 0;
                    counts.stopped += has_steps ? 1 : 0;
                    counts.over_slivers += is_over_sliver(alone, pair.surfaces[i % 2].instance, frame.surfaces) ? 1 : 0;
                }
            }
        }
    }
    return counts;
}

/// Contours, creases, walls and triangles as small as samples, of several meshes.
TEST(WalksAhead, ManyAtOnceAreAsEachAlone) {
    Counts sum;
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        std::vector<PolygonSoup> objects;
        objects.push_back(rough_sphere(random, random.integer(20, 260), random.real(0, 8)));
        objects.push_back(make_torus(0.9, 0.3, random.integer(5, 120), random.integer(5, 90)));
        objects.push_back(make_cylinder(0.6, 0.6, 6, random.integer(10, 400)));
        const glm::dvec3 eye = random.direction() * random.real(2.0, 9.0);
        sum += compare(scene_of(std::move(objects)), perspective_camera(eye, {0, 0, 0}), 1 << random.integer(1, 3));
    }
    EXPECT_GT(sum.arrived, 1000000);
    EXPECT_GT(sum.folded, 50000);
    EXPECT_GT(sum.crossed, 10000);
    EXPECT_GT(sum.stopped, 50000);
}

/// Terraces seen from the front: walls that are edge-on to within snapping, or exactly, where walks turn back and go on
/// in another depth.
TEST(WalksAhead, WallsSeenEdgeOn) {
    Counts sum;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Terraces terraces(random, 1);
        sum += compare(scene_of({std::move(terraces.soup)}), terraces.camera, 1 << random.integer(1, 3));
    }
    EXPECT_GT(sum.folded, 10000);
    EXPECT_GT(sum.arrived, 10000);
}

/// Strips of slivers between strips that lie higher or lower, seen from all sides.
TEST(WalksAhead, SliversOnTheWay) {
    constexpr std::size_t kColumns = 60;
    Counts sum;
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        PolygonSoup strips = make_plane(2.5, 2.5, kColumns, 12);
        const double deep = random.real(0, 0.2), thin = random.real(0, 1e-3);
        std::vector<double> heights;
        for (std::size_t k = 0; k <= kColumns; ++k) heights.push_back(deep * random.real(0, 1));
        for (std::size_t i = 0; i < strips.positions.size(); ++i) {
            const std::size_t column = i % (kColumns + 1), strip = column % 3 == 2 ? column - 1 : column;
            glm::dvec3& p = strips.positions[i];
            p = {p.x, -p.z, heights[strip]};
            if (strip != column) p.x = strips.positions[i - 1].x + thin;
        }
        const glm::dvec3 eye = glm::dvec3(random.real(-3, 3), random.real(-3, 3), 4);
        sum += compare(scene_of({std::move(strips)}), perspective_camera(eye, {0, 0, 0}), 1 << random.integer(1, 3));
    }
    EXPECT_GT(sum.over_slivers, 10000);
    EXPECT_GT(sum.crossed, 10000);
    EXPECT_GT(sum.folded, 1000);
}

/// Edges whose two polygons are wound alike, or that have one.
TEST(WalksAhead, PolygonsTurnedOver) {
    Counts sum;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        PolygonSoup sphere = rough_sphere(random, random.integer(20, 120), 4);
        for (std::size_t i = 0; i < sphere.polygon_count(); ++i) {
            if (random.integer(0, 4) != 0) continue;
            const auto first = sphere.corners.begin() + (sphere.polygon(i).data() - sphere.corners.data());
            std::reverse(first, first + static_cast<std::ptrdiff_t>(sphere.polygon(i).size()));
        }
        sum += compare(scene_of({std::move(sphere)}), perspective_camera(random.direction() * 3.0, {0, 0, 0}), 4);
    }
    EXPECT_GT(sum.folded + sum.arrived, 10000);
}

}  // namespace
}  // namespace burin::walks_ahead_test
