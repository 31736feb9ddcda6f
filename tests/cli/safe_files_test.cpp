// What is read stays as it is, and what is written leaves nothing else behind, whatever happens.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <thread>
#include <tuple>
#include <utility>

#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::safe_files_test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

class SafeFiles : public testing::Test {
  protected:
    SafeFiles() {
        folder_.write("cube.obj", "mtllib cube.mtl\n" + std::string(kCubeObj));
        folder_.write("cube.mtl", "newmtl red\nKd 1 0 0\nmap_Kd -s 1 1 1 skin.png\n");
        for (auto [name, content] : tetrahedra()) {
            if (name == "tetra.gltf") content.insert(1, R"("images": [{"uri": "a%20skin.png"}, {"uri": 3}, 5],)");
            folder_.write(name, content);
        }
        for (const char* name : {"skin.png", "a skin.png"}) folder_.write(name, "a picture");
        folder_.write("both.toml", "[[object]]\nfile='cube.obj'\n[[object]]\nfile='tetra.gltf'\n");
    }

    ProgramResult run(const Arguments& arguments) const { return run_burin(folder_.path(), arguments); }
    /// Expects exit status 2, one line that names the option and the input, and every file as it
    /// was.
    void expect_refused(const Arguments& arguments, const std::string& option, const std::string& input) const {
        const auto names = folder_.names();
        const std::string before = read_file(folder_.file(input));
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.status, 2) << input << ": " << result.err;
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_EQ(result.err.find("burin: " + option + ": would overwrite "), 0u) << result.err;
        EXPECT_NE(result.err.find(input), std::string::npos) << result.err;
        EXPECT_EQ(read_file(folder_.file(input)), before);
        EXPECT_EQ(folder_.names(), names);
    }

    TemporaryFolder folder_;
};

/// The scene file, its models, their materials and buffers, and textures that are not read.
const char* const kInputs[] = {"both.toml", "cube.obj", "cube.mtl",  "tetra.gltf",
                               "tetra.bin", "skin.png", "a skin.png"};

TEST_F(SafeFiles, NoOutputIsAnInput) {
    fs::create_directory(folder_.file("report"));
    for (const std::string input : kInputs) {
        for (const bool is_hard : {false, true}) {
            const auto link = [&](const std::string& name) {
                fs::remove(folder_.file(name));
                if (is_hard) {
                    fs::create_hard_link(folder_.file(input), folder_.file(name));
                } else {
                    fs::create_symlink(folder_.file(input), folder_.file(name));
                }
            };
            link("out.png");
            expect_refused({"render", "both.toml", "-r", "20x20", "-o", "out.png"}, "--output", input);
            expect_refused({"render", "both.toml", "-r", "20x20", "-o", "x.exr", "--stats", "out.png"}, "--stats",
                           input);
            fs::remove(folder_.file("out.png"));
            expect_refused({"render", "both.toml", "-r", "20x20", "-o", "x.exr", "--stats", "./" + input}, "--stats",
                           input);
            for (const char* name : {"report/truth.png", "report/patel.png", "report/patel_diff.png",
                                     "report/metrics.json", "report/report.html"}) {
                link(name);
                expect_refused({"compare", "both.toml", "-r", "20x20", "-o", "report", "--methods", "patel"},
                               "--output", input);
                fs::remove(folder_.file(name));
            }
        }
    }
    EXPECT_EQ(run({"render", "both.toml", "-r", "20x20", "-o", "out.png"}).status, 0);
    // A bare model.
    fs::create_symlink("cube.obj", folder_.file("link.exr"));
    expect_refused({"render", "cube.obj", "-o", "link.exr"}, "--output", "cube.obj");
}

TEST_F(SafeFiles, OutputsAreDifferentFiles) {
    fs::create_symlink("a.exr", folder_.file("b.json"));
    for (const char* stats : {"a.exr", "./a.exr",
                              "../"
                              "a.exr"}) {
        const bool is_other = std::string(stats).starts_with("../");
        const ProgramResult result = run({"render", "cube.obj", "-r", "20x20", "-o", "a.exr", "--stats",
                                          is_other ? folder_.path() + "/a.exr" : stats});
        EXPECT_EQ(result.status, 2) << stats << result.err;
    }
    run({"render", "cube.obj", "-r", "20x20", "-o", "a.exr"});
    EXPECT_EQ(run({"render", "cube.obj", "-r", "20x20", "-o", "a.exr", "--stats", "b.json"}).status, 2);
}

