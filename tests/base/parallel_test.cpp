#include "base/parallel.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace burin {
namespace {

constexpr auto kBoth = {&parallel_for, &parallel_for_parts};

/// Waits until it is true, but not for ever. Returns whether it is.
template <typename Condition>
bool becomes_true(const Condition& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::yield();
    }
    return true;
}

/// Has the workers wait for each other, and returns which threads they are.
std::set<std::thread::id> meet(int workers) {
    std::set<std::thread::id> threads;
    std::mutex noting;
    std::atomic<int> here{0};
    parallel_for(static_cast<std::size_t>(workers), workers, [&](std::size_t, int) {
        {
            const std::lock_guard lock(noting);
            threads.insert(std::this_thread::get_id());
        }
        ++here;
        EXPECT_TRUE(becomes_true([&] { return here == workers; }));
    });
    return threads;
}

TEST(ParallelFor, VisitsEveryIndexOnce) {
    for (const auto& parallel : kBoth) {
        for (const std::size_t count : {0, 1, 7, 8, 1000}) {
            for (const int threads : {1, 2, 3, 8}) {
                std::vector<std::atomic<int>> visits(count);
                parallel(count, threads, [&](std::size_t i, int worker) {
                    EXPECT_GE(worker, 0);
                    EXPECT_LT(worker, threads);
                    ++visits.at(i);
                });
                for (const auto& v : visits) ASSERT_EQ(v, 1) << count << " indices, " << threads << " threads";
            }
        }
    }
}

TEST(ParallelFor, TheFirstExceptionIsPassedOnAndStopsTheOthers) {
    for (const auto& parallel : kBoth) {
        constexpr std::size_t kCount = 2000;
        std::atomic<std::size_t> calls{0};
        const auto work = [&](std::size_t i, int) {
            ++calls;
            if (i == 0) throw std::runtime_error("stop");
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        };
        EXPECT_THROW(parallel(kCount, 4, work), std::runtime_error);
        EXPECT_LT(calls, kCount / 2);
    }
}

TEST(ParallelFor, EachWorkerIsCalledInIncreasingOrder) {
    for (const int threads : {1, 2, 7}) {
        std::vector<std::vector<std::size_t>> indices(static_cast<std::size_t>(threads));
        parallel_for(500, threads,
                     [&](std::size_t i, int worker) { indices[static_cast<std::size_t>(worker)].push_back(i); });
        for (const auto& of_worker : indices) EXPECT_TRUE(std::is_sorted(of_worker.begin(), of_worker.end()));
    }
}

TEST(ParallelFor, AWorkerKeepsNoMoreIndicesThanItSays) {
    std::atomic<std::size_t> others{0};
    parallel_for(1000, 2, [&](std::size_t i, int) {
        if (i >= kMostInARow) ++others;
        EXPECT_TRUE(i != 0 || becomes_true([&] { return others == 1000 - kMostInARow; }));
    });
}

TEST(ParallelFor, WorkersRunAtTheSameTime) { EXPECT_EQ(meet(4).size(), 4u); }

TEST(ParallelFor, HelpersThatSleepAreWoken) {
    for (int again = 0; again < 5; ++again) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        EXPECT_EQ(meet(3).size(), 3u);
    }
}

TEST(ParallelFor, HelpersAreUsedAgain) {
    const std::set<std::thread::id> first = meet(3);
    for (int again = 0; again < 20; ++again) EXPECT_EQ(meet(3), first);
}

TEST(ParallelFor, FewerThreadsDoTheSameWhereThereAreNoMore) {
    pthread_attr_t before, large;
    ASSERT_EQ(pthread_getattr_default_np(&before), 0);
    ASSERT_EQ(pthread_getattr_default_np(&large), 0);
    ASSERT_EQ(pthread_attr_setstacksize(&large, std::size_t{1} << 50),
              0);  // more than can be addressed: none can be started
    ASSERT_EQ(pthread_setattr_default_np(&large), 0);
    constexpr int kThreads = 200;
    for (const auto& parallel : kBoth) {
        std::atomic<int> calls{0};
        std::vector<std::atomic<int>> calls_of(kThreads);
        EXPECT_NO_THROW(parallel(kThreads, kThreads, [&](std::size_t, int worker) {
            ++calls;
            ++calls_of[static_cast<std::size_t>(worker)];
        }));
        EXPECT_EQ(calls, kThreads);
        EXPECT_EQ(calls_of.back(), 0);
    }
    EXPECT_EQ(pthread_setattr_default_np(&before), 0);
    pthread_attr_destroy(&before);
    pthread_attr_destroy(&large);
    EXPECT_EQ(meet(4).size(), 4u);
}

TEST(ParallelFor, IsCalledWithinItselfAndFromSeveralThreads) {
    std::atomic<int> calls{0};
    std::vector<std::thread> callers;
    for (int k = 0; k < 3; ++k) {
        callers.emplace_back([&] {
            for (int again = 0; again < 20; ++again) {
                parallel_for(5, 2,
                             [&](std::size_t, int) { parallel_for_parts(7, 3, [&](std::size_t, int) { ++calls; }); });
            }
        });
    }
    for (std::thread& caller : callers) caller.join();
    EXPECT_EQ(calls, 3 * 20 * 5 * 7);
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

TEST(ParallelForParts, OthersHelpAWorkerThatIsSlowFromItsEnd) {
    constexpr std::size_t kCount = 100;
    std::atomic<std::size_t> others{0};
    std::vector<std::size_t> taken_over;
    parallel_for_parts(kCount, 2, [&](std::size_t i, int worker) {
        if (worker == 1 && i < kCount / 2) taken_over.push_back(i);
        if (i != 0) ++others;
        EXPECT_TRUE(i != 0 || becomes_true([&] { return others == kCount - 1; }));
    });
    EXPECT_FALSE(taken_over.empty());
    EXPECT_TRUE(std::is_sorted(taken_over.rbegin(), taken_over.rend()));
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
