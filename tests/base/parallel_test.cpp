#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace burin {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnce) {
    for (const int threads : {1, 2, 3, 8}) {
        std::vector<std::atomic<int>> visits(1000);
        parallel_for(visits.size(), threads, [&](std::size_t i, int worker) {
            EXPECT_GE(worker, 0);
            EXPECT_LT(worker, threads);
            ++visits[i];
        });
        for (const auto& v : visits) EXPECT_EQ(v, 1);
    }
}

TEST(ParallelFor, PassesTheFirstExceptionOn) {
    std::atomic<int> calls{0};
    EXPECT_THROW(parallel_for(100000, 4, [&](std::size_t i, int) {
                     ++calls;
                     if (i == 10) throw std::runtime_error("stop");
                 }),
                 std::runtime_error);
    EXPECT_LT(calls, 100000);
}

TEST(ParallelFor, NothingToDo) {
    parallel_for(0, 4, [](std::size_t, int) { FAIL(); });
}

TEST(ParallelForEach, VisitsEveryIndexOnce) {
    constexpr std::size_t kChunk = 1 << 14;
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, kChunk - 1, kChunk, kChunk + 1, 5 * kChunk + 77}) {
        for (const int threads : {1, 3}) {
            std::vector<std::atomic<int>> visits(count);
            parallel_for_each(count, threads, [&](std::size_t i) { ++visits.at(i); });
            for (const auto& v : visits) ASSERT_EQ(v, 1) << count << " indices, " << threads << " threads";
        }
    }
}

}  // namespace
}  // namespace burin
