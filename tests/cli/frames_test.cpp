// Many frames of one scene: which, how they are called, that each is the picture that it is alone, and what becomes of
// files that are there.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::frames_test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

constexpr const char* kScene = R"([picture]
size = [96, 64]
[frames]
range = "1-6"
[[camera]]
name = "main"
eye = [3, 2, 5]
target = [0, 0, 0]
[[camera.key]]
frame = 1
eye = [3, 2, 5]
[[camera.key]]
frame = 6
eye = [5, 2, 3]
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

class Frames : public testing::Test {
  protected:
    Frames() {
        folder_.write("cube.obj", kCubeObj);
        folder_.write("s.toml", kScene);
    }

    ProgramResult run(const Arguments& arguments) const { return run_burin(folder_.path(), arguments); }
    ProgramResult render(Arguments arguments) const {
        arguments.insert(arguments.begin(), "render");
        return run(arguments);
    }
    void expect_done(const Arguments& arguments) const {
        const ProgramResult result = render(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(result.err, "");
    }
    void expect_error(const Arguments& arguments, int status, const std::string& words) const {
        const std::vector<std::string> before = folder_.names();
        const ProgramResult result = render(arguments);
        EXPECT_EQ(result.status, status) << result.err;
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
        EXPECT_EQ(folder_.names(), before);
    }
    std::string content(const std::string& name) const { return read_file(folder_.file(name)); }
    /// The lines of --stats.
    std::vector<nlohmann::json> lines(const std::string& text) const {
        std::vector<nlohmann::json> all;
        std::istringstream in(text);
        for (std::string line; std::getline(in, line);) all.push_back(nlohmann::json::parse(line));
        return all;
    }
    /// The statuses of the frames of a job that leaves out what is there: "1 done 2 skipped ".
    std::string statuses(Arguments arguments) const {
        arguments.insert(arguments.end(), {"--skip-existing", "--stats", "-", "-q"});
        std::string text;
        for (const nlohmann::json& line : lines(render(arguments).out)) {
            if (line.contains("frame")) text += line["frame"].dump() + " " + line["status"].get<std::string>() + " ";
        }
        return text;
    }

    /// Files that are there are left out; what is not whole, or not of this input, is rendered again.
    void check_kinds(const std::vector<std::string>& kinds) const;

    TemporaryFolder folder_;
};

TEST_F(Frames, EachIsThePictureThatItIsAlone) {
    for (const std::string kind : {"exr", "png", "svg"}) {
        expect_done({"s.toml", "-o", "out.###." + kind});
        for (const std::string frame : {"1", "4", "6"}) {
            expect_done({"s.toml", "-f", frame, "-o", "one." + kind, "-j", "1"});
            EXPECT_EQ(content("one." + kind), content("out.00" + frame + "." + kind)) << kind << " " << frame;
        }
        EXPECT_NE(content("out.001." + kind), content("out.002." + kind));
    }
}

TEST_F(Frames, ThreadsAndTheOrderOfFramesChangeNothing) {
    expect_done({"s.toml", "-f", "1-6", "-o", "a.#.exr", "-j", "1"});
    for (const std::string threads : {"2", "7"}) {
        expect_done({"s.toml", "-f", "6-1", "-o", "b.#.exr", "-j", threads});
        for (int frame = 1; frame <= 6; ++frame) {
            const std::string end = ".000" + std::to_string(frame) + ".exr";
            EXPECT_EQ(content("b" + end), content("a" + end)) << threads << " " << frame;
        }
    }
}

/// Copies that part, cracks that depend on the camera, hidden lines: what is kept from frame to frame is what each
/// needs.
TEST_F(Frames, NothingOfOneFrameIsLeftInAnother) {
    folder_.write("cracked.obj",
                  "v -1 -1 0\nv 0 -1 0\nv 0 1 0\nv -1 1 0\nv 0.0005 -1 0\nv 1 -1 0\nv 1 1 0\nv 0.0005 1 0\n"
                  "f 1 2 3 4\nf 5 6 7 8\n");
    folder_.write("k.toml", R"([picture]
size = [64, 48]
[lines]
draw = "all"
[lines.hidden]
style = "solid"
[[camera]]
target = [0, 0, 0]
interpolation = "linear"
[[camera.key]]
frame = 1
eye = [0.3, 0.2, 3]
[[camera.key]]
frame = 5
eye = [0, 0, 0.3]
[[object]]
file = "cracked.obj"
[[object]]
file = "cube.obj"
scale = 0.5
[[object]]
file = "cube.obj"
interpolation = "step"
[[object.key]]
frame = 1
scale = 0.5
[[object.key]]
frame = 3
scale = 0.5
translate = [0.3, 0.2, 0]
[[object.key]]
frame = 5
scale = 0.5
)");
    expect_done({"k.toml", "-f", "1-5,1.5", "-o", "all.##.exr"});
    for (const std::string frame : {"01", "02", "03", "04", "05"}) {
        expect_done({"k.toml", "-f", frame, "-o", "one.exr"});
        EXPECT_EQ(content("one.exr"), content("all." + frame + ".exr")) << frame;
    }
    EXPECT_TRUE(fs::exists(folder_.file("all.01.5.exr")));
}

/// Methods that look at depth in steps have the same range in all frames, whichever are asked for; where that range is
/// another, files are not taken for the same.
TEST_F(Frames, DepthRangesAreFittedOnce) {
    for (const std::string method : {"stencil", "gbuffer"}) {
        expect_done({"s.toml", "-q", "-f", "1-6", "-o", "all.#.png", "-m", method});
        expect_done({"s.toml", "-q", "-f", "4", "-o", "one.png", "-m", method});
        EXPECT_EQ(content("one.png"), content("all.0004.png")) << method;
        const Arguments job = {"s.toml", "-f", "4", "-o", "all.#.png", "-m", method};
        EXPECT_EQ(statuses(job), "4 skipped ");
        std::string longer = kScene;
        longer.replace(longer.find("1-6"), 3, "1-9");
        folder_.write("s.toml", longer);
        EXPECT_EQ(statuses(job), "4 done ");
        folder_.write("s.toml", kScene);
    }
    const Arguments job = {"s.toml", "-f", "4", "-o", "a.#.png"};
    EXPECT_EQ(statuses(job), "4 done ");
    folder_.write("s.toml", std::string(kScene).replace(std::string(kScene).find("1-6"), 3, "1-9"));
    EXPECT_EQ(statuses(job), "4 skipped ");  // nothing of this picture is fitted
}

TEST_F(Frames, NoFrameIsWrittenOverAnInput) {
    fs::create_hard_link(folder_.file("cube.obj"), folder_.file("o.05.png"));
    expect_error({"s.toml", "-f", "1-6", "-o", "o.##.png"}, 2, "--output: would overwrite");
    EXPECT_EQ(content("cube.obj"), kCubeObj);
}

TEST_F(Frames, AMillionFramesBeginAtOnce) {
    ProgramOptions little;
    little.memory_limit = std::size_t{600} << 20;
    Program program(folder_.path(), {"render", "s.toml", "-f", "1-1000000", "-o", "o.#.png", "-j", "1"}, little);
    for (int i = 0; i < 9000 && !fs::exists(folder_.file("o.0001.png")); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_TRUE(fs::exists(folder_.file("o.0001.png")));
    program.send(SIGINT);
    EXPECT_EQ(program.wait().status, 130);
}

TEST_F(Frames, SheetsKnowTheFrame) {
    folder_.write(
        "w.toml",
        "[style.a]\nwidth = \"=1 + frame\"\n[[set]]\nname = \"all\"\nclasses = [\"crease\"]\nstyle = \"a\"\n");
    expect_done({"cube.obj", "-r", "64x48", "--style", "./w.toml", "-f", "1-3", "-o", "f.#.svg"});
    expect_done({"cube.obj", "-r", "64x48", "--style", "./w.toml", "--frame", "2", "-o", "still.svg"});
    const std::string still = content("still.svg"), second = content("f.0002.svg");
    EXPECT_NE(content("f.0001.svg"), second);
    EXPECT_EQ(second.substr(second.find("<g")), still.substr(still.find("<g")));  // but for the fingerprint
}

TEST_F(Frames, ATurntableNeedsNoScene) {
    expect_done({"cube.obj", "-r", "48x48", "--turntable", "4", "-o", "t.##.exr"});
    for (const char* name : {"t.01.exr", "t.02.exr", "t.03.exr", "t.04.exr"})
        EXPECT_TRUE(fs::exists(folder_.file(name)));
    EXPECT_FALSE(fs::exists(folder_.file("t.05.exr")));
    expect_done({"cube.obj", "-r", "48x48", "--turntable", "4", "-f", "1,5", "-o", "u.##.svg", "--ids", "none"});
    const std::string first = content("u.01.svg"), fifth = content("u.05.svg");
    EXPECT_EQ(first.substr(first.find("<g")), fifth.substr(fifth.find("<g")));
}

TEST_F(Frames, StillsOfAnAnimatedSceneAreItsFirstFrame) {
    expect_done({"s.toml", "-o", "still.svg"});
    expect_done({"s.toml", "--frame", "1", "-o", "first.svg"});
    expect_done({"s.toml", "--frame", "4", "-o", "fourth.svg"});
    EXPECT_EQ(content("still.svg"), content("first.svg"));
    EXPECT_NE(content("still.svg"), content("fourth.svg"));
}

TEST_F(Frames, NamesAndNumbersThatDoNotFitAreRefused) {
    expect_error({"cube.obj", "-f", "5-1x0", "-o", "a.##.exr"}, 2, "--frames: 5-1x0: a step must not be 0");
    expect_error({"cube.obj", "-f", "1-3", "-o", "a.exr"}, 2, "-o: several frames need a pattern, as out.####.exr");
    expect_error({"cube.obj", "-f", "1-3"}, 2, "-o: several frames need a pattern");
    expect_error({"missing.obj", "-f", "1-3", "-o", "a.exr"}, 2, "-o: several frames need a pattern");
    expect_error({"cube.obj", "-o", "a.####.exr"}, 2, "-o: a pattern for frames needs --frames");
    expect_error({"cube.obj", "-f", "1", "-o", "a.##.%04d.exr"}, 2, "one pattern");
    expect_error({"cube.obj", "--turntable", "3", "-o", "a.exr"}, 2, "several frames need a pattern");
    expect_error({"cube.obj", "--turntable", "0", "-o", "a.##.exr"}, 2, "--turntable");
    expect_error({"cube.obj", "-f", "1-3", "-o", "a.##.exr", "--stats", "s.##.json"}, 2, "--stats: is one file");
    expect_error({"cube.obj", "-f", "1-3", "-o", "a.##.exr", "--style", "comic", "--save-lines", "a.lines"}, 2,
                 "--save-lines: several frames need a pattern");
    expect_error({"cube.obj", "-f", "1-3", "-o", "a.##.exr", "--frame", "2"}, 2, "cannot stand beside --frame");
    expect_error({"cube.obj", "-f", "1-3", "-o", "a.##.exr", "--repeat", "2"}, 2, "cannot stand beside --repeat");
    expect_error({"cube.obj", "-f", "1-3", "-o", "a.##.exr", "--fps", "0"}, 2, "--fps: ");
    expect_error({"s.toml", "-f", "1-99999999", "-o", "a.##.exr"}, 2, "at most 1000000 frames");
    // A letter in a model's name is no pattern.
    folder_.write("part#1.obj", kCubeObj);
    expect_done({"part#1.obj", "-r", "32x32"});
    EXPECT_TRUE(fs::exists(folder_.file("part#1.png")));
    // A single # is one where the scene has frames.
    expect_done({"s.toml", "-o", "a.#.png"});
    EXPECT_TRUE(fs::exists(folder_.file("a.0006.png")));
    // Negative numbers are values, not options.
    expect_done({"s.toml", "-f", "-1-1", "-o", "n.##.png"});
    EXPECT_TRUE(fs::exists(folder_.file("n.-01.png")));
}

TEST_F(Frames, StatisticsHaveALinePerFrame) {
    const ProgramResult result =
        render({"s.toml", "-f", "1-3", "-o", "o.##.exr", "--stats", "s.json", "--progress", "alf"});
    const std::vector<nlohmann::json> all = lines(content("s.json"));
    ASSERT_EQ(all.size(), 4u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(all[i]["frame"], i + 1);
        EXPECT_EQ(all[i]["output"], "o.0" + std::to_string(i + 1) + ".exr");
        EXPECT_EQ(all[i]["status"], "done");
        EXPECT_TRUE(all[i]["error"].is_null());
        EXPECT_GT(all[i]["triangles"], 500);
        EXPECT_GT(all[i]["peak_rss_bytes"], 1000000);
        EXPECT_TRUE(all[i]["stages"].contains("raster"));
    }
    EXPECT_EQ(all[3]["summary"], true);
    EXPECT_EQ(all[3]["done"], 3);
    // What farms parse: percents that never fall, up to 100, and each file.
    std::istringstream out(result.out);
    int percent = 0, saved = 0;
    for (std::string line; std::getline(out, line);) {
        int next = 0;
        if (std::sscanf(line.c_str(), "ALF_PROGRESS %d%%", &next) == 1) {
            EXPECT_GE(next, percent);
            percent = next;
        } else {
            EXPECT_EQ(line, "Saved: 'o.0" + std::to_string(++saved) + ".exr'");
        }
    }
    EXPECT_EQ(percent, 100);
    EXPECT_EQ(saved, 3);
}

void Frames::check_kinds(const std::vector<std::string>& kinds) const {
    for (const std::string& kind : kinds) {
        const Arguments job = {"s.toml", "-f", "1-2", "-o", "x.#." + kind, "-j", "1"};
        const std::string all_there = "1 skipped 2 skipped ", one_there = "1 skipped 2 done ";
        EXPECT_EQ(statuses(job), "1 done 2 done ") << kind;
        const std::string second = "x.0002." + kind, whole = content(second);
        EXPECT_EQ(statuses(job), all_there) << kind;
        EXPECT_EQ(content(second), whole);
        // A file that lacks its last byte, half a one, another frame's, an empty one.
        std::vector<std::string> others = {whole.substr(0, whole.size() - 1)};
        if (kind != "tif")
            others.insert(others.end(), {whole.substr(0, whole.size() / 2), content("x.0001." + kind), ""});
        for (const std::string& other : others) {
            folder_.write(second, other);
            EXPECT_EQ(statuses(job), one_there) << kind << " " << other.size();
            EXPECT_EQ(content(second), whole);
        }
        fs::remove(folder_.file("still." + kind));
        expect_done({"s.toml", "--frame", "2", "-o", "still." + kind});
        fs::copy_file(folder_.file("still." + kind), folder_.file(second), fs::copy_options::overwrite_existing);
        EXPECT_EQ(statuses(job), one_there) << kind;
        EXPECT_EQ(content(second), whole);
    }
}

TEST_F(Frames, WhatIsThereAndWholeAndRightIsLeftOut) { check_kinds({"exr", "png"}); }
TEST_F(Frames, DrawingsThatAreThereAreLeftOut) { check_kinds({"svg", "pdf", "dxf"}); }
TEST_F(Frames, TiffsThatAreThereAreLeftOut) { check_kinds({"tif"}); }

TEST_F(Frames, AHoleInTheTableOfAnExrIsFound) {
    const Arguments job = {"s.toml", "-f", "1-2", "-o", "x.#.exr"};
    statuses(job);
    const std::string whole = content("x.0001.exr");
    // Whatever byte is changed, or wherever the file is cut: the program does not fall over it.
    std::mt19937 random(1);
    for (int trial = 0; trial < 40; ++trial) {
        std::string bad = whole;
        const std::size_t at = random() % (trial < 30 ? 700 : bad.size());
        if (trial % 2 == 0) {
            bad[at] = static_cast<char>(random());
        } else {
            bad.resize(at);
        }
        folder_.write("x.0001.exr", bad);
        const std::string found = statuses(job);
        EXPECT_TRUE(found == "1 done 2 skipped " || (trial % 2 == 0 && found == "1 skipped 2 skipped ")) << found;
    }
}

TEST_F(Frames, AnotherInputIsRenderedAgain) {
    const std::string done = "1 done 2 done ", there = "1 skipped 2 skipped ";
    const auto job = [](const Arguments& more) {
        Arguments all = {"s.toml", "-f", "1-2", "-o", "x.#.png"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    EXPECT_EQ(statuses(job({})), done);
    // What changes no pixel.
    for (const Arguments& same : {Arguments{"-j", "1"}, {"--keep-going"}, {"--memory", "1G"}})
        EXPECT_EQ(statuses(job(same)).find("done"), std::string::npos) << same.front();
    EXPECT_EQ(statuses({"s.toml", "-f", "2,1", "-o", "x.%04d.png"}), "2 skipped 1 skipped ");
    folder_.write("s.toml", "# a comment\n" + std::string(kScene));
    EXPECT_EQ(statuses(job({})), there);
    // What does.
    for (const Arguments& other : {Arguments{"-w", "2"},
                                   {"--set", "lines.crease_angle=50"},
                                   {"--camera", "main", "--lines", "silhouette"},
                                   {"-r", "64x64"},
                                   {"--crop", "0,0,50,50"},
                                   {"--bits", "16"},
                                   {"--style", "comic"}}) {
        EXPECT_EQ(statuses(job(other)), done) << other.front();
        EXPECT_EQ(statuses(job(other)), there) << other.front();
    }
    EXPECT_EQ(statuses(job({})), done);
    folder_.write("cube.obj", std::string(kCubeObj) + "v 9 9 9\n");
    EXPECT_EQ(statuses(job({})), done);
    folder_.write("s.toml", std::string(kScene) + "[[light]]\ndirection = [0, 0, 1]\n");
    EXPECT_EQ(statuses(job({})), done);
    // Keys matter where they move something.
    std::string moved = kScene;
    moved.replace(moved.find("rotate = [0, 180, 90]"), 21, "rotate = [0, 180, 80]");
    folder_.write("s.toml", moved);
    EXPECT_EQ(statuses(job({})), done);
    // A note says why.
    folder_.write("x.0002.png", "x");
    EXPECT_EQ(render(job({"--skip-existing"})).err,
              "burin: note: frame 2: x.0002.png is not whole; it is rendered again\n");
}

TEST_F(Frames, AllOutputsOfAFrameMustBeThere) {
    const Arguments job = {"s.toml", "-f", "1-2", "-o", "x.#.png", "--style", "comic", "--save-lines", "x.#.lines"};
    EXPECT_EQ(statuses(job), "1 done 2 done ");
    EXPECT_EQ(statuses(job), "1 skipped 2 skipped ");
    const std::string whole = content("x.0002.lines");
    fs::remove(folder_.file("x.0002.lines"));
    EXPECT_EQ(statuses(job), "1 skipped 2 done ");
    EXPECT_EQ(content("x.0002.lines"), whole);
    folder_.write("x.0001.lines", whole.substr(0, whole.size() - 8));
    EXPECT_EQ(statuses(job), "1 done 2 skipped ");
}

TEST_F(Frames, WhatIsNoFileIsNotTrusted) {
    ASSERT_EQ(::mkfifo(folder_.file("x.0001.png").c_str(), 0600), 0);
    const ProgramResult result = render({"s.toml", "-f", "1-2", "-o", "x.#.png", "--skip-existing"});
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("not a regular file"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace burin::test::frames_test