TEST_F(SafeFiles, LinksToNothingAreFollowed) {
    fs::create_directory(folder_.file("shots"));
    for (const std::string extension : {".png", ".exr", ".tif"}) {
        fs::create_symlink("shots/001" + extension, folder_.file("latest" + extension));
        EXPECT_EQ(run({"render", "cube.obj", "-r", "20x20", "-o", "latest" + extension}).status, 0);
        EXPECT_TRUE(fs::is_symlink(folder_.file("latest" + extension)));
        EXPECT_TRUE(fs::is_regular_file(folder_.file("shots/001" + extension)));
    }
    fs::create_symlink("missing/001.png", folder_.file("far.png"));
    const ProgramResult result = run({"render", "cube.obj", "-o", "far.png"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err.find("far.png: cannot write: the folder missing does not exist"), 0u) << result.err;
    EXPECT_TRUE(fs::is_symlink(folder_.file("far.png")));
}

TEST_F(SafeFiles, ReadOnlyFilesStayAsTheyAre) {
    folder_.write("locked", "mine");
    fs::permissions(folder_.file("locked"), fs::perms::owner_read | fs::perms::group_read);
    for (const char* extension : {".png", ".exr", ".tif"}) {
        const std::string name = std::string("locked") + extension;
        fs::create_symlink("locked", folder_.file(name));
        const ProgramResult result = run({"render", "missing.obj", "-o", name});  // before the input is looked at
        EXPECT_EQ(result.status, 1);
        EXPECT_EQ(result.err,
                  name + ": cannot write: the file is read-only; give another name or change its permissions\n");
    }
    EXPECT_EQ(run({"render", "cube.obj", "-r", "20x20", "-o", "a.png", "--stats", "locked"}).status, 1);
    EXPECT_EQ(read_file(folder_.file("locked")), "mine");
}

/// Nothing is drawn for a name that cannot be used: the input is not even looked at.
TEST_F(SafeFiles, NamesThatAreTooLongFailBeforeTheWork) {
    for (const Arguments& outputs :
         {Arguments{"-o", std::string(252, 'n') + ".png"}, Arguments{"-o", std::string(252, 'n') + ".exr"},
          Arguments{"-o", "a.png", "--stats", std::string(256, 'n')}}) {
        Arguments arguments = {"render", "missing.obj"};
        arguments.insert(arguments.end(), outputs.begin(), outputs.end());
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.status, 1);
        EXPECT_NE(result.err.find("the name is too long"), std::string::npos) << result.err;
    }
    EXPECT_EQ(run({"render", "cube.obj", "-r", "20x20", "-o", std::string(251, 'n') + ".png"}).status, 0);
}

/// The program without the module that it needs for TIFF.
TEST_F(SafeFiles, AMissingModuleIsToldBeforeTheWork) {
    fs::copy_file(BURIN_PROGRAM, folder_.file("burin"));
    const auto run_copy = [&](const std::string& arguments) {
        const int status = std::system(("cd '" + folder_.path() + "' && ./burin " + arguments + " 2>err").c_str());
        return std::pair(WEXITSTATUS(status), read_file(folder_.file("err")));
    };
    auto [status, message] = run_copy("render missing.obj -o a.tif");
    EXPECT_EQ(status, 1);
    EXPECT_EQ(message.find("a.tif: cannot load burin_oiio.so"), 0u) << message;
    EXPECT_TRUE(is_one_line(message)) << message;
    // One that is there and cannot be used is what the message is about.
    folder_.write("burin_oiio.so", "no module");
    std::tie(status, message) = run_copy("render missing.obj -o a.tif");
    EXPECT_EQ(status, 1);
    EXPECT_EQ(message.find("No such file"), std::string::npos) << message;
    EXPECT_NE(message.find(folder_.path() + "/burin_oiio.so"), std::string::npos) << message;
    EXPECT_EQ(run_copy("render cube.obj -r 20x20 -o a.png").first, 0);
}

