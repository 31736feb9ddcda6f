#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "kernels/mesh_walks.h"
#include "kernels/tile_kernels.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

/// A few triangles, some of them edge-on, and walks that end anywhere on them.
struct Walked {
    explicit Walked(Random& random) : walks(new MeshWalks) {
        const int vertex_count = random.integer(3, 40), triangle_count = random.integer(1, 40);
        const int size = 1 << random.integer(1, 16);
        for (int i = 0; i < vertex_count; ++i) {
            vertices.push_back(
                {random.integer(-size, size), random.integer(-size, size), static_cast<float>(random.real(0, 1))});
        }
        for (int i = 0; i < 3 * triangle_count; ++i) {
            corners.push_back(static_cast<std::uint32_t>(random.integer(0, vertex_count - 1)));
            partners.push_back(static_cast<std::uint32_t>(random.integer(0, 3 * triangle_count - 1)));
        }
        for (int i = 0; i < triangle_count; ++i)
            sharp.push_back(static_cast<std::uint8_t>(random.integer(0, 3) == 0 ? random.integer(0, 15) : 0));
        mesh.vertices = vertices.data();
        mesh.corners = corners.data();
        mesh.partners = partners.data();
        mesh.sharp = sharp.data();
        mesh.triangle_count = static_cast<std::uint32_t>(triangle_count);
        constexpr int kMost = MeshWalks::kMost;
        for (int i = 0; i < kMost; ++i) {
            walks->across[i] = random.integer(-size, size);
            walks->origin[i] = random.integer(-size, size);
            walks->down[i] = random.integer(0, 1) == 0 ? 0u : ~0u;
            walks->backwards[i] = random.integer(0, 1) == 0 ? 0u : ~0u;
        }
        const int steps = random.integer(1, 900);
        for (int i = 0; i < steps; ++i) {
            walks->exit[i] = static_cast<std::uint32_t>(random.integer(0, 3 * triangle_count - 1));
            walks->left[i] = random.real(-0.5, 1.5);
        }
        walks->ended_count = static_cast<std::size_t>(random.integer(0, kMost));
        for (std::size_t i = 0; i < walks->ended_count; ++i) {
            walks->ended[i] = static_cast<std::uint32_t>(random.integer(0, kMost - 1));
            walks->how[i] = static_cast<std::uint32_t>(random.integer(0, 3));
            walks->end_step[i] = static_cast<std::uint32_t>(random.integer(0, steps - 1));
        }
    }

    std::vector<ScreenVertex> vertices;
    std::vector<std::uint32_t> corners, partners;
    std::vector<std::uint8_t> sharp;
    ScreenMesh mesh{};
    std::unique_ptr<MeshWalks> walks;
};

/// To the bit as written down here, one walk after the other.
TEST(OutlineKernels, FindWhereWalksLeaveSurfaces) {
    const auto found = std::make_unique<WalkOutlines>();
    std::size_t outlines = 0, level = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const Walked given(random);
        const MeshWalks& walks = *given.walks;
        const std::int32_t pitch = 32 << random.integer(0, 2);
        const double farthest = random.real(0, 1);
        for (const TileKernels* kernels : all_kernels()) {
            kernels->walk.find_outlines(given.mesh, walks, pitch, farthest, *found);
            std::size_t at = 0;
            for (std::size_t i = 0; i < walks.ended_count; ++i) {
                const std::uint32_t exit = walks.exit[walks.end_step[i]], t = exit / 3, w = walks.ended[i];
                if ((walks.how[i] & MeshWalks::kFolds) == 0 || (given.sharp[t] >> exit % 3 & 1) != 0) continue;
                ASSERT_LT(at, found->count) << kernels->name << ", seed " << seed;
                const auto corner = [&](std::uint32_t k) { return given.vertices[given.corners[3 * t + k % 3]]; };
                const ScreenVertex a = corner(0), b = corner(1), c = corner(2), from = corner(exit),
                                   to = corner(exit % 3 + 1);
                const bool backwards = walks.backwards[w] != 0, down = walks.down[w] != 0;
                const double left = walks.left[walks.end_step[i]], fraction = backwards ? 1 - left : left;
                const double along = walks.origin[w] - (backwards ? pitch : 0) + fraction * pitch;
                const double x = down ? walks.across[w] : along, y = down ? along : walks.across[w];
                const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - a.x, vy = c.y - a.y, area = ux * vy - uy * vx;
                const double qa = static_cast<double>(a.nearness), qb = static_cast<double>(b.nearness) - qa,
                             qc = static_cast<double>(c.nearness) - qa;
                const double low = std::min({0.0, qb, qc}), high = std::max({0.0, qb, qc}), px = x - a.x, py = y - a.y;
                const double q =
                    area == 0 ? high
                              : std::clamp(((px * vy - py * vx) * qb + (ux * py - uy * px) * qc) / area, low, high);
                EXPECT_EQ(found->walk[at], w) << kernels->name << ", seed " << seed;
                EXPECT_EQ(found->exit[at], exit);
                EXPECT_EQ(found->partner[at], given.partners[exit]);
                EXPECT_EQ(found->from_x[at], from.x);
                EXPECT_EQ(found->from_y[at], from.y);
                EXPECT_EQ(found->to_x[at], to.x);
                EXPECT_EQ(found->to_y[at], to.y);
                EXPECT_EQ(found->fraction[at], fraction);
                EXPECT_EQ(found->nearness[at], farthest + qa + q) << kernels->name << ", seed " << seed;
                level += area == 0 ? 1 : 0;
                ++at;
            }
            ASSERT_EQ(found->count, at) << kernels->name << ", seed " << seed;
            outlines += at;
        }
    }
    EXPECT_GT(outlines, 10000u);
    EXPECT_GT(level, 100u);
}

/// Eight walks are taken at once. Where the first walk takes no step at all, what stands as its exit is none of the
/// mesh, and must not be looked up for lanes that have no walk.
TEST(OutlineKernels, LanesWithoutAWalkReadNothingOfTheFirst) {
    const auto found = std::make_unique<WalkOutlines>();
    std::size_t outlines = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        Random random(seed);
        Walked given(random);
        MeshWalks& walks = *given.walks;
        walks.ended_count = seed % 8;
        const auto exits = static_cast<int>(given.corners.size());
        for (std::size_t i = 0; i < walks.ended_count; ++i) {
            walks.end_step[i] = static_cast<std::uint32_t>(i + 1);
            walks.exit[i + 1] = static_cast<std::uint32_t>(random.integer(0, exits - 1));
            walks.left[i + 1] = 0.5;
        }
        for (const TileKernels* kernels : all_kernels()) {
            walks.exit[0] = 0;
            kernels->walk.find_outlines(given.mesh, walks, 32, 0, *found);
            const std::size_t count = found->count;
            walks.exit[0] = 0xF0000000u;
            kernels->walk.find_outlines(given.mesh, walks, 32, 0, *found);
            EXPECT_EQ(found->count, count) << kernels->name << ", seed " << seed;
            outlines += count;
        }
    }
    EXPECT_GT(outlines, 100u);
}

}  // namespace
}  // namespace burin
