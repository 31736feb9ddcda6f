// What is left of a job that ends early: frames that fail, signals, kills.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::stopped_frames_test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

constexpr const char* kScene = R"([picture]
size = [96, 64]
[[camera]]
eye = [3, 2, 5]
target = [0, 0, 0]
[[object]]
shape = "torus"
segments = 24
tube_segments = 12
[[object.key]]
frame = 1
rotate = [0, 0, 0]
[[object.key]]
frame = 6
rotate = [0, 180, 90]
[[object]]
file = "cube.obj"
scale = 0.4
translate = [0, -0.6, 0]
)";

/// A file per frame, and a camera that is fitted to all of them.
constexpr const char* kWalk = R"([picture]
size = [48, 32]
[frames]
range = "1-4"
[[object]]
file = "walk.####.obj"
name = "walk"
)";
constexpr const char* kBroken = "v 0 0\n";
constexpr const char* kWhatIsBroken = ":1: a vertex needs three numbers";

class StoppedFrames : public testing::Test {
  protected:
    StoppedFrames() {
        folder_.write("cube.obj", kCubeObj);
        folder_.write("s.toml", kScene);
    }

    ProgramResult render(Arguments arguments) const {
        arguments.insert(arguments.begin(), "render");
        return run_burin(folder_.path(), arguments);
    }
    std::string content(const std::string& name) const { return read_file(folder_.file(name)); }
    bool is_there(const std::string& name) const { return fs::exists(folder_.file(name)); }
    /// The lines of --stats.
    static std::vector<nlohmann::json> lines(const std::string& text) {
        std::vector<nlohmann::json> all;
        std::istringstream in(text);
        for (std::string line; std::getline(in, line);) all.push_back(nlohmann::json::parse(line));
        return all;
    }
    /// Squares that grow from frame to frame, but for one file that is broken.
    void write_walk(int broken) const {
        folder_.write("walk.toml", kWalk);
        for (int frame = 1; frame <= 4; ++frame) {
            const std::string size = std::to_string(frame);
            folder_.write("walk.000" + std::to_string(frame) + ".obj",
                          frame == broken ? kBroken
                                          : "v 0 0 0\nv " + size + " 0 0\nv " + size + " " + size + " 0\nv 0 " + size +
                                                " 0\nf 1 2 3 4\n");
        }
    }

    TemporaryFolder folder_;
};