TEST_F(SafeFiles, ASingleNumberSignIsALetter) {
    for (const char* name : {"a#1.png", "#.png", "a#b#.png", "x%01y.png", "100%.png", "%0.png", "$F.png", "a%04.png"}) {
        EXPECT_EQ(run({"render", "cube.obj", "-r", "20x20", "-o", name}).status, 0) << name;
        EXPECT_TRUE(fs::exists(folder_.file(name))) << name;
    }
    for (const char* name : {"a##.png", "a.####.png", "a%04d.png", "a%4d.png", "x$F4.png"}) {
        EXPECT_EQ(run({"render", "cube.obj", "-r", "20x20", "-o", name}).status, 2) << name;
    }
}

TEST_F(SafeFiles, WhatStandsBehindTwoDashesIsTheInput) {
    folder_.write("-r.obj", kCubeObj);
    folder_.write("render", "");
    for (const Arguments& arguments : {Arguments{"render", "-r", "20x20", "-o", "a.png", "--", "-r.obj"},
                                       Arguments{"render", "--", "-r.obj", "-r", "20x20", "-o", "a.png"},
                                       Arguments{"--", "render", "-r.obj", "-r", "20x20", "-o", "a.png"},
                                       Arguments{"-r", "20x20", "-o", "a.png", "render", "--", "-r.obj"},
                                       Arguments{"info", "--", "cube.obj"}, Arguments{"methods", "--"}}) {
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        if (arguments[0] == "info" || arguments[0] == "methods") continue;
        EXPECT_TRUE(fs::remove(folder_.file("a.png")));
    }
    EXPECT_EQ(run({"info", "--", "render"}).status, 1);  // a file of no known kind
    for (const Arguments& arguments : {Arguments{"--"}, Arguments{"info", "--"},
                                       Arguments{"info", "cube.obj", "--", "-r.obj"}, Arguments{"--", "-r.obj"}}) {
        EXPECT_EQ(run(arguments).status, 2);
    }
}

TEST_F(SafeFiles, MoreMemoryForModelsIsAllowedByAnOption) {
    folder_.write("ball.toml", "[[object]]\nshape='sphere'\nsegments=4096\nrings=4096\n");
    folder_.write("small.toml", "[[object]]\nshape='sphere'\n");
    for (const char* command : {"info", "render", "explain", "compare"}) {
        Arguments arguments = {command, "ball.toml"};
        if (command == std::string("explain")) arguments.insert(arguments.end(), {"--pixel", "1,1"});
        if (command == std::string("compare") || command == std::string("render"))
            arguments.insert(arguments.end(), {"-o", "out.png"});
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.status, 1);
        EXPECT_EQ(result.err.find("ball.toml:1:1: object 'ball' of") == 0 ||
                      result.err.find("ball.toml:1:1: object 'sphere' of") == 0,
                  true)
            << result.err;
        EXPECT_NE(result.err.find("--memory-model 3840M"), std::string::npos) << result.err;
        arguments[1] = "small.toml";
        arguments.insert(arguments.end(), {"--memory-model", "100K"});
        EXPECT_NE(run(arguments).err.find("more than the 100 KB that --memory-model allows"), std::string::npos);
    }
    EXPECT_EQ(run({"info", "small.toml", "--memory-model", "1M"}).status, 0);
    EXPECT_EQ(run({"info", "small.toml", "--memory-model", "lots"}).status, 2);
}

/// Makes a model large enough to be cut while it is read, in the format that its name says.
void write_large(const std::string& path) {
    const std::string extension = fs::path(path).extension().string();
    std::string text;
    const auto repeat = [&](const std::string& part, int count) {
        text.reserve(text.size() + part.size() * static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i) text += part;
    };
    if (extension == ".obj") {
        text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        repeat("f 1 2 3\n", 2000000);
    } else if (extension == ".off") {
        text = "OFF\n3 1500000 0\n0 0 0\n1 0 0\n0 1 0\n";
        repeat("3 0 1 2\n", 1500000);
    } else if (extension == ".stl") {
        text = std::string(80, ' ') + bytes_of(std::uint32_t{400000});
        repeat(bytes_of(0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, std::uint16_t{0}), 400000);
    } else if (extension == ".ply") {
        text =
            "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty "
            "float y\nproperty float z\n"
            "element face 1500000\nproperty list uchar int vertex_indices\nend_header\n" +
            bytes_of(0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f);
        repeat(bytes_of(std::uint8_t{3}, 0, 1, 2), 1500000);
    } else {
        text = "{\"asset\":{\"version\":\"2.0\"},\"x\":\"" + std::string(20000000, 'y') + "\"}";
    }
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    std::fwrite(text.data(), 1, text.size(), file);
    std::fclose(file);
}

