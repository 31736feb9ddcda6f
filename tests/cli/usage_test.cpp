// Wrong usage: exit status 2, one line that names the option, and nothing written.

#include <gtest/gtest.h>

#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::usage_test {
namespace {

using Arguments = std::vector<std::string>;

class Usage : public testing::Test {
  protected:
    Usage() {
        folder_.write("cube.obj", kCubeObj);
        folder_.write("scene.toml", "[[object]]\nfile='cube.obj'\n[[camera]]\nname='front'\neye=[1,2,9]\n");
    }

    /// Runs it and expects wrong usage; `words` must be in the message.
    void expect_refused(const Arguments& arguments, const std::string& words) const {
        std::string all;
        for (const std::string& a : arguments) all += a + " ";
        const ProgramResult result = run_burin(folder_.path(), arguments);
        EXPECT_EQ(result.status, 2) << all << "\n" << result.err;
        EXPECT_EQ(result.out, "") << all;
        EXPECT_TRUE(is_one_line(result.err)) << all << "\n" << result.err;
        EXPECT_EQ(result.err.find("burin: "), 0u) << all << "\n" << result.err;
        EXPECT_NE(result.err.find(words), std::string::npos) << all << "\n" << result.err;
        EXPECT_EQ(folder_.names(), (std::vector<std::string>{"cube.obj", "scene.toml"})) << all;
    }
    /// Expects that render refuses these options.
    void expect_bad_options(const Arguments& options, const std::string& words) const {
        Arguments arguments = {"render", "cube.obj", "-o", "out.exr"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        expect_refused(arguments, words);
    }

    TemporaryFolder folder_;
};

TEST_F(Usage, CommandsAndInputs) {
    expect_refused({"draw"}, "'draw' is no command");
    expect_refused({"cube.obj", "render"}, "'cube.obj' is no command");
    expect_refused({""}, "'' is no command");
    expect_refused({"-o", "out.exr"}, "'-o' is no command");
    expect_refused({"render"}, "INPUT");
    expect_refused({"info"}, "INPUT");
    expect_refused({"info", "cube.obj", "scene.toml"}, "scene.toml");
    expect_refused({"render", "cube.obj", "scene.toml"}, "scene.toml");
    expect_refused({"render", ""}, "empty");
    expect_refused({"methods", "x"}, "x");
    expect_refused({"info", "cube.obj", "-o", "x.png"}, "-o");
    expect_refused({"--frobnicate"}, "--frobnicate");
    // Without anything the help comes first, on standard error.
    const ProgramResult nothing = run_burin(folder_.path(), {});
    EXPECT_EQ(nothing.status, 2);
    EXPECT_EQ(nothing.out, "");
    EXPECT_NE(nothing.err.find("render"), std::string::npos);
}

TEST_F(Usage, PatternsNeedFrames) {
    for (const char* output : {"a.####.exr", "a.%04d.png", "a.####.pdf"}) {
        expect_refused({"render", "cube.obj", "-o", output}, "--frames");
    }
}

TEST_F(Usage, Memory) {
    for (const char* size : {"0", "0G", "-2G", "2X", "G", "2GG", "2 G", "1e9", "0x10", "inf", "nan", "2,5G", "M2",
                             "9999999999T", "0.0001"}) {
        expect_bad_options({"--memory", size}, "--memory: ");
    }
    expect_bad_options({"--memory", "2G", "-m", "patel"}, "--memory: method patel cannot render in pieces");
    expect_refused({"compare", "cube.obj", "-o", "report", "--memory", "2G"}, "--memory");
}

TEST_F(Usage, UnknownNames) {
    expect_bad_options({"-m", "magic"}, "--method: unknown method 'magic'");
    expect_bad_options({"--lines", "silhouette,edge"}, "--lines: unknown line class 'edge'");
    expect_bad_options({"-m", "gbuffer", "--operator", "id,edges"},
                       "--operator: unknown operator 'edges'; known are first,second");
    expect_bad_options({"--samples", "3"}, "--samples: must be 2, 4 or 8");
    expect_bad_options({"--supersample", "3"}, "--supersample: must be 1, 2, 4 or 8");
    expect_bad_options({"--supersample", "16"}, "--supersample: must be from 1 to 8");
    expect_bad_options({"--layers", "beauty,depth"}, "--layers: unknown layer 'depth'");
    expect_bad_options({"--hidden", "dotted"}, "--hidden: must be none, solid or dashed");
    expect_bad_options({"-m", "patel", "--hidden", "solid"}, "--hidden: method patel draws no hidden lines");
    expect_bad_options({"--progress", "fancy"}, "--progress");
    expect_bad_options({"--camera", "front"}, "--camera: there is no camera 'front'");
    expect_refused({"render", "scene.toml", "--camera", "side"}, "the input has front");
    expect_bad_options({"--unknown"}, "--unknown");
    expect_bad_options({"--siz", "1x1"},
                       "--siz");  // no abbreviations: they would change meaning later
    expect_bad_options({"-Z"}, "-Z");
    expect_bad_options({"3", "--line-widht"}, "unknown option '--line-widht'; did you mean '--line-width'?");
    expect_bad_options({"another.obj"}, "'another.obj': one input is enough");
    expect_refused({"methods", "another.obj"}, "'another.obj': burin methods takes no input");
    for (const char* output : {"a.jpg", "a.gif", "a.", "a.exr.bak"}) {
        expect_refused({"render", "cube.obj", "-o", output}, "--output: unknown kind of image");
    }
    for (const char* output : {"a", ".png"})
        expect_refused({"render", "cube.obj", "-o", output}, "--output: the name has no suffix");
}

TEST_F(Usage, Sizes) {
    for (const char* size : {"0x0",
                             "0x10",
                             "10x0",
                             "1000000000x1000000000",
                             "65536x1",
                             "1x65536",
                             "-1x5",
                             "5x-1",
                             "99999999999999999999x9",
                             "10",
                             "axb",
                             "10x",
                             "x10",
                             "10x10x10",
                             "10 x 10",
                             "10X10",
                             "1.5x2",
                             "1e2x1e2",
                             "0x10x10",
                             "x",
                             ""}) {
        expect_bad_options({"--size", size}, "--size");
        expect_bad_options({"-r", size}, "--size");
    }
}

TEST_F(Usage, WidthsAndAngles) {
    for (const char* value : {"0", "-1", "-.5", "nan", "inf", "-inf", "1025", "1e300", "wide", "1px", "1,5", ""}) {
        expect_bad_options({"-w", value}, "--line-width");
        expect_bad_options({std::string("--line-width=") + value}, "--line-width");
    }
    expect_bad_options({"-w", "0.5mm"},
                       "'0.5mm' is no finite number: it is in pixels; with a style sheet, --set style.width=0.5mm");
    for (const char* value : {"-1", "180.1", "nan", "flat", "", "45,35", "35,181", "35,40,45", "35,"})
        expect_bad_options({"--crease-angle", value}, "--crease-angle");
    for (const char* value : {"0", "180", "-35", "nan", "inf", "wide", ""})
        expect_bad_options({"--fov", value}, "--fov");
    for (const char* value : {"0", "-1", "nan", "inf", ""}) expect_bad_options({"--ortho", value}, "--ortho");
}

TEST_F(Usage, Cameras) {
    for (const char* option : {"--eye", "--target", "--up"}) {
        for (const char* value : {"1", "1,2", "1,2,3,4", "a,b,c", "1,2,", ",,", "1,2,nan", "inf,0,0", "1 2 3", ""}) {
            expect_bad_options({option, value}, option);
        }
        expect_bad_options({option, "-a,b,c"}, "must be three numbers");  // a value, not options
        expect_bad_options({option}, option);                             // at the end, without a value
    }
    expect_bad_options({"--eye", "1,2,3", "--target", "1,2,3"}, "same place");
    expect_bad_options({"--eye", "0,0,0"}, "same place");  // the middle of the cube
    expect_bad_options({"--eye", "0,5,0", "--up", "0,1,0"}, "up vector");
    expect_bad_options({"--eye", "0,0,5", "--up", "0,0,-2"}, "up vector");
    expect_bad_options({"--eye", "0,0,5", "--up", "0,0,0"}, "up vector is zero");
    expect_bad_options({"--eye", "1e300,0,0"}, "1e30");
    expect_bad_options({"--fov", "30", "--ortho", "5"}, "--ortho");
    expect_refused({"render", "scene.toml", "--camera", "front", "--fov", "30"}, "--camera");
    expect_refused({"render", "scene.toml", "--target", "1,2,9"},
                   "same place");  // the eye of the scene
}

TEST_F(Usage, Crops) {
    for (const char* crop : {"0,0,0,0", "5,5,5,9", "9,5,5,9", "0,0,101,100", "0,0,100,101", "-1,0,10,10", "0,-1,9,9",
                             "1,2,3", "1,2,3,4,5", "a,b,c,d", "0,0,1.5,2", ""}) {
        expect_bad_options({"-r", "100x100", "--crop", crop}, "--crop");
    }
}

TEST_F(Usage, OtherValues) {
    for (const char* value : {"0", "8", "32", "65", "512", "-64", "many", ""})
        expect_bad_options({"--mask", value}, "--mask");
    for (const char* value : {"0", "1", "10", "32", "x", ""}) expect_bad_options({"--bits", value}, "--bits");
    for (const char* value : {"-1", "1025", "1.5", "all", ""}) expect_bad_options({"-j", value}, "--threads");
    for (const char* value : {"0", "-1", "x", ""}) expect_bad_options({"--repeat", value}, "--repeat");
    for (const char* value : {"white", "#12", "#ggg", "fff", ""})
        expect_bad_options({"--background", value}, "--background");
    for (const char* option : {"-o", "-m", "--lines", "--layers", "--stats", "--camera", "--progress"}) {
        expect_refused({"render", "cube.obj", option, ""},
                       "empty");  // an unset variable of a script
    }
    expect_bad_options({"--lines", "none", "--layers", "coverage"}, "--layers");
    expect_bad_options({"-r", "10x10", "-r", "20x20"}, "--size: is given more than once");  // which one?
}

TEST_F(Usage, Overrides) {
    for (const char* value : {"lines.width", "=2", "lines.width=-1", "lines.width=fat", "lines.widht=2", "=", "",
                              "lines..width=1", "object.7.scale=2", "a.b.c=1"}) {
        expect_bad_options({"--set", value}, "--set");
    }
    expect_bad_options({"--set", "lines.width=2", "--set", "lines.draw=7"}, "--set lines.draw=7");
    expect_bad_options({"--set"}, "--set");
    expect_bad_options({"--set", "lines.color=a\nb"}, "a?b");  // still one line
}

TEST_F(Usage, EmptyAndMissingValues) {
    for (const char* option : {"--hidden", "--output", "--eye", "--set", "--line-width", "--style"}) {
        const std::string message = std::string("burin: ") + option + ": the value is empty\n";
        // Neither is what stands behind it its value.
        expect_refused({"render", std::string(option) + "=", "cube.obj"}, message);
        expect_refused({"render", "cube.obj", std::string(option) + "="}, message);
    }
    expect_refused({"render", "cube.obj", "--hidden"}, "--hidden: a value is missing; see burin render --help");
    expect_refused({"render"}, "INPUT is required; see burin render --help");
    expect_refused({"compare", "cube.obj"}, "--output is required; see burin compare --help");
}

TEST_F(Usage, WordsThatContradictEachOther) {
    expect_bad_options({"-v", "-q"}, "-v: cannot stand beside -q; remove one");
    for (const char* classes : {"all,none", "none,all", "none,crease"})
        expect_bad_options({"--lines", classes}, "--lines: none cannot stand beside other words; remove one");
}

TEST_F(Usage, StatsMustNotDestroyFiles) {
    expect_refused({"render", "cube.obj", "-o", "out.exr", "--stats", "out.exr"}, "--stats: would overwrite");
    expect_refused({"render", "cube.obj", "-o", "out.exr", "--stats", "./cube.obj"}, "--stats: would overwrite");
}

}  // namespace
}  // namespace burin::test::usage_test
