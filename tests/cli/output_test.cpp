// Output files appear whole or not at all, wherever they are to go.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "image/exr_io.h"
#include "image/exr_reader.h"
#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::output_test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

class Output : public testing::Test {
  protected:
    Output() { folder_.write("cube.obj", kCubeObj); }
    /// Loads what writes TIFF once without the usual limit: from a slow disk its libraries, 360 MB, may take long.
    static void SetUpTestSuite() {
        const TemporaryFolder folder;
        ProgramOptions options;
        options.time_limit_s = 120;
        const ProgramResult result = run_burin(folder.path(), {"render", "missing.obj", "-o", "out.tif"}, options);
        ASSERT_EQ(result.status, 1) << result.err;
    }

    ProgramResult render(const std::string& output, const ProgramOptions& options = {},
                         const Arguments& more = {}) const {
        Arguments arguments = {"render", "cube.obj", "-r", "60x40", "-o", output};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_burin(folder_.path(), arguments, options);
    }
    /// Expects exit status 1, one line that begins with the file's name, and no new file.
    void expect_failure(const std::string& output, const ProgramOptions& options = {}) const {
        const auto before = folder_.names();
        const ProgramResult result = render(output, options);
        EXPECT_EQ(result.status, 1) << output << ": " << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_EQ(result.err.find(output), 0u) << result.err;
        EXPECT_EQ(folder_.names(), before);
    }

    TemporaryFolder folder_;
};

TEST_F(Output, PlacesThatCannotBeWritten) {
    fs::create_directory(folder_.file("folder.exr"));
    fs::create_directory(folder_.file("folder.png"));
    ASSERT_EQ(::mkfifo(folder_.file("pipe.exr").c_str(), 0600), 0);
    fs::create_symlink("/dev/full", folder_.file("full.exr"));
    for (const char* output : {"folder.exr", "folder.png", "missing/out.exr", "missing/out.png", "cube.obj/out.exr",
                               "pipe.exr", "full.exr", "/proc/out.exr", "/proc/out.tif"}) {
        expect_failure(output);
    }
    const std::string long_name(300, 'x');
    expect_failure(long_name + ".exr");
}

TEST_F(Output, AFolderWithoutPermission) {
    ProgramOptions options;
    options.obeys_permissions = true;
    fs::create_directory(folder_.file("locked"));
    fs::permissions(folder_.file("locked"), fs::perms::owner_read | fs::perms::owner_exec);
    expect_failure("locked/out.exr", options);
    expect_failure("locked/out.png", options);
    fs::permissions(folder_.file("locked"), fs::perms::owner_all);
}

TEST_F(Output, StatsThatCannotBeWrittenFailBeforeTheWork) {
    const ProgramResult result = render("out.exr", {}, {"--stats", "missing/stats.json"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err.find("missing/stats.json: "), 0u) << result.err;
    EXPECT_TRUE(is_one_line(result.err));
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"cube.obj"});
}

TEST_F(Output, AFullDisk) {
    // The thread sanitizer writes a file there before the program begins, if it can.
    ::setenv("TMPDIR", folder_.file("nowhere").c_str(), 1);
    for (const std::string output : {"out.exr", "out.png", "out.tif"}) {
        const ProgramResult unlimited = render(output);
        ASSERT_EQ(unlimited.status, 0) << output << ": " << unlimited.err;
        const std::size_t size = fs::file_size(folder_.file(output));
        fs::remove(folder_.file(output));
        ProgramOptions full;
        for (const std::size_t limit : {std::size_t{0}, size / 2, size - 1}) {
            full.file_size_limit = limit;
            expect_failure(output, full);
        }
        folder_.write(output, "old");
        expect_failure(output, full);
        EXPECT_EQ(read_file(folder_.file(output)), "old");
        ProgramOptions enough;
        enough.file_size_limit = size;
        const ProgramResult again = render(output, enough);
        EXPECT_EQ(again.status, 0) << output << ": " << again.err;
    }
    ::unsetenv("TMPDIR");
}

TEST_F(Output, AFullDiskForStats) {
    ProgramOptions full;
    full.file_size_limit = 10;
    const ProgramResult result = render("out.exr", full, {"--stats", "stats.json"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"cube.obj"});
}

