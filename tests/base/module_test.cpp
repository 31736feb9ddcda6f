#include "base/module.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "base/error.h"
#include "base/interrupt.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

TEST(Module, OneThatIsNotThereIsNamedWithWhatItIsFor) {
    try {
        module_function("burin_none.so", "draw", "draws nothing", "draw something");
        FAIL();
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_EQ(text.find("cannot load burin_none.so, which draws nothing: "), 0u) << text;
        EXPECT_NE(text.find("; keep it beside the burin program, or draw something"), std::string::npos) << text;
    }
}

// The module goes on being loaded, and is there the next time.
TEST(Module, LoadingEndsWhereThisThreadIsAskedToStop) {
    const test::TemporaryFolder folder;
    ::setenv("BURIN_TEST_GO", folder.file("go").c_str(), 1);
    const auto load = [] { return module_function("burin_slow.so", "burin_slow_answer", "is slow", "wait"); };
    StopFlag stop{false};
    {
        const StopScope scope(stop);
        std::thread other([&stop] {
            std::this_thread::sleep_for(std::chrono::milliseconds(30));
            stop = true;
        });
        EXPECT_THROW(load(), Interrupted);
        other.join();
        EXPECT_THROW(load(), Interrupted) << "nor is it begun";
    }
    folder.write("go", "");
    EXPECT_EQ(reinterpret_cast<int (*)()>(load())(), 42);
}

}  // namespace
}  // namespace burin
