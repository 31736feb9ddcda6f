#include <gtest/gtest.h>

#include "tests/burin/library_caller.h"
#include "tests/cli/program.h"
#include "tests/support/random.h"

namespace burin::test::random_calls_test {
namespace {

constexpr int kScenes = kSanitized ? 10 : 100, kCallsPerScene = 1000;

struct RandomChoices : Random {
    using Random::Random;
    void fail(const std::string& text) { ADD_FAILURE() << text; }
};

TEST(RandomCalls, NeverCrashAndTellWhyTheyFail) {
    int pictures = 0;
    for (int seed = 0; seed < kScenes; ++seed) {
        SCOPED_TRACE(seed);
        RandomChoices choices(static_cast<std::uint64_t>(seed));
        LibraryCaller caller(choices);
        for (int i = 0; i < kCallsPerScene && !HasFailure(); ++i) caller.call();
        pictures += caller.pictures();
    }
    EXPECT_GT(pictures, kScenes * kCallsPerScene / 50);  // not all are refused
}

}  // namespace
}  // namespace burin::test::random_calls_test
