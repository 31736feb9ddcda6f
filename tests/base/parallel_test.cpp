#include "base/parallel.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
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

TEST(ParallelFor, EachWorkerIsCalledInIncreasingOrder) {
    for (const int threads : {1, 2, 7}) {
        std::vector<std::vector<std::size_t>> indices(static_cast<std::size_t>(threads));
        parallel_for(500, threads, [&](std::size_t i, int worker) { indices[static_cast<std::size_t>(worker)].push_back(i); });
        for (const auto& of_worker : indices) EXPECT_TRUE(std::is_sorted(of_worker.begin(), of_worker.end()));
    }
}

TEST(ParallelFor, WorkersRunAtTheSameTime) {
    std::atomic<int> here{0};
    parallel_for(4, 4, [&](std::size_t, int) {
        ++here;
        while (here < 4) std::this_thread::yield();
    });
    EXPECT_EQ(here, 4);
}

TEST(ParallelFor, IsCalledWithinItselfAndFromSeveralThreads) {
    std::atomic<int> calls{0};
    std::vector<std::thread> callers;
    for (int k = 0; k < 3; ++k) {
        callers.emplace_back([&] {
            for (int again = 0; again < 20; ++again) {
                parallel_for(5, 2, [&](std::size_t, int) {
                    parallel_for_parts(7, 3, [&](std::size_t, int) { ++calls; });
                });
            }
        });
    }
    for (std::thread& caller : callers) caller.join();
    EXPECT_EQ(calls, 3 * 20 * 5 * 7);
}

TEST(ParallelFor, HelpersThatSleepAreWoken) {
    for (int again = 0; again < 5; ++again) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        std::atomic<int> here{0};
        parallel_for(3, 3, [&](std::size_t, int) {
            ++here;
            while (here < 3) std::this_thread::yield();
        });
        EXPECT_EQ(here, 3);
    }
}

TEST(ParallelFor, WorksInAForkedProcess) {
    parallel_for(4, 4, [](std::size_t, int) {});  // whose helpers a copy of the process has not
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        alarm(20);
        std::atomic<int> calls{0};
        parallel_for(100, 4, [&](std::size_t, int) { ++calls; });
        _exit(calls == 100 ? 0 : 1);
    }
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

TEST(ParallelForParts, VisitsEveryIndexOnce) {
    for (const std::size_t count : {0, 1, 7, 8, 1000}) {
        for (const int threads : {1, 2, 3, 8}) {
            std::vector<std::atomic<int>> visits(count);
            parallel_for_parts(count, threads, [&](std::size_t i, int worker) {
                EXPECT_GE(worker, 0);
                EXPECT_LT(worker, threads);
                ++visits.at(i);
            });
            for (const auto& v : visits) ASSERT_EQ(v, 1) << count << " indices, " << threads << " threads";
        }
    }
}

TEST(ParallelForParts, OthersHelpAWorkerThatIsSlow) {
    std::atomic<int> others{0};
    parallel_for_parts(100, 2, [&](std::size_t i, int) {
        if (i != 0) ++others;
        while (i == 0 && others < 99) std::this_thread::yield();  // ends only if its part is taken over
    });
    EXPECT_EQ(others, 99);
}

TEST(ParallelForParts, PassesTheFirstExceptionOn) {
    std::atomic<int> calls{0};
    EXPECT_THROW(parallel_for_parts(100000, 4, [&](std::size_t i, int) {
                     ++calls;
                     if (i % 25000 == 10) throw std::runtime_error("stop");
                 }),
                 std::runtime_error);
    EXPECT_LT(calls, 100000);
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
