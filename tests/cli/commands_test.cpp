// help, version, methods, info, explain.

#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "lines/line_class.h"
#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::commands_test {
namespace {

using Json = nlohmann::json;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Commands, HelpNamesCommandsAndOptions) {
    const TemporaryFolder folder;
    const ProgramResult help = run_burin(folder.path(), {"--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.err, "");
    for (const char* command :
         {"render", "restyle", "compare", "info", "explain", "methods", "styles", "submit", "assemble"}) {
        EXPECT_TRUE(contains(help.out, command)) << command;
        const ProgramResult own = run_burin(folder.path(), {command, "--help"});
        EXPECT_EQ(own.status, 0);
        EXPECT_EQ(own.err, "");
        EXPECT_NE(own.out, help.out);
    }
    const std::string render = run_burin(folder.path(), {"render", "-h"}).out;
    for (const char* option : {"--output",
                               "--size",
                               "--eye",
                               "--target",
                               "--up",
                               "--fov",
                               "--ortho",
                               "--camera",
                               "--method",
                               "--mask",
                               "--samples",
                               "--lines",
                               "--line-width",
                               "--crease-angle",
                               "--hidden",
                               "--style",
                               "--layers",
                               "--frames",
                               "--crop",
                               "--threads",
                               "--memory",
                               "--memory-model",
                               "--depth-complexity",
                               "--stats",
                               "--set",
                               "--repeat",
                               "--progress",
                               "--bits",
                               "--strict",
                               "--background",
                               "-v",
                               "-q",
                               "-o",
                               "-r",
                               "-m",
                               "-w",
                               "-f",
                               "-j"}) {
        EXPECT_TRUE(contains(render, option)) << option;
    }
    EXPECT_TRUE(folder.names().empty());
}

TEST(Commands, Version) {
    const ProgramResult result = run_burin("/", {"--version"});
    EXPECT_EQ(result.status, 0);
    EXPECT_TRUE(is_one_line(result.out)) << result.out;
    EXPECT_EQ(result.out.find("burin "), 0u);
    EXPECT_EQ(result.err, "");
}

TEST(Commands, MethodsAsTextAndJson) {
    const ProgramResult text = run_burin("/", {"methods"});
    EXPECT_EQ(text.status, 0);
    EXPECT_TRUE(contains(text.out, "patel"));
    const ProgramResult json = run_burin("/", {"methods", "--json"});
    EXPECT_EQ(json.status, 0);
    EXPECT_EQ(json.err, "");
    const Json methods = Json::parse(json.out).at("methods");
    ASSERT_FALSE(methods.empty());
    for (const Json& method : methods) {
        EXPECT_FALSE(method.at("name").get<std::string>().empty());
        EXPECT_FALSE(method.at("source").get<std::string>().empty());
        EXPECT_TRUE(contains(text.out, method.at("name").get<std::string>()));
        for (const Json& line_class : method.at("draws")) {
            EXPECT_TRUE(line_class_named(line_class.get<std::string>()).has_value());
        }
    }
}

TEST(Commands, InfoAsJson) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    const ProgramResult result = run_burin(folder.path(), {"info", "cube.obj", "--json"});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    const Json info = Json::parse(result.out);
    EXPECT_EQ(info.at("file"), "cube.obj");
    EXPECT_EQ(info.at("meshes"), 1);
    EXPECT_EQ(info.at("objects"), 1);
    EXPECT_EQ(info.at("triangles"), 12);
    EXPECT_EQ(info.at("polygons"), 6);
    EXPECT_EQ(info.at("bounds").at("min"), Json::array({-1, -1, -1}));
    EXPECT_EQ(info.at("bounds").at("max"), Json::array({1, 1, 1}));
    EXPECT_EQ(info.at("materials").size(), 1u);
    EXPECT_EQ(info.at("cameras").size(), 0u);  // the file has none
    EXPECT_EQ(info.at("object_list").at(0).at("name"), "cube");
}

TEST(Commands, InfoOfAScene) {
    const TemporaryFolder folder;
    folder.write("models/cube.obj", kCubeObj);
    folder.write("scene.toml", R"(
[[material]]
name = "glass"
opacity = 0.5
[[object]]
file = "models/cube.obj"
material = "glass"
translate = [10, 0, 0]
[[object]]
file = "models/cube.obj"
[[camera]]
name = "front"
fov = 50
[[camera]]
name = "plan"
height = 3
)");
    const Json info = Json::parse(run_burin(folder.path(), {"info", "--json", "scene.toml"}).out);
    EXPECT_EQ(info.at("meshes"), 1);
    EXPECT_EQ(info.at("objects"), 2);
    EXPECT_EQ(info.at("triangles"), 24);
    EXPECT_EQ(info.at("bounds").at("max"), Json::array({11, 1, 1}));
    EXPECT_EQ(info.at("materials").at(0).at("name"), "glass");
    EXPECT_EQ(info.at("materials").at(0).at("opacity"), 0.5);
    EXPECT_EQ(info.at("cameras").at(0).at("name"), "front");
    EXPECT_EQ(info.at("cameras").at(0).at("fov_deg"), 50);
    EXPECT_EQ(info.at("cameras").at(1).at("projection"), "orthographic");
    EXPECT_EQ(info.at("cameras").at(1).at("height"), 3);
}

TEST(Commands, InfoAsText) {
    const TemporaryFolder folder;
    folder.write("cube.obj", std::string("o a\x1b[31mb\n") + kCubeObj);
    const ProgramResult result = run_burin(folder.path(), {"info", "cube.obj"});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    for (const char* word : {"cube.obj", "objects", "triangles  12", "bounds", "edges", "materials", "cameras"}) {
        EXPECT_TRUE(contains(result.out, word)) << word;
    }
    EXPECT_FALSE(contains(result.out, "\x1b"));  // names must not steer the terminal
}

TEST(Commands, InfoReadsEveryFormat) {
    const TemporaryFolder folder;
    const auto models = tetrahedra();
    for (const auto& [name, content] : models) folder.write(name, content);
    for (const auto& [name, content] : models) {
        if (name == "tetra.bin" || name == "scene.toml") continue;
        const ProgramResult result = run_burin(folder.path(), {"info", name, "--json"});
        ASSERT_EQ(result.status, 0) << name << ": " << result.err;
        const Json info = Json::parse(result.out);
        EXPECT_EQ(info.at("triangles"), 4) << name;
        EXPECT_EQ(info.at("edges").at("total"), 6) << name;
        EXPECT_EQ(info.at("bounds").at("max"), Json::array({1, 1, 1})) << name;
    }
}

TEST(Commands, ExplainShowsThePixel) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    const std::vector<std::string> view = {"--eye", "0,0,5", "--target", "0,0,0", "--ortho", "4", "-r", "100x100"};
    const auto explain = [&](const std::string& pixel) {
        std::vector<std::string> arguments = {"explain", "cube.obj", "--pixel", pixel};
        arguments.insert(arguments.end(), view.begin(), view.end());
        const ProgramResult result = run_burin(folder.path(), arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(result.err, "");
        return result.out;
    };
    EXPECT_TRUE(contains(explain("2,2"), "0 fragments"));
    EXPECT_TRUE(contains(explain("2,2"), "no line is drawn"));
    EXPECT_TRUE(contains(explain("50,50"), "\"cube\""));
    EXPECT_TRUE(contains(explain("50,50"), "no line is drawn"));
    EXPECT_TRUE(contains(explain("25,50"), "silhouette"));  // the left side of the cube
    EXPECT_TRUE(folder.names() == std::vector<std::string>{"cube.obj"});
}

TEST(Commands, ExplainWantsAPixelWithinThePicture) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    for (const char* pixel : {"100,0", "0,100", "-1,0", "0,-1", "1", "1,2,3", "a,b", "1.5,2", ""}) {
        const ProgramResult result =
            run_burin(folder.path(), {"explain", "cube.obj", "-r", "100x100", "--pixel", pixel});
        EXPECT_EQ(result.status, 2) << pixel;
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_EQ(result.out, "");
    }
    EXPECT_EQ(run_burin(folder.path(), {"explain", "cube.obj"}).status, 2);
}

