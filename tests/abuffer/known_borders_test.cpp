#include "abuffer/fine/known_borders.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace burin::known_borders_test {
namespace {

/// A line that says whose it is.
std::vector<WholeLine> lines_for(std::uint32_t instance, HalfEdge h) {
    std::vector<WholeLine> lines(1 + h % 3);
    for (WholeLine& line : lines) line.from = {instance, h};
    return lines;
}

/// Each is found once, and those that are forgotten are found again.
TEST(KnownBorders, LinesAreThoseOfTheBorder) {
    KnownBorders known;
    std::vector<WholeLine> lines;
    int found = 0;
    const auto ask = [&](std::uint32_t instance, HalfEdge h) {
        known.lines_of(instance, h, lines, [&](std::vector<WholeLine>& out) {
            ++found;
            out = lines_for(instance, h);
        });
        ASSERT_EQ(lines.size(), 1 + h % 3);
        for (const WholeLine& line : lines) ASSERT_EQ(line.from, glm::dvec2(instance, h));
    };
    for (HalfEdge h = 0; h < 1000; ++h) ask(2, h);
    EXPECT_EQ(found, 1000);
    for (HalfEdge h = 0; h < 1000; ++h) ask(2, h);
    EXPECT_EQ(found, 1000);
    for (HalfEdge h = 0; h < 300000; ++h) ask(1, h);
    ask(1, 299999);
    EXPECT_EQ(found, 301000);
    ask(1, 0);
    EXPECT_EQ(found, 301001);
}

TEST(KnownBorders, ThreadsFindTheSame) {
    KnownBorders known;
    std::atomic<int> wrong = 0;
    const auto ask_all = [&] {
        std::vector<WholeLine> lines;
        for (HalfEdge h = 0; h < 200000; ++h) {
            known.lines_of(h % 2, h % 150000, lines,
                           [&](std::vector<WholeLine>& out) { out = lines_for(h % 2, h % 150000); });
            wrong += lines.size() != 1 + h % 150000 % 3 || lines[0].from != glm::dvec2(h % 2, h % 150000);
        }
    };
    std::thread other(ask_all);
    ask_all();
    other.join();
    EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace burin::known_borders_test