std::size_t count_of(const std::string& part, const std::string& text) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST_F(StoppedFrames, AFrameThatFailsEndsTheJobUnlessItGoesOn) {
    fs::create_directory(folder_.file("o.02.exr"));
    ProgramResult result = render({"s.toml", "-f", "1-4", "-o", "o.##.exr"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err, "frame 2: o.02.exr: is a folder; give the name of a file to write\n");
    EXPECT_TRUE(fs::exists(folder_.file("o.01.exr")));
    EXPECT_FALSE(fs::exists(folder_.file("o.04.exr")));
    result = render({"s.toml", "-f", "1-4", "-o", "o.##.exr", "--keep-going", "--stats", "-"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err,
              "frame 2: o.02.exr: is a folder; give the name of a file to write\n1 of 4 frames failed: 2\n");
    const std::vector<nlohmann::json> all = lines(result.out);
    ASSERT_EQ(all.size(), 5u);
    EXPECT_EQ(all[1]["status"], "failed");
    EXPECT_NE(all[1]["error"].get<std::string>().find("folder"), std::string::npos);
    EXPECT_EQ(all[4]["failed"], 1);
    EXPECT_EQ(all[4]["done"], 3);
    EXPECT_TRUE(fs::exists(folder_.file("o.04.exr")));
}

TEST_F(StoppedFrames, SoDoesTheFirstOne) {
    fs::create_directory(folder_.file("o.01.exr"));
    ProgramResult result = render({"s.toml", "-f", "1-3", "-o", "o.##.exr"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err, "frame 1: o.01.exr: is a folder; give the name of a file to write\n");
    EXPECT_FALSE(is_there("o.02.exr"));
    result = render({"s.toml", "-f", "1-3", "-o", "o.##.exr", "--keep-going"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err,
              "frame 1: o.01.exr: is a folder; give the name of a file to write\n1 of 3 frames failed: 1\n");
    EXPECT_TRUE(is_there("o.02.exr") && is_there("o.03.exr"));
}

TEST_F(StoppedFrames, ACameraIsFittedToTheFilesThatCanBeRead) {
    write_walk(3);
    const std::string what = "frame 3: walk.0003.obj" + std::string(kWhatIsBroken);
    for (const std::string frames : {"1-4", "1-2"}) {
        const ProgramResult stopped = render({"walk.toml", "-f", frames, "-o", "o.#.png"});
        EXPECT_EQ(stopped.status, 1);
        EXPECT_TRUE(is_one_line(stopped.err)) << stopped.err;
        EXPECT_EQ(stopped.err.find(what), 0u) << stopped.err;
        EXPECT_FALSE(is_there("o.0001.png"));
    }
    const ProgramResult all = render({"walk.toml", "-f", "1-4", "-o", "o.#.png", "--keep-going"});
    EXPECT_EQ(all.status, 1);
    EXPECT_EQ(all.err.find("burin: note: " + what), 0u) << all.err;
    EXPECT_EQ(count_of("what is fitted is fitted to the other frames\n", all.err), 1u) << all.err;
    EXPECT_NE(all.err.find("\n" + what), std::string::npos) << all.err;
    EXPECT_NE(all.err.find("\n1 of 4 frames failed: 3\n"), std::string::npos) << all.err;
    EXPECT_TRUE(is_there("o.0001.png") && is_there("o.0002.png") && is_there("o.0004.png"));
    EXPECT_FALSE(is_there("o.0003.png"));
    // Which frames are asked for changes none of them.
    const ProgramResult some = render({"walk.toml", "-f", "1-2", "-o", "some.#.png", "--keep-going"});
    EXPECT_EQ(some.status, 0) << some.err;
    EXPECT_EQ(content("some.0002.png"), content("o.0002.png"));
    // Methods with depths in steps fit those, too.
    const ProgramResult steps =
        render({"walk.toml", "-f", "1-4", "-o", "z.#.png", "--keep-going", "--method", "slope-offset", "-q"});
    EXPECT_NE(steps.err.find("1 of 4 frames failed: 3\n"), std::string::npos) << steps.err;
    EXPECT_TRUE(is_there("z.0004.png"));
}

TEST_F(StoppedFrames, TheFirstFileOfASequenceMayBeBroken) {
    write_walk(1);
    const std::string what = "frame 1: walk.0001.obj" + std::string(kWhatIsBroken);
    const ProgramResult stopped = render({"walk.toml", "-f", "1-4", "-o", "o.#.png"});
    EXPECT_EQ(stopped.status, 1);
    EXPECT_EQ(stopped.err.find(what), 0u) << stopped.err;
    const ProgramResult all = render({"walk.toml", "-f", "1-4", "-o", "o.#.png", "--keep-going"});
    EXPECT_EQ(all.status, 1);
    EXPECT_NE(all.err.find("objects and materials are those of frame 2\n"), std::string::npos) << all.err;
    EXPECT_NE(all.err.find("\n1 of 4 frames failed: 1\n"), std::string::npos) << all.err;
    EXPECT_TRUE(is_there("o.0002.png") && is_there("o.0003.png") && is_there("o.0004.png"));
    const ProgramResult planned = render({"walk.toml", "-f", "1-4", "-o", "o.#.png", "--keep-going", "--dry-run"});
    EXPECT_EQ(planned.status, 0) << planned.err;
}

TEST_F(StoppedFrames, ACameraThatFailsNamesItsFrame) {
    folder_.write(
        "c.toml",
        "[[camera]]\nname='main'\ntarget=[0,0,0]\ninterpolation='linear'\n[[camera.key]]\nframe=1\neye=[0,0,3]\n"
        "[[camera.key]]\nframe=3\neye=[0,0,-3]\n[[object]]\nshape='box'\n");
    const ProgramResult result = render({"c.toml", "-r", "32x32", "-f", "1-3", "-o", "c.##.png"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err.find("frame 2: c.toml:1:1: the camera's eye and target are the same place"), 0u) << result.err;
}

TEST_F(StoppedFrames, StopsAfterTheFrameThatIsWritten) {
    Program program(folder_.path(), {"render", "s.toml", "-f", "1-5000", "-o", "o.#.png", "--stats", "s.json"});
    while (!fs::exists(folder_.file("o.0003.png"))) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    program.send(SIGTERM);
    const ProgramResult result = program.wait();
    EXPECT_EQ(result.status, 130);
    const std::vector<nlohmann::json> all = lines(content("s.json"));
    ASSERT_GE(all.size(), 5u);
    EXPECT_EQ(all.back()["interrupted"], 1);
    EXPECT_EQ(all[all.size() - 2]["status"], "interrupted");
    const int last = all[all.size() - 3]["frame"];
    EXPECT_EQ(all[all.size() - 3]["status"], "done");
    EXPECT_EQ(result.err, "burin: interrupted after frame " + std::to_string(last) + "; --skip-existing goes on\n");
    // All files are whole, and there is no other.
    std::size_t pictures = 0;
    for (const std::string& name : folder_.names()) pictures += name.starts_with("o.") ? 1 : 0;
    EXPECT_EQ(pictures, static_cast<std::size_t>(last));
    EXPECT_EQ(folder_.names().size(), pictures + 3);
}

/// The number of a process that has ended.
std::string dead_process() {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    ::waitpid(child, nullptr, 0);
    return std::to_string(child);
}

TEST_F(StoppedFrames, WhatDeadProcessesLeftIsRemovedEvenIfNothingIsRendered) {
    char host[65] = "";
    ::gethostname(host, sizeof host - 1);
    const std::string behind = ".burin-" + std::string(host) + "-" + dead_process() + "-0.exr";
    for (const Arguments& files : {Arguments{"-f", "1", "-o", "o.####.exr"}, {"-o", "o.0001.exr"}}) {
        for (int run = 0; run < 2; ++run) {  // in the second one the frame is there
            Arguments job = {"s.toml", "--skip-existing"};
            job.insert(job.end(), files.begin(), files.end());
            folder_.write(".o.0001" + behind, "x");
            folder_.write(".p.0001" + behind, "of another output");
            EXPECT_EQ(render(job).status, 0);
            EXPECT_FALSE(is_there(".o.0001" + behind)) << run;
            EXPECT_TRUE(is_there(".p.0001" + behind));
        }
    }
}

std::string name_of(const std::string& job, int frame, const std::string& kind) {
    return job + "." + (frame < 10 ? "0" : "") + std::to_string(frame) + "." + kind;
}

/// Kills a job again and again: whenever that is, each file is the one of a job that was left alone, or not there. Then
/// lets it end.
void kill_and_resume(const TemporaryFolder& folder, int kills, const std::string& kind, unsigned seed) {
    constexpr int kFrames = 20;
    const auto job = [&](const std::string& name) {
        return Arguments{"render", "s.toml", "-f", "1-20", "-o", name + ".##." + kind, "--skip-existing", "-q"};
    };
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(run_burin(folder.path(), job("whole")).status, 0);
    const auto whole = std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - begin);
    std::vector<std::string> contents;
    for (int frame = 1; frame <= kFrames; ++frame)
        contents.push_back(read_file(folder.file(name_of("whole", frame, kind))));
    /// How many frames are there.
    const auto compare = [&] {
        int count = 0;
        for (int frame = 1; frame <= kFrames; ++frame) {
            const std::string path = folder.file(name_of("k", frame, kind));
            if (!fs::exists(path)) continue;
            ++count;
            EXPECT_TRUE(read_file(path) == contents[static_cast<std::size_t>(frame - 1)]) << path;
        }
        for (const std::string& name : folder.names())
            EXPECT_TRUE(name[0] == '.' || name.starts_with("k.") || name.starts_with("whole.") || name == "s.toml" ||
                        name == "cube.obj")
                << name;
        return count;
    };
    std::mt19937 random(seed);
    int seen = 0;
    for (int i = 0; i < kills; ++i) {
        {
            Program program(folder.path(), job("k"));
            std::this_thread::sleep_for(std::chrono::microseconds(random() % static_cast<unsigned>(whole.count())));
            program.send(SIGKILL);
            program.wait();
        }
        const int count = compare();
        seen += count > 0 && count < kFrames ? 1 : 0;
        if (count < kFrames && i % 10 != 9) continue;
        for (int frame = 1; frame <= kFrames; ++frame) fs::remove(folder.file(name_of("k", frame, kind)));
    }
    EXPECT_GT(seen, 0) << "no job was killed at work";
    ASSERT_EQ(run_burin(folder.path(), job("k")).status, 0);
    EXPECT_EQ(compare(), kFrames);
    EXPECT_EQ(folder.names().size(), 2u * kFrames + 2) << "temporary files are left";
}

TEST_F(StoppedFrames, KilledAndResumedIsTheSame) { kill_and_resume(folder_, 6, "exr", 7); }

/// Together 200 times.
class KilledFrames : public StoppedFrames, public testing::WithParamInterface<unsigned> {};
TEST_P(KilledFrames, FiftyTimesIsTheSame) {
    kill_and_resume(folder_, 50, GetParam() % 2 == 0 ? "exr" : "png", GetParam());
}
INSTANTIATE_TEST_SUITE_P(Seeds, KilledFrames, testing::Range(0u, 4u));

}  // namespace
}  // namespace burin::test::stopped_frames_test
