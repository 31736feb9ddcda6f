#include "lines/circle_finder.h"

#include <gtest/gtest.h>

namespace burin {
namespace {

/// The states 0, 1, 2 ... tail + length - 1, and from then on those from `tail` on again and again: at which call a
/// circle is found, or `calls` if it is not.
std::uint64_t found_at(std::uint64_t tail, std::uint64_t length, std::uint64_t calls) {
    CircleFinder<std::uint64_t> circle;
    for (std::uint64_t i = 0; i < calls; ++i) {
        const std::uint64_t state = i < tail ? i : tail + (i - tail) % length;
        if (circle.is_closed_by(state)) return i;
    }
    return calls;
}

TEST(CircleFinder, FindsEveryCircleSoon) {
    for (std::uint64_t tail = 0; tail < 100; ++tail) {
        for (std::uint64_t length = 1; length < 100; ++length) {
            EXPECT_LE(found_at(tail, length, 10000), 8 + 4 * (tail + length)) << tail << " " << length;
        }
    }
}

TEST(CircleFinder, FindsNoneWhereNothingComesAgain) { EXPECT_EQ(found_at(0, 100000, 100000), 100000u); }

TEST(CircleFinder, FindsNoneBeforeItIsClosed) {
    for (std::uint64_t tail = 0; tail < 50; ++tail) {
        for (std::uint64_t length = 1; length < 50; ++length) EXPECT_GE(found_at(tail, length, 10000), tail + length);
    }
}

}  // namespace
}  // namespace burin
