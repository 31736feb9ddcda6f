#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "kernels/tile_kernels.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

/// A list per key has its triangles in their order, and nothing is written farther behind it than allowed.
TEST(SortKernels, TrianglesGoToTheListsOfTheirKeys) {
    std::size_t runs = 0, triangles = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const auto count = static_cast<std::size_t>(random.integer(0, seed % 2 == 0 ? 40 : 700));
        const int key_count = random.integer(1, 30), longest = random.integer(1, 40);
        std::vector<std::uint32_t> keys(count + kRoomBehindCulled, 3), numbers(keys.size()), blocks(keys.size()),
            starts(keys.size());
        std::vector<float> highest(keys.size());
        for (std::size_t i = 0, left = 0; i < count; ++i, --left) {
            if (left == 0) left = static_cast<std::size_t>(random.integer(1, longest));
            keys[i] = i > 0 && left > 1 ? keys[i - 1] : static_cast<std::uint32_t>(random.integer(0, key_count - 1));
            numbers[i] = random.bits();
            blocks[i] = random.bits();
            highest[i] = static_cast<float>(random.real(-1, 1));
        }
        const CulledTriangles culled{keys.data(), numbers.data(), highest.data(), blocks.data(), count, nullptr, 0};
        std::vector<std::uint32_t> expected_starts;
        std::map<std::uint32_t, std::vector<std::size_t>> lists;
        for (std::size_t i = 0; i < count; ++i) {
            if (i == 0 || keys[i] != keys[i - 1]) expected_starts.push_back(static_cast<std::uint32_t>(i));
            lists[keys[i]].push_back(i);
        }
        runs += expected_starts.size();
        triangles += count;
        expected_starts.push_back(static_cast<std::uint32_t>(count));
        for (const TileKernels* kernels : all_kernels()) {
            const std::size_t found = kernels->sort.find_runs(keys.data(), count, starts.data());
            ASSERT_EQ(
                std::vector<std::uint32_t>(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(found) + 1),
                expected_starts)
                << kernels->name << " seed " << seed;
            std::vector<std::uint32_t> next(static_cast<std::size_t>(key_count));
            std::uint32_t room = 0;
            for (const auto& [key, list] : lists) {
                next[key] = room;
                room += static_cast<std::uint32_t>(list.size() + kRoomBehindRun);
            }
            constexpr TileTriangle kUntouched{77, 77, 77};
            std::vector<TileTriangle> sorted(room + 1, kUntouched);
            kernels->sort.put_runs(culled, starts.data(), found, next.data(), sorted.data());
            std::size_t at = 0;
            for (const auto& [key, list] : lists) {
                for (const std::size_t i : list) {
                    ASSERT_EQ(sorted[at].triangle, numbers[i]) << kernels->name << " seed " << seed;
                    ASSERT_EQ(sorted[at].highest, highest[i]) << kernels->name << " seed " << seed;
                    ASSERT_EQ(sorted[at].blocks, blocks[i]) << kernels->name << " seed " << seed;
                    ++at;
                }
                EXPECT_EQ(next[key], at) << kernels->name << " seed " << seed;
                at += kRoomBehindRun;
            }
            EXPECT_EQ(sorted[at].triangle, kUntouched.triangle) << kernels->name << " seed " << seed;
        }
    }
    EXPECT_GT(runs, 3000u);
    EXPECT_GT(triangles, 4 * runs);
}

}  // namespace
}  // namespace burin
