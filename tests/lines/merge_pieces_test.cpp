#include "lines/merge_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

TEST(MergeSegments, JoinsOnlyWhatContinuesStraightOn) {
    const auto piece = [](glm::dvec2 from, glm::dvec2 to, std::uint64_t key, std::uint32_t block = 0) {
        LinePiece s;
        s.from = from;
        s.to = to;
        s.line.bits = key;
        s.block = block;
        // All with the front above.
        s.front_on_left = from.x < to.x;
        return s;
    };
    std::vector<LinePiece> segments,
        pieces{piece({2, 1}, {1, 0.5}, 1), piece({0, 0}, {1, 0.5}, 1), piece({2, 1}, {3, 1.5}, 1),
               piece({3, 1.5}, {4, 2}, 2), piece({4, 2}, {5, 2}, 2),   piece({5, 2}, {6, 2}, 2, 1)};
    PieceMerger(best_kernels()).merge(pieces, segments);
    ASSERT_EQ(segments.size(), 4u);
    EXPECT_EQ(segments[0].from, glm::dvec2(0, 0));
    EXPECT_EQ(segments[0].to, glm::dvec2(3, 1.5));
}

/// Pieces of ordinary blocks, few and many, are put in order however they come: some begin at one place, or nearly.
TEST(MergeSegments, TheOrderOfPiecesChangesNothing) {
    std::size_t few = 0, many = 0, nearly = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const int row = random.integer(-3, 200), column = random.integer(-3, 200);
        const std::uint32_t block =
            (static_cast<std::uint32_t>(row) & 0xFFFFu) << 16 | (static_cast<std::uint32_t>(column) & 0xFFFFu);
        const glm::dvec2 corner = double{kMergeBlockPx} * glm::dvec2(column, row);
        std::vector<LinePiece> pieces(static_cast<std::size_t>(random.integer(1, 90)));
        const std::uint64_t instance = static_cast<std::uint64_t>(random.integer(0, 5)) << 32;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            LinePiece& s = pieces[i];
            s.from = corner + glm::dvec2(random.real(-1, 9), random.real(-1, 9));
            if (i > 0 && random.integer(0, 2) == 0) {
                s.from.x = pieces[i - 1].from.x + random.integer(-1, 1) * 1e-9;  // no bit of the place tells
                ++nearly;
            }
            s.to = s.from + glm::dvec2(random.real(0, 1), random.real(-1, 1));
            if (i > 0 && random.integer(0, 5) == 0) {  // only where it ends tells
                s.from = pieces[i - 1].from;
                s.to = glm::dvec2(random.integer(0, 1) == 0 ? s.to.x : pieces[i - 1].to.x, s.to.y);
            }
            s.line.bits = (seed % 7 == 0 ? static_cast<std::uint64_t>(random.integer(0, 2)) << 32 : instance) |
                          (random.integer(0, 3) == 0 ? 0xFFFFFFFFu : static_cast<std::uint32_t>(random.integer(0, 4)));
            s.block = block;
        }
        ++(pieces.size() > 64 ? many : few);
        std::vector<LinePiece> shuffled = pieces, merged, other;
        for (std::size_t i = shuffled.size(); i > 1; --i)
            std::swap(shuffled[i - 1], shuffled[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
        PieceMerger(best_kernels()).merge(pieces, merged);
        PieceMerger(best_kernels()).merge(shuffled, other);
        ASSERT_EQ(merged.size(), other.size()) << "seed " << seed;
        for (std::size_t i = 0; i < merged.size(); ++i) {
            const LinePiece &a = merged[i], &b = other[i];
            ASSERT_TRUE(a.line == b.line && a.from == b.from && a.to == b.to) << "seed " << seed << ", piece " << i;
            if (i == 0) continue;
            const LinePiece& before = merged[i - 1];
            ASSERT_TRUE(before.line < a.line || (before.line == a.line && before.from.x <= a.from.x))
                << "seed " << seed << ", piece " << i;
        }
    }
    EXPECT_GT(few, 100u);
    EXPECT_GT(many, 50u);
    EXPECT_GT(nearly, 1000u);
}

/// Merged pieces are found by their block and line, wherever the tile lies.
TEST(MergeSegments, MergedPiecesAreFoundByBlockAndLine) {
    Random random(11);
    PieceMerger merger(best_kernels());
    PieceIndex index;
    for (int round = 0; round < 200; ++round) {
        const auto first_row = static_cast<std::uint32_t>(random.integer(0, 0xFFFF));
        const auto first_column = static_cast<std::uint32_t>(random.integer(0, 0xFFFF));
        std::vector<LinePiece> segments, given(static_cast<std::size_t>(random.integer(0, 300)));
        const int blocks = random.integer(1, 40);
        for (LinePiece& s : given) {  // too far from each other to be merged
            s.from = {random.real(0, 9000), random.real(0, 9000)};
            s.to = {random.real(0, 9000), random.real(0, 9000)};
            s.line.bits = static_cast<std::uint64_t>(random.integer(0, 9));
            s.block = ((first_row + static_cast<std::uint32_t>(random.integer(0, blocks))) & 0xFFFFu) << 16 |
                      ((first_column + static_cast<std::uint32_t>(random.integer(0, blocks))) & 0xFFFFu);
        }
        merger.merge(given, segments);
        ASSERT_EQ(segments.size(), given.size());
        index.set(segments);
        EXPECT_TRUE(index.of_line(static_cast<std::uint32_t>(random.integer(0, 0xFFFF)), LineId{10}).empty());
        for (const LinePiece& any : given) {
            const auto count = [&](const auto& is_it) { return std::count_if(given.begin(), given.end(), is_it); };
            const auto in_block = index.in_block(any.block);
            const auto of_line = index.of_line(any.block, any.line);
            ASSERT_EQ(static_cast<std::ptrdiff_t>(in_block.size()),
                      count([&](const LinePiece& s) { return s.block == any.block; }))
                << round;
            ASSERT_EQ(static_cast<std::ptrdiff_t>(of_line.size()),
                      count([&](const LinePiece& s) { return s.block == any.block && s.line == any.line; }))
                << round;
            for (const LinePiece& s : of_line) ASSERT_TRUE(s.block == any.block && s.line == any.line) << round;
        }
    }
}

}  // namespace
}  // namespace burin
