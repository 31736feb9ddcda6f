// Saved lines, drawn again.

#include <gtest/gtest.h>

#include "scene/sheet_library.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::restyle_test {
namespace {

using Arguments = std::vector<std::string>;

std::string scene_file(const std::string& name) { return std::string(BURIN_SOURCE_FOLDER) + "/scenes/" + name; }

ProgramResult run_in(const TemporaryFolder& folder, Arguments arguments, const Arguments& more = {}) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_burin(folder.path(), arguments);
}

TEST(Restyle, EqualsARenderToTheBit) {
    ASSERT_GE(built_in_sheets().size(), 9u);
    for (const char* const scene : {"still_life.toml", "crossing.toml", "teapot.toml"}) {
        for (const BuiltInSheet& sheet : built_in_sheets()) {
            const std::string style(sheet.name);
            for (const Arguments& crop : {Arguments{}, Arguments{"--crop", "40,30,110,80"}}) {
                SCOPED_TRACE(std::string(scene) + " " + style + (crop.empty() ? "" : " crop"));
                const TemporaryFolder folder;
                const Arguments layers = {"--style", style, "--layers", "lines,lines_hidden,coverage"};
                Arguments render = {"render", scene_file(scene), "-o",     "a.exr", "-r", "160x120",
                                    "-q",     "--save-lines",    "a.lines"};
                render.insert(render.end(), layers.begin(), layers.end());
                ASSERT_EQ(run_in(folder, render, crop).err, "");
                Arguments restyle = {"restyle", "a.lines", "-o", "b.exr", "-j", "1", "-q"};
                restyle.insert(restyle.end(), layers.begin(), layers.end());
                ASSERT_EQ(run_in(folder, restyle, crop).err, "");
                EXPECT_TRUE(read_file(folder.file("a.exr")) == read_file(folder.file("b.exr")));
            }
        }
    }
}

TEST(Restyle, DrawsOverTheSurfacesThatWereKept) {
    const TemporaryFolder folder;
    const std::string scene = scene_file("still_life.toml");
    ASSERT_EQ(run_in(folder, {"render", scene, "-o", "a.png", "-r", "160x120", "-q", "--style", "technical",
                              "--save-lines", "a.lines", "--save-surface", "--find", "all"})
                  .err,
              "");
    ASSERT_EQ(
        run_in(folder, {"render", scene, "-o", "b.png", "-r", "160x120", "-q", "--style", "strata", "--find", "all"})
            .err,
        "");
    const ProgramResult result = run_in(folder, {"restyle", "a.lines", "-o", "c.png", "--style", "strata", "-q"});
    ASSERT_EQ(result.err, "");
    EXPECT_TRUE(read_file(folder.file("b.png")) == read_file(folder.file("c.png")));
}

TEST(Restyle, SaysThatSurfacesAreNotDrawnAgain) {
    const TemporaryFolder folder;
    const std::string scene = scene_file("crossing.toml");
    for (const bool saves_surfaces : {false, true}) {
        Arguments render = {"render", scene, "-o", "a.png", "-r", "80x60", "-q", "--style", "comic"};
        const Arguments more = {"--save-lines", "a.lines", "--save-surface"};
        render.insert(render.end(), more.begin(), more.end() - (saves_surfaces ? 0 : 1));
        ASSERT_EQ(run_in(folder, render).err, "");
        const auto notes = [&](const std::string& value) {
            const ProgramResult result =
                run_in(folder, {"restyle", "a.lines", "-o", "b.png", "--style", "comic", "--set", value});
            EXPECT_EQ(result.status, 0) << result.err;
            return result.err;
        };
        EXPECT_EQ(notes("style.surfaces.normals=flat"),
                  std::string("burin: note: --set style.surfaces.normals changes nothing: ") +
                      (saves_surfaces ? "surfaces stay as they were saved; render draws them again\n"
                                      : "the lines were saved without surfaces; render draws them\n"));
        EXPECT_EQ(notes("style.width=2"), "");
    }
}

TEST(Restyle, KnowsTheLightOfTheScene) {
    const TemporaryFolder folder;
    // Its light is not at the eye, and widths of the sheet `comic` come from light.
    const std::string scene = scene_file("shaded.toml");
    ASSERT_EQ(run_in(folder, {"render", scene, "-o", "a.exr", "-r", "160x120", "-q", "--style", "comic", "--layers",
                              "lines", "--save-lines", "a.lines"})
                  .err,
              "");
    ASSERT_EQ(run_in(folder, {"restyle", "a.lines", "-o", "b.exr", "--style", "comic", "--layers", "lines"}).err, "");
    EXPECT_TRUE(read_file(folder.file("a.exr")) == read_file(folder.file("b.exr")));
    ASSERT_EQ(run_in(folder, {"restyle", "a.lines", "-o", "c.exr", "--style", "comic", "--layers", "lines", "--set",
                              "style.light=[1, 0, 0]"})
                  .err,
              "");
    EXPECT_FALSE(read_file(folder.file("a.exr")) == read_file(folder.file("c.exr")));
}

TEST(Restyle, SaysWhatTheFileLacks) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_in(folder, {"render", scene_file("crossing.toml"), "-o", "a.png", "-r", "80x60", "-q", "--style",
                              "wireframe", "--save-lines", "a.lines"})
                  .status,
              0);
    const ProgramResult result = run_in(folder, {"restyle", "a.lines", "-o", "b.png", "--style", "technical"});
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("a.lines: the file lacks what the style sheet needs: "), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("hidden lines"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("--find all"), std::string::npos) << result.err;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.lines", "a.png"}));
}

TEST(Restyle, RefusesWhatMakesNoSense) {
    const TemporaryFolder folder;
    const std::string scene = scene_file("crossing.toml");
    const auto refusal = [&](const Arguments& arguments) {
        const ProgramResult result = run_in(folder, arguments);
        EXPECT_EQ(result.status, 2) << result.err;
        return result.err;
    };
    EXPECT_EQ(refusal({"render", scene, "-o", "a.png", "--save-lines", "a.lines"}),
              "burin: --save-lines: lines are found for a style sheet; give one with --style\n");
    EXPECT_EQ(refusal({"render", scene, "-o", "a.png", "--style", "comic", "--save-surface"}),
              "burin: --save-surface: needs --save-lines\n");
    EXPECT_NE(refusal({"restyle", "a.lines"}).find("--style"), std::string::npos);
    const ProgramResult none = run_in(folder, {"restyle", "a.lines", "--style", "comic"});
    EXPECT_EQ(none.status, 1);
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace burin::test::restyle_test
