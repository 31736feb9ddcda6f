#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/parallel.h"
#include "base/progress.h"

namespace burin {
namespace {

TEST(StopScope, AThreadLooksAtItsOwnFlag) {
    StopFlag outer{false}, inner{false};
    EXPECT_FALSE(interrupt_requested());
    {
        const StopScope scope(outer);
        {
            const StopScope nested(inner);
            inner = true;
            EXPECT_THROW(throw_if_interrupted(), Interrupted);
            std::thread([] { EXPECT_FALSE(interrupt_requested()); }).join();
        }
        EXPECT_FALSE(interrupt_requested());
        outer = true;
        EXPECT_TRUE(interrupt_requested());
    }
    EXPECT_FALSE(interrupt_requested());
}

TEST(StopScope, HelpersLookAtTheFlagOfTheirCaller) {
    for (const auto& parallel : {&parallel_for, &parallel_for_parts}) {
        StopFlag flag{false};
        std::atomic<int> done = 0;
        const StopScope scope(flag);
        EXPECT_THROW(parallel(1000, 4,
                              [&](std::size_t, int) {
                                  if (++done == 10) flag = true;
                              }),
                     Interrupted);
        EXPECT_LT(done, 100);
        flag = false;
        parallel(1000, 4, [&](std::size_t, int) { EXPECT_FALSE(interrupt_requested()); });
    }
}

TEST(StopScope, JobsBesideEachOtherAreStoppedOneByOne) {
    // They share helpers, which must not keep what they looked at before.
    StopFlag stopped{true}, free{false};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&, is_stopped = t % 2 == 0] {
            const StopScope scope(is_stopped ? stopped : free);
            for (int i = 0; i < 200; ++i) {
                bool has_thrown = false;
                try {
                    parallel_for(64, 3, [](std::size_t, int) {});
                } catch (const Interrupted&) {
                    has_thrown = true;
                }
                ASSERT_EQ(has_thrown, is_stopped);
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
}

/// A number that asks to stop when it has been written often enough.
struct AskingToStop {
    static inline StopFlag flag{false};
    static inline std::size_t written = 0;
    AskingToStop() = default;
    AskingToStop(const AskingToStop&) = default;
    AskingToStop& operator=(const AskingToStop&) {
        if (++written == 1000) flag = true;
        return *this;
    }
    std::array<char, 64> bytes{};
};

TEST(StopScope, LargeMemoryIsFilledUntilTheFlagIsSet) {
    std::vector<AskingToStop> values(std::size_t{1} << 17);  // 8 MB
    const StopScope scope(AskingToStop::flag);
    EXPECT_THROW(fill_stoppably(values.data(), values.size(), AskingToStop()), Interrupted);
    EXPECT_LE(AskingToStop::written, std::size_t{1} << 15);
    AskingToStop::flag = false;
    AskingToStop::written = 1000;
    fill_stoppably(values.data(), values.size(), AskingToStop());
    EXPECT_EQ(AskingToStop::written, 1000 + values.size());
}

TEST(Progress, IsToldOnTheThreadThatMadeIt) {
    const std::thread::id self = std::this_thread::get_id();
    std::vector<double> told;
    Progress progress([&](double done) {
        EXPECT_EQ(std::this_thread::get_id(), self);
        told.push_back(done);
    });
    constexpr std::size_t kSteps = 60;
    progress.begin("work", 2 * kSteps);
    for (const int threads : {1, 3}) {
        parallel_for(kSteps, threads, [&](std::size_t, int) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            progress.advance();
        });
        ASSERT_FALSE(told.empty());
    }
    for (std::size_t i = 1; i < told.size(); ++i) EXPECT_LE(told[i - 1], told[i]);
    EXPECT_LE(told.back(), 1);
}

}  // namespace
}  // namespace burin
