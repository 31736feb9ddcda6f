// A module that takes as long to load as a test wants: until the file exists that BURIN_TEST_GO names, or 30 s.

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <thread>

extern "C" int burin_slow_answer() { return 42; }

namespace {

struct Wait {
    Wait() {
        const char* const go = std::getenv("BURIN_TEST_GO");
        std::error_code ignored;
        for (int i = 0; go != nullptr && i < 3000 && !std::filesystem::exists(go, ignored); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
} const g_wait;

}  // namespace