/// Wherever it is cut, it is told as what it is, or it was read already.
TEST_F(SafeFiles, AModelThatIsCutWhileItIsRead) {
    for (const std::string name : {"t.obj", "t.off", "t.stl", "t.ply", "t.gltf"}) {
        int told = 0;
        for (const int after_ms : {5, 15, 30, 60, 120}) {
            write_large(folder_.file(name));
            Program program(folder_.path(), {"info", name});
            std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
            ASSERT_EQ(::truncate(folder_.file(name).c_str(), 100), 0);
            const ProgramResult result = program.wait();
            if (result.status == 0) continue;
            EXPECT_EQ(result.status, 1) << name << ": " << result.err;
            EXPECT_TRUE(is_one_line(result.err)) << result.err;
            EXPECT_EQ(result.err.find(name), 0u) << result.err;
            told += result.err.find("the file has become shorter while it was read") != std::string::npos;
        }
        EXPECT_GT(told, 0) << name;
    }
}

/// Standing in a terminal that is closed, and at a limit of CPU time, as with Ctrl-C.
TEST_F(SafeFiles, NothingIsLeftByAnySignal) {
    folder_.write("teapot.toml", "[[object]]\nshape='teapot'\ntessellation=100\n");
    for (const int signal_number : {SIGHUP, SIGQUIT, SIGXCPU, SIGKILL}) {
        const auto before = folder_.names();
        for (const char* output : {"out.exr", "out.png"}) {
            Program program(folder_.path(), {"render", "teapot.toml", "-r", "6000x5000", "--samples", "8", "-o", output,
                                             "-j", "1", "-q"});
            std::this_thread::sleep_for(std::chrono::milliseconds(kSanitized ? 3000 : 500));
            program.send(signal_number);
            const ProgramResult result = program.wait();
            EXPECT_EQ(result.status, signal_number == SIGKILL ? 128 + SIGKILL : 130) << result.err;
            EXPECT_EQ(is_one_line(result.err), signal_number != SIGKILL) << result.err;
        }
        // What a killed process leaves where files must have names goes when the same output is
        // written again.
        if (signal_number == SIGKILL) {
            for (const char* output : {"out.exr", "out.png"}) {
                EXPECT_EQ(run({"render", "cube.obj", "-r", "20x20", "-o", output}).status, 0);
                fs::remove(folder_.file(output));
            }
        }
        EXPECT_EQ(folder_.names(), before);
    }
}

TEST_F(SafeFiles, DeepTreesEndNoProgram) {
    std::string deep = "\"=\"";
    for (int i = 0; i < 40000; ++i) deep += ".\"=\"";
    folder_.write("deep.toml", deep + " = 1\n[[object]]\nshape = \"box\"\n");
    const ProgramResult result = run({"info", "deep.toml"});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(is_one_line(result.err));
    EXPECT_EQ(result.err.find("deep.toml:1: "), 0u) << result.err;
}

/// A few hundred thousand names take no longer than it takes to read them.
TEST_F(SafeFiles, ManyNamesAreNotComparedEachWithEach) {
    std::string cameras = "[[object]]\nshape='box'\n", materials = cameras, used, highlight = "[zbuffer]\nhighlight=[";
    for (int i = 0; i < 100000; ++i) {
        const std::string n = std::to_string(i);
        cameras += "[[camera]]\nname='" + n + "'\n";
        materials += "[[material]]\nname='" + n + "'\n";
    }
    for (int i = 0; i < 10000; ++i) {
        const std::string n = std::to_string(i);
        used += "[[object]]\nshape='box'\nname='" + n + "'\nmaterial='" + n + "'\n";
        highlight += "'" + n + "',";
    }
    folder_.write("cameras.toml", cameras);
    folder_.write("materials.toml", materials + used + highlight + "]\n");
    folder_.write("key.toml", "[[object]]\nshape='box'\n" + std::string(2000000, 'k') + " = 1\n");
    for (const char* input : {"cameras.toml", "materials.toml", "key.toml"}) {
        const ProgramResult result = run({"info", input});
        EXPECT_FALSE(result.timed_out) << input;
        EXPECT_EQ(result.status, input == std::string("key.toml") ? 1 : 0) << result.err;
    }
}

}  // namespace
}  // namespace burin::test::safe_files_test