TEST_F(Output, ReplacesAnOlderFile) {
    folder_.write("out.exr", "old");
    ASSERT_EQ(render("out.exr").status, 0);
    EXPECT_EQ(read_exr(folder_.file("out.exr")).width(), 60);
    EXPECT_EQ(folder_.names().size(), 2u);
}

TEST_F(Output, ThroughASymbolicLink) {
    fs::create_directory(folder_.file("shots"));
    folder_.write("shots/target.exr", "old");
    fs::create_symlink("shots/target.exr", folder_.file("link.exr"));
    ASSERT_EQ(render("link.exr").status, 0);
    EXPECT_TRUE(fs::is_symlink(folder_.file("link.exr")));
    EXPECT_EQ(read_exr(folder_.file("shots/target.exr")).width(), 60);
    fs::create_directory_symlink("shots", folder_.file("latest"));
    ASSERT_EQ(render("latest/other.exr").status, 0);
    EXPECT_TRUE(fs::exists(folder_.file("shots/other.exr")));
}

TEST_F(Output, NamesWithSpacesAndUmlauts) {
    folder_.write("mein Ordner/Würfel 立方体.obj", kCubeObj);
    folder_.write("mein Ordner/Szene.toml", "[[object]]\nfile = \"Würfel 立方体.obj\"\n");
    fs::create_directory(folder_.file("Bilder für 'alle'"));
    for (const char* output : {"Bilder für 'alle'/große Würfel.exr", "Bilder für 'alle'/große Würfel.png",
                               "./mein Ordner/../mein Ordner/a.exr", "-out.exr"}) {
        for (const char* input : {"mein Ordner/Würfel 立方体.obj", "mein Ordner/Szene.toml"}) {
            const ProgramResult result =
                run_burin(folder_.path(), {"render", input, "-r", "20x20", std::string("--output=") + output});
            EXPECT_EQ(result.status, 0) << result.err;
            EXPECT_TRUE(fs::exists(folder_.file(output)));
            fs::remove(folder_.file(output));
        }
    }
    // A path need not be UTF-8.
    folder_.write("M\xFCller.obj", kCubeObj);
    EXPECT_EQ(run_burin(folder_.path(), {"render", "M\xFCller.obj", "-r", "9x9", "-o", "M\xFCller.exr"}).status, 0);
}

TEST_F(Output, UpperCaseExtensions) {
    folder_.write("CUBE.OBJ", kCubeObj);
    for (const char* output : {"A.EXR", "A.Png", "A.TIFF"}) {
        EXPECT_EQ(run_burin(folder_.path(), {"render", "CUBE.OBJ", "-r", "9x9", "-o", output}).status, 0) << output;
    }
    EXPECT_EQ(read_file(folder_.file("A.Png")).substr(1, 3), "PNG");
    EXPECT_EQ(read_file(folder_.file("A.TIFF")).substr(0, 2), "II");
}

TEST_F(Output, ClosedStandardStreamsDoNotHarmTheFile) {
    // A file that gets the number of a closed stream would receive what is printed there.
    for (const char* output : {"out.exr", "out.png"}) {
        ASSERT_EQ(render(output).status, 0);
        const std::string expected = read_file(folder_.file(output));
        for (const std::vector<int>& closed : std::vector<std::vector<int>>{{0}, {2}, {0, 1}, {1, 2}, {0, 1, 2}}) {
            ProgramOptions options;
            options.closed_streams = closed;
            ASSERT_EQ(render(output, options, {"--progress", "alf", "-v", "--stats", "-"}).status, 0);
            EXPECT_TRUE(read_file(folder_.file(output)) == expected) << output;
            EXPECT_EQ(run_burin(folder_.path(), {"info", "cube.obj"}, options).status, 0);
        }
    }
}

TEST_F(Output, TwoRendersAtOnceDoNotDisturbEachOther) {
    const Arguments arguments = {"render", "cube.obj", "-r", "300x200", "-o", "out.exr"};
    Program first(folder_.path(), arguments), second(folder_.path(), arguments);
    EXPECT_EQ(first.wait().status, 0);
    EXPECT_EQ(second.wait().status, 0);
    EXPECT_EQ(read_exr(folder_.file("out.exr")).width(), 300);
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"cube.obj", "out.exr"}));
}

}  // namespace
}  // namespace burin::test::output_test
