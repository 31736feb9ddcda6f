#include "compare/run_program.h"

#include <gtest/gtest.h>

#include <chrono>

#include "base/error.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

std::string run_error(const std::string& path, const std::vector<std::string>& arguments, double time_limit_s) {
    const test::TemporaryFolder folder;
    try {
        run_program(path, arguments, folder.file("log"), time_limit_s);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(RunProgram, GivesArgumentsAsTheyAreAndKeepsWhatIsPrinted) {
    const test::TemporaryFolder folder;
    const std::string odd = "$HOME `id` \"a\" 'b' * ; > x\n&";
    run_program("/bin/echo", {odd}, folder.file("log"), 60);
    EXPECT_EQ(test::read_file(folder.file("log")), odd + "\n");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"log"});
}

TEST(RunProgram, SaysWhyAProgramFailed) {
    EXPECT_EQ(run_error("/bin/sh", {"-c", "echo first; echo second >&2; exit 3"}, 60),
              "/bin/sh: failed with exit status 3: first second");
    EXPECT_EQ(run_error("/bin/sh", {"-c", "kill -KILL $$"}, 60), "/bin/sh: was killed by signal 9");
    EXPECT_NE(run_error("/nowhere/magic", {}, 60).find("/nowhere/magic"), std::string::npos);
}

TEST(RunProgram, StopsAProgramThatTakesTooLong) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(run_error("/bin/sleep", {"1000"}, 0.05), "/bin/sleep: took longer than 1 s and was stopped");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(500));  // it was not waited for
}

TEST(RunProgram, FindsWhatIsOnThePath) {
    EXPECT_NE(find_program("sh"), "");
    EXPECT_EQ(find_program("no-program-of-this-name"), "");
}

}  // namespace
}  // namespace burin
