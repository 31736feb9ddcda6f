// Frames that are there, but were made of something else: whatever reaches their pixels is in the fingerprint.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::stale_frames_test {
namespace {

using Arguments = std::vector<std::string>;

constexpr const char* kView = R"([picture]
size = [48, 32]
[frames]
range = "1-3"
[[camera]]
eye = [0.5, 0.5, 6]
target = [0.5, 0.5, 0]
)";

/// A box that stands still until frame 3, and goes to `place` until frame 4.
std::string moving_box(const std::string& place) {
    return std::string(kView) + R"([[object]]
shape = "box"
interpolation = "linear"
[[object.key]]
frame = 3
translate = [0, 0, 0]
[[object.key]]
frame = 4
translate = )" +
           place + "\n";
}

class StaleFrames : public testing::Test {
  protected:
    /// The statuses of the frames of a job that leaves out what is there: "done skipped ".
    std::string statuses(Arguments arguments) const {
        arguments.insert(arguments.begin(), {"render", "s.toml", "--skip-existing", "--stats", "-", "-q"});
        const ProgramResult result = run_burin(folder_.path(), arguments);
        std::istringstream in(result.out);
        std::string text;
        for (std::string line; std::getline(in, line);) {
            const nlohmann::json stats = nlohmann::json::parse(line);
            if (stats.contains("frame")) text += stats["status"].get<std::string>() + " ";
        }
        return text.empty() ? result.err : text;
    }
    std::string content(const std::string& name) const { return read_file(folder_.file(name)); }

    TemporaryFolder folder_;
};

const Arguments kMotion{"-f", "2-3", "-o", "x.#.exr", "--layers", "beauty,motion"};

TEST_F(StaleFrames, MotionIsOfTheNextFramesKeys) {
    folder_.write("s.toml", moving_box("[1, 0, 0]"));
    EXPECT_EQ(statuses(kMotion), "done done ");
    EXPECT_EQ(statuses(kMotion), "skipped skipped ");
    const std::string right = content("x.0003.exr");
    folder_.write("s.toml", moving_box("[0, 1, 0]"));
    EXPECT_EQ(statuses({"-f", "2-3", "-o", "y.#.exr"}), "done done ");
    EXPECT_EQ(statuses(kMotion), "skipped done ");
    EXPECT_NE(content("x.0003.exr"), right);
    // Without that layer nothing of it is in a frame.
    folder_.write("s.toml", moving_box("[1, 0, 0]"));
    EXPECT_EQ(statuses({"-f", "2-3", "-o", "y.#.exr"}), "skipped skipped ");
}

/// They are not read, and whether they are there changes nothing.
TEST_F(StaleFrames, TexturesAreNoInput) {
    folder_.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
    folder_.write("a.mtl", "newmtl m\nKd 1 0 0\nmap_Kd gone.png\nmap_d .\nbump /dev/zero\nmap_Ks C:\\t\\x.png\n");
    folder_.write("s.toml", std::string(kView) + "[[object]]\nfile = \"a.obj\"\n");
    const Arguments arguments{"-f", "1-2", "-o", "t.#.png"};
    EXPECT_EQ(statuses(arguments), "done done ");
    folder_.write("gone.png", "a picture");
    EXPECT_EQ(statuses(arguments), "skipped skipped ");
}

TEST_F(StaleFrames, MotionIsOfTheNextFramesFile) {
    const auto triangle = [](const char* x) { return "v 0 0 0\nv " + std::string(x) + " 0 0\nv 0 1 0\nf 1 2 3\n"; };
    folder_.write("s.toml", std::string(kView) + "[[object]]\nfile = \"walk.####.obj\"\n");
    for (const char* frame : {"1", "2", "3"}) folder_.write("walk.000" + std::string(frame) + ".obj", triangle("1"));
    EXPECT_EQ(statuses(kMotion), "done done ");
    EXPECT_EQ(statuses(kMotion), "skipped skipped ");
    folder_.write("walk.0004.obj", triangle("1.5"));  // it was not there yet
    EXPECT_EQ(statuses(kMotion), "skipped done ");
    folder_.write("walk.0004.obj", triangle("2"));
    EXPECT_EQ(statuses(kMotion), "skipped done ");
    EXPECT_EQ(statuses(kMotion), "skipped skipped ");
    Arguments blurred = kMotion;
    blurred.insert(blurred.end(), {"--shutter", "-0.5,0"});
    EXPECT_EQ(statuses(blurred), "done done ");
    folder_.write("walk.0004.obj", triangle("2.5"));
    EXPECT_EQ(statuses(blurred), "skipped done ");
}

