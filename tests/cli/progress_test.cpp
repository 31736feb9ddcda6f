// Progress for people and for render farms, and being interrupted.

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <regex>
#include <sstream>
#include <thread>

#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::progress_test {
namespace {

using Arguments = std::vector<std::string>;

Arguments render_at(const char* size) {
    return {"render", "cube.obj", "-m", "patel", "-r", size, "-o", "out.exr", "--layers", "lines"};
}
const Arguments kLongEnough = render_at("1200x900");  // to be shown some progress

Arguments operator+(Arguments a, const Arguments& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

TEST(ProgressTest, AlfLinesCountUpToAHundred) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    const Arguments small = render_at("200x150");
    for (const Arguments& arguments : {kLongEnough, render_at("1x1"), small + Arguments{"-q"},
                                       small + Arguments{"-j", "1"}, small + Arguments{"--repeat", "2"}}) {
        const ProgramResult result = run_burin(folder.path(), arguments + Arguments{"--progress", "alf"});
        ASSERT_EQ(result.status, 0) << result.err;
        std::istringstream lines(result.out);
        int last = -1, count = 0;
        for (std::string line; std::getline(lines, line); ++count) {
            std::smatch match;
            ASSERT_TRUE(std::regex_match(line, match, std::regex("ALF_PROGRESS ([0-9]+)%"))) << line;
            EXPECT_GT(std::stoi(match[1]), last);
            last = std::stoi(match[1]);
        }
        EXPECT_EQ(last, 100);
        EXPECT_LE(count, 101);
        EXPECT_EQ(result.err, "");
    }
}

TEST(ProgressTest, ABarOnATerminalOnly) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    EXPECT_EQ(run_burin(folder.path(), kLongEnough).err, "");
    ProgramOptions terminal;
    terminal.stderr_is_terminal = true;
    const ProgramResult shown = run_burin(folder.path(), kLongEnough, terminal);
    EXPECT_EQ(shown.status, 0);
    EXPECT_EQ(shown.out, "");
    EXPECT_TRUE(std::regex_search(shown.err, std::regex("\rrendering +\\[#*\\.*\\] +[0-9]+ %  [0-9]+:[0-9][0-9] left")))
        << shown.err;
    // The bar goes away, and one line stays that says what was written.
    EXPECT_TRUE(std::regex_search(shown.err, std::regex("\r\x1b\\[K[^\r]*out.exr: 1200x900[^\r\n]*\r?\n$")))
        << shown.err;
    EXPECT_EQ(run_burin(folder.path(), kLongEnough + Arguments{"-q"}, terminal).err, "");
}

TEST(ProgressTest, AReaderThatGoesAwayDoesNotSpoilTheFile) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    ASSERT_EQ(run_burin(folder.path(), kLongEnough).status, 0);
    const std::string expected = read_file(folder.file("out.exr"));
    ProgramOptions full;
    full.stdout_file = "/dev/full";
    const ProgramResult result = run_burin(folder.path(), kLongEnough + Arguments{"--progress", "alf"}, full);
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_TRUE(read_file(folder.file("out.exr")) == expected);
    EXPECT_EQ(folder.names().size(), 2u);
}

class Interrupt : public testing::TestWithParam<int> {};

/// Starts a render that takes long, and stops it after a while.
void interrupt(int signal_number, const std::string& output, std::chrono::milliseconds after) {
    const TemporaryFolder folder;
    folder.write("teapot.toml", "[[object]]\nshape = 'teapot'\ntessellation = 150\n");
    folder.write(output, "old");
    Program program(folder.path(), {"render", "teapot.toml", "-r", "6000x5000", "--samples", "8", "-o", output, "-j",
                                    "1", "-q", "--stats", "stats.json", "--progress", "alf"});
    std::this_thread::sleep_for(after);
    const auto start = std::chrono::steady_clock::now();
    program.send(signal_number);
    const ProgramResult result = program.wait();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_EQ(result.status, 130);
    EXPECT_FALSE(result.timed_out);
    EXPECT_LT(seconds, kSanitized ? 30 : 4);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_EQ(result.out.find("100%"), std::string::npos);
    EXPECT_EQ(folder.names(), (std::vector<std::string>{output, "teapot.toml"}));
    EXPECT_EQ(read_file(folder.file(output)), "old");
}

TEST_P(Interrupt, LeavesNothing) {
    using std::chrono::milliseconds;
    // While it loads, and while it draws.
    for (const int after_ms : {300, 600, 1500}) {
        interrupt(GetParam(), "out.exr", milliseconds(after_ms * (kSanitized ? 5 : 1)));
    }
    interrupt(GetParam(), "out.png", milliseconds(kSanitized ? 4000 : 900));
}

INSTANTIATE_TEST_SUITE_P(Signals, Interrupt, testing::Values(SIGINT, SIGTERM));

}  // namespace
}  // namespace burin::test::progress_test
