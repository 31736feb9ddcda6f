// Vector files from the command line.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::vector_test {
namespace {

std::string scene_file(const std::string& name) { return std::string(BURIN_SOURCE_FOLDER) + "/scenes/" + name; }

/// But for surfaces, which files of lines know as pixels only.
TEST(VectorFiles, RenderAndRestyleWriteTheSame) {
    const TemporaryFolder folder;
    for (const char* const style : {"technical", "pencil"}) {
        ASSERT_EQ(run_burin(folder.path(),
                            {"render", scene_file("still_life.toml"), "-o", "a.svg", "-r", "160x120", "-q", "--style",
                             style, "--find", "all", "--save-lines", "a.lines", "--set", "surfaces.shading=paper"})
                      .err,
                  "");
        ASSERT_EQ(
            run_burin(folder.path(), {"restyle", "a.lines", "-o", "b.svg", "--style", style, "-j", "1", "-q"}).err, "");
        EXPECT_TRUE(read_file(folder.file("a.svg")) == read_file(folder.file("b.svg"))) << style;
    }
}

/// Technical needs chains of hidden lines only: beside pixels those of visible ones are not kept, and a note says so.
TEST(VectorFiles, RestyleSaysWhereALinesFileHasNoChains) {
    const TemporaryFolder folder;
    const auto save_beside = [&](const std::string& output) {
        const std::vector<std::string> arguments = {"render",    scene_file("still_life.toml"),
                                                    "-o",        output,
                                                    "-r",        "320x240",
                                                    "-q",        "--style",
                                                    "technical", "--save-lines",
                                                    "a.lines"};
        ASSERT_EQ(run_burin(folder.path(), arguments).err, "");
    };
    const auto restyle = [&] {
        return run_burin(folder.path(), {"restyle", "a.lines", "-o", "b.svg", "--style", "technical"}).err;
    };
    save_beside("a.png");
    EXPECT_NE(restyle().find("note: the lines were saved beside pixels"), std::string::npos);
    save_beside("a.svg");
    EXPECT_EQ(restyle().find("note: the lines were saved beside pixels"), std::string::npos);
}

TEST(VectorFiles, OptionsSayWhatIsInThem) {
    const TemporaryFolder folder;
    const auto svg = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {"render", scene_file("cube.toml"), "-o", "a.svg", "-r", "160x120", "-q"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(run_burin(folder.path(), arguments).err, "");
        return read_file(folder.file("a.svg"));
    };
    const auto has = [](const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    };
    const std::string plain = svg({"--hidden", "dashed"});
    EXPECT_TRUE(has(plain, "width=\"42.333332mm\" height=\"31.749998mm\" viewBox=\"0 0 160 120\""));
    EXPECT_TRUE(has(plain, "inkscape:label=\"1 visible\"") && has(plain, "inkscape:label=\"2 hidden\""));
    EXPECT_TRUE(has(plain, "stroke-dasharray=") && has(plain, "data-edge=") && has(plain, "id=\"paper\""));
    EXPECT_FALSE(has(svg({"--hidden", "dashed", "--dashes", "real"}), "stroke-dasharray"));
    EXPECT_FALSE(has(svg({"--ids", "none"}), "data-edge"));
    EXPECT_FALSE(has(svg({"--background", "transparent"}), "id=\"paper\""));
    EXPECT_TRUE(has(svg({"--background", "#ff0000"}), "fill=\"#f00\""));
    EXPECT_TRUE(has(svg({"--dpi", "25.4"}), "width=\"160mm\""));
    EXPECT_TRUE(has(svg({"--crop", "20,10,120,100"}), "viewBox=\"20 10 100 90\""));
    EXPECT_TRUE(has(svg({"--group", "object"}), "<g id=\"visible-o"));
    EXPECT_TRUE(has(svg({"--stats", "a.json"}), "<path"));
    EXPECT_TRUE(has(read_file(folder.file("a.json")), "\"clean\""));
}

/// Surfaces are filled below lines, glass lets through, and lines are those of a file without surfaces.
TEST(VectorFiles, SurfacesAreFilled) {
    const TemporaryFolder folder;
    folder.write("a.toml", R"([camera]
eye = [4, 3, 6]
target = [0, 0, 0]
[[material]]
name = "red"
color = "#d04030"
[[material]]
name = "glass"
color = "#60d0a0"
opacity = 0.4
[[object]]
name = "box"
shape = "box"
material = "red"
[[object]]
name = "pane"
shape = "box"
size = [1.5, 1.5, 0.02]
material = "glass"
translate = [0.3, 0.3, 1.6]
)");
    const auto file = [&](const std::string& name, std::vector<std::string> more) {
        std::vector<std::string> arguments = {"render", "a.toml", "-o", name, "-r", "320x240", "-q"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(run_burin(folder.path(), arguments).err, "");
        return read_file(folder.file(name));
    };
    const auto lines_of = [](const std::string& svg) { return svg.substr(svg.find("<g id=\"layer-visible\"")); };
    const std::string plain = file("a.svg", {});
    const std::string flat = file("a.svg", {"--set", "surfaces.shading=flat"});
    EXPECT_EQ(plain.find("surfaces"), std::string::npos);
    EXPECT_EQ(lines_of(plain), lines_of(flat));
    EXPECT_LT(flat.find("layer-surfaces"), flat.find("layer-visible"));
    EXPECT_NE(flat.find("inkscape:label=\"box\" fill=\"#d04030\" stroke=\"#d04030\" stroke-width=\"0.5\""),
              std::string::npos);
    EXPECT_NE(flat.find("fill=\"#60d0a0\" stroke=\"none\" fill-opacity=\"0.6"), std::string::npos);  // two panes
    EXPECT_EQ(flat, file("b.svg", {"--set", "surfaces.shading=flat", "-j", "3"}));
    EXPECT_EQ(file("a.svg", {"--set", "surfaces.shading=flat", "--page", "plotter"}).find("surfaces"),
              std::string::npos);
    const std::string sheet = file("a.svg", {"--set", "surfaces.shading=flat", "--views", "front,top"});
    EXPECT_EQ(sheet.find("layer-surfaces"), sheet.rfind("layer-surfaces"));
    EXPECT_NE(sheet.find("id=\"top-s"), std::string::npos);
}

/// Readers that round up, as librsvg does, and those that do not, make the picture's pixels of a file's millimetres.
TEST(VectorFiles, MillimetresAreThePixels) {
    const TemporaryFolder folder;
    for (const int width : {54, 139, 168, 1919, 2040}) {
        ASSERT_EQ(run_burin(folder.path(), {"render", scene_file("cube.toml"), "-o", "a.svg", "-q", "-r",
                                            std::to_string(width) + "x50"})
                      .err,
                  "");
        const std::string svg = read_file(folder.file("a.svg"));
        const double mm = std::stod(svg.substr(svg.find(" width=\"") + 8));
        for (const double px : {mm / 25.4 * 96, static_cast<double>(static_cast<float>(mm)) / 25.4 * 96}) {
            EXPECT_LE(px, width);
            EXPECT_GT(px, width - 1e-3);
        }
    }
}

/// No film is made for them: a picture that has 64 million pixels takes little memory.
TEST(VectorFiles, TakeNoPixels) {
    const TemporaryFolder folder;
    const auto run = run_burin(folder.path(), {"render", scene_file("cube.toml"), "-o", "a.svg", "-q", "-r",
                                               "8000x8000", "--stats", "a.json"});
    EXPECT_EQ(run.err, "");
    const nlohmann::json stats = nlohmann::json::parse(read_file(folder.file("a.json")));
    EXPECT_LT(stats["peak_rss_bytes"].get<double>(), 400e6);
}

TEST(VectorFiles, WhatCannotBeIsRefusedOrNoted) {
    const TemporaryFolder folder;
    const std::string cube = scene_file("cube.toml");
    const auto err = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {"render", cube, "-r", "160x120"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_burin(folder.path(), arguments).err;
    };
    EXPECT_NE(err({"-o", "a.svg", "-m", "patel"}).find("makes pixels only"), std::string::npos);
    EXPECT_NE(err({"-o", "a.svg", "--tolerance", "0"}).find("--tolerance"), std::string::npos);
    EXPECT_NE(err({"-o", "a.svg", "--dashes", "some"}).find("pattern or real"), std::string::npos);
    EXPECT_NE(err({"-o", "a.svg", "--group", "colour"}).find("class, object or qi"), std::string::npos);
    EXPECT_NE(err({"-o", "a.png", "--group", "object"}).find("are for vector files"), std::string::npos);
    EXPECT_EQ(err({"-o", "a.svg", "--set", "surfaces.shading=flat"}), "");
    EXPECT_NE(err({"-o", "a.pdf", "--set", "surfaces.shading=flat", "--page", "patent"}).find("surfaces are left out"),
              std::string::npos);
    EXPECT_NE(err({"-o", "a.dxf", "--set", "surfaces.shading=flat"}).find("1 region of a surface is left out"),
              std::string::npos);
    EXPECT_NE(err({"-o", "a.svg", "--style", "pencil"}).find("one colour and opacity"), std::string::npos);
}

}  // namespace
}  // namespace burin::test::vector_test