TEST_F(StaleFrames, LongShuttersSeeShortMotion) {
    const auto jumping = [](const char* height) {
        return std::string(kView) + "[shutter]\nopen = -40\nclose = 40\nsamples = 2\n" +
               "[[object]]\nshape = \"box\"\ninterpolation = \"linear\"\n"
               "[[object.key]]\nframe = 20\ntranslate = [0, 0, 0]\n[[object.key]]\nframe = 21\ntranslate = [0, " +
               height + ", 0]\n[[object.key]]\nframe = 22\ntranslate = [0, 0, 0]\n";
    };
    const Arguments job{"-f", "1-2", "-o", "x.#.png"};
    folder_.write("s.toml", jumping("1"));
    EXPECT_EQ(statuses(job), "done done ");
    folder_.write("s.toml", jumping("2"));
    EXPECT_EQ(statuses(job), "done done ");
    EXPECT_EQ(statuses(job), "skipped skipped ");
}

TEST_F(StaleFrames, BytesBehindTheLastChunkOfAnExrAreFound) {
    folder_.write("s.toml", moving_box("[1, 0, 0]"));
    for (const Arguments& job :
         {Arguments{"-o", "x.#.exr"}, Arguments{"-o", "x.#.exr", "--parts", "--layers", "beauty,lines"},
          Arguments{"--deep", "x.#.exr"}}) {
        statuses(job);
        EXPECT_EQ(statuses(job), "skipped skipped skipped ");
        const std::string whole = content("x.0002.exr");
        folder_.write("x.0002.exr", whole + '\0');
        EXPECT_EQ(statuses(job), "skipped done skipped ");
        EXPECT_EQ(content("x.0002.exr"), whole);
    }
}

/// Depth is fitted to all frames of a turn, or the picture would breathe: a turn of one frame is another one.
TEST_F(StaleFrames, DepthOfATurntableIsThatOfAllItsFrames) {
    const std::string boxes =
        "[[object]]\nshape = \"box\"\nscale = [1, 1, 9]\n"
        "[[object]]\nshape = \"torus\"\ntranslate = [0, 0, 6]\n";
    const auto picture = [&](const std::string& scene, const char* frames) {
        folder_.write("s.toml", scene + boxes);
        const ProgramResult result =
            run_burin(folder_.path(), {"render", "s.toml", "--turntable", frames, "-f", "1", "-o", "x.#.png", "-m",
                                       "gbuffer", "-r", "192x128", "--eye", "3,2,9", "--target", "0,0,0", "-q"});
        EXPECT_EQ(result.err, "");
        std::string bytes = content("x.0001.png");
        const std::size_t at = bytes.find("burin/fingerprint");
        return at == std::string::npos ? std::string() : bytes.erase(at, 38);  // with its digits and their sum
    };
    const std::string turn = picture("", "8");
    EXPECT_FALSE(turn == picture("", "1"));
    EXPECT_TRUE(turn == picture("[frames]\nrange = \"1-8\"\n", "8"));
    folder_.write("s.toml", boxes);
    const Arguments job{"-f", "1", "-o", "y.#.png", "-m", "gbuffer", "--turntable"};
    const auto of_turn = [&](const char* frames) {
        Arguments all = job;
        all.push_back(frames);
        return statuses(all);
    };
    EXPECT_EQ(of_turn("8"), "done ");
    EXPECT_EQ(of_turn("8"), "skipped ");
    EXPECT_EQ(of_turn("1"), "done ");
}

}  // namespace
}  // namespace burin::test::stale_frames_test
