#include <gtest/gtest.h>

#include <atomic>
#include <bit>

#include "abuffer/coverage_mask.h"
#include "base/parallel.h"

namespace burin::edge_between_all_pairs_test {
namespace {

// Patel's published functions, operation by operation, as the yardstick. The 16-bit type cuts off
// what is shifted beyond the word, as on his slide.

inline std::uint16_t published_halo(std::uint16_t mask) {
    std::uint16_t m = mask;
    m = static_cast<std::uint16_t>(m | static_cast<std::uint16_t>((mask & 0x7777) << 1));
    m = static_cast<std::uint16_t>(m | static_cast<std::uint16_t>((mask & 0xEEEE) >> 1));
    m = static_cast<std::uint16_t>(m | static_cast<std::uint16_t>(mask << 4));
    m = static_cast<std::uint16_t>(m | static_cast<std::uint16_t>(mask >> 4));
    return static_cast<std::uint16_t>(m ^ mask);
}

inline std::uint16_t published_edge(std::uint16_t front, std::uint16_t back) {
    back = static_cast<std::uint16_t>(back & ~front);
    std::uint16_t halo_front = published_halo(front);
    std::uint16_t halo_back = published_halo(back);
    halo_front = static_cast<std::uint16_t>(halo_front & back);
    halo_back = static_cast<std::uint16_t>(halo_back & front);
    return static_cast<std::uint16_t>(halo_front | halo_back);
}

inline std::uint16_t bit_count(std::uint16_t v) {
    // Spelled out so that it vectorises without a popcount instruction.
    v = static_cast<std::uint16_t>(v - ((v >> 1) & 0x5555));
    v = static_cast<std::uint16_t>((v & 0x3333) + ((v >> 2) & 0x3333));
    v = static_cast<std::uint16_t>((v + (v >> 4)) & 0x0F0F);
    return static_cast<std::uint16_t>((v + (v >> 8)) & 0x1F);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr unsigned kFrontStep = 257;  // instrumented code is some hundred times slower: every 257th front mask
#else
constexpr unsigned kFrontStep = 1;
#endif

TEST(Mask16, EdgeBetweenEqualsThePublishedOneForAllPairs) {
    std::atomic<std::uint64_t> sum_all{0}, sum_inner{0};
    std::atomic<unsigned> first_wrong{0xFFFFFFFFu};
    constexpr std::size_t kFronts = (65536 + kFrontStep - 1) / kFrontStep;
    parallel_for(kFronts, 0, [&](std::size_t index, int) {
        const auto front = static_cast<std::uint16_t>(index * kFrontStep);
        std::uint64_t count = 0, inner = 0;
        std::uint16_t wrong = 0;
        for (unsigned block = 0; block < 65536; block += 1024) {
            std::uint16_t block_count[8] = {}, block_inner[8] = {};
            for (unsigned b = block; b < block + 1024; b += 8) {
                for (unsigned lane = 0; lane < 8; ++lane) {
                    const auto back = static_cast<std::uint16_t>(b + lane);
                    const std::uint16_t ours = edge_between(front, back);
                    const std::uint16_t theirs = published_edge(front, back);
                    wrong = static_cast<std::uint16_t>(wrong | (ours ^ theirs));
                    block_count[lane] = static_cast<std::uint16_t>(block_count[lane] + bit_count(ours));
                    block_inner[lane] = static_cast<std::uint16_t>(block_inner[lane] + bit_count(ours & 0x0660));
                }
            }
            for (unsigned lane = 0; lane < 8; ++lane) {
                count += block_count[lane];
                inner += block_inner[lane];
            }
        }
        if (wrong != 0) first_wrong = front;
        sum_all += count;
        sum_inner += inner;
    });
    EXPECT_EQ(first_wrong, 0xFFFFFFFFu) << "a pair with this front mask differs";
    if (kFrontStep == 1) {
        EXPECT_EQ(sum_all, 34326183936u);
        EXPECT_EQ(sum_inner, 9898557440u);
    }
}

TEST(Mask16, EdgeLiesWithinItsMasksAndVanishesWithoutABorder) {
    for (unsigned m = 0; m < 65536; ++m) {
        const auto mask = static_cast<std::uint16_t>(m);
        ASSERT_EQ(edge_between(mask, mask), 0);
        ASSERT_EQ(edge_between(mask, std::uint16_t{0}), 0);
        ASSERT_EQ(edge_between(std::uint16_t{0}, mask), 0);
        ASSERT_EQ(edge_between(std::uint16_t{0xFFFF}, mask), 0);
        const auto other = static_cast<std::uint16_t>(m * 40503u);
        const std::uint16_t e = edge_between(mask, other);
        ASSERT_EQ(e & ~(mask | other), 0);
        ASSERT_EQ(e, edge_between(mask, static_cast<std::uint16_t>(other & ~mask)));
        const bool touches = (halo(mask) & other & ~mask) != 0;
        ASSERT_EQ(touches, e != 0);
    }
}

}  // namespace
}  // namespace burin::edge_between_all_pairs_test