TEST(Commands, WhatCannotBePrintedIsAFailure) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    ProgramOptions full;
    full.stdout_file = "/dev/full";
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"info", "cube.obj"},
                                               {"methods"},
                                               {"--help"},
                                               {"explain", "cube.obj", "--pixel", "1,1"},
                                               {"render", "cube.obj", "-o", "a.exr", "-r", "9x9", "--stats", "-"}}) {
        const ProgramResult result = run_burin(folder.path(), arguments, full);
        EXPECT_EQ(result.status, 1) << arguments[0];
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
    }
}

TEST(Commands, AReaderThatGoesAwayIsNoFaultOfAListing) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    ProgramOptions gone;
    gone.has_reader = false;
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"styles"},
                                               {"styles", "pencil"},
                                               {"methods", "--json"},
                                               {"info", "cube.obj"},
                                               {"explain", "cube.obj", "--pixel", "1,1"},
                                               {"render", "cube.obj", "--dry-run"},
                                               {"--help-all"},
                                               {"--version"}}) {
        const ProgramResult result = run_burin(folder.path(), arguments, gone);
        EXPECT_EQ(result.status, 128 + SIGPIPE) << arguments[0];
        EXPECT_EQ(result.err, "") << arguments[0];
    }
    // Where there is a file, too, it is finished, and what is lost is said.
    const ProgramResult result =
        run_burin(folder.path(), {"render", "cube.obj", "-o", "a.exr", "-r", "9x9", "--stats", "-"}, gone);
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contains(result.err, "standard output: cannot write")) << result.err;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.exr", "cube.obj"}));
}

/// At an edge of the engine that is a border and a silhouette by turns, one stroke has several parts.
TEST(Explain, NamesEachStrokeOnce) {
    const TemporaryFolder folder;
    folder.write("s.toml",
                 "[[set]]\nname = \"a\"\nclasses = [\"silhouette\", \"border\"]\nstyle = \"ink\"\n"
                 "[style.ink]\nwidth = \"=4 + t\"\n");
    const ProgramResult result =
        run_burin(folder.path(), {"explain", std::string(BURIN_SOURCE_FOLDER) + "/scenes/engine.toml", "--style",
                                  "./s.toml", "--pixel", "1823,680", "--json"});
    const Json strokes = Json::parse(result.out)["strokes"];
    EXPECT_EQ(strokes.size(), 1u) << result.out;
}

}  // namespace
}  // namespace burin::test::commands_test
