// What readers leave out of a model is said once, counted by info, and refused with --strict.

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::notes_test {
namespace {

using Json = nlohmann::json;

std::string stl_with_a_nan(std::uint32_t count) {
    std::string stl(80, ' ');
    stl += bytes_of(count);
    for (const float x : {0.0f, std::numeric_limits<float>::quiet_NaN(), 1.0f}) {
        stl += bytes_of(0.0f, 0.0f, 1.0f, 0.0f, 0.0f, x, 1.0f, 0.0f, x, 0.0f, 1.0f, x, std::uint16_t{0});
    }
    return stl;
}

TEST(Notes, AreOneLineEachUnlessQuiet) {
    const TemporaryFolder folder;
    folder.write("a.stl", stl_with_a_nan(3));
    folder.write("scene.toml", "[[object]]\nfile = \"a.stl\"\n[[object]]\nfile = \"a.stl\"\nsubdivide = 1\n");
    for (const char* input : {"a.stl", "scene.toml"}) {
        const std::vector<std::string> render{"render",  input,   "-r",    "16x12",    "-o",
                                              "out.png", "--eye", "0,0,3", "--target", "0,0,0"};
        const ProgramResult result = run_burin(folder.path(), render);
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_NE(result.err.find("a.stl: triangles left out: 1; the first one is triangle 1: a "
                                  "coordinate is not finite"),
                  std::string::npos)
            << result.err;
        std::vector<std::string> quiet = render;
        quiet.push_back("-q");
        EXPECT_EQ(run_burin(folder.path(), quiet).err, "");
    }
    const ProgramResult explain = run_burin(folder.path(), {"explain", "a.stl", "-r", "16x12", "--pixel", "3,3"});
    EXPECT_EQ(explain.status, 0);
    EXPECT_TRUE(is_one_line(explain.err)) << explain.err;
}

TEST(Notes, StandInInfo) {
    const TemporaryFolder folder;
    folder.write("a.stl", stl_with_a_nan(0));
    const ProgramResult info = run_burin(folder.path(), {"info", "a.stl"});
    EXPECT_EQ(info.status, 0);
    EXPECT_EQ(info.err, "");
    EXPECT_NE(info.out.find("note       a.stl: the header promises 0 triangles, the file has 3, which are read\n"),
              std::string::npos)
        << info.out;
    EXPECT_NE(info.out.find("note       a.stl: triangles left out: 1;"), std::string::npos) << info.out;
    const ProgramResult result = run_burin(folder.path(), {"info", "a.stl", "--json"});
    EXPECT_EQ(result.err, "");
    const Json json = Json::parse(result.out);
    EXPECT_EQ(json["repairs"]["non_finite_polygons"], 1);
    EXPECT_EQ(json["notes"].size(), 2u);
    EXPECT_EQ(json["triangles"], 2);
}

TEST(Notes, StrictRefusesInstead) {
    const TemporaryFolder folder;
    folder.write("nan.stl", stl_with_a_nan(3));
    folder.write("count.stl", stl_with_a_nan(7));
    folder.write("good.obj", kCubeObj);
    for (const std::vector<std::string>& command : {std::vector<std::string>{"info"},
                                                    {"render", "-r", "16x12", "-o", "out.png"},
                                                    {"explain", "--pixel", "1,1"},
                                                    {"compare", "-o", "compared", "-r", "16x12"}}) {
        const auto run = [&](const std::string& input) {
            std::vector<std::string> arguments = command;
            arguments.insert(arguments.end(), {input, "--strict"});
            return run_burin(folder.path(), arguments);
        };
        const ProgramResult not_finite = run("nan.stl"), count = run("count.stl");
        EXPECT_EQ(not_finite.status, 1);
        EXPECT_EQ(not_finite.err,
                  "nan.stl: triangle 1: a coordinate is not finite or beyond 1e30; repair or "
                  "re-export the file\n");
        EXPECT_EQ(count.status, 1);
        EXPECT_EQ(count.err,
                  "count.stl: the header promises 7 triangles, the file has room for 3; was it "
                  "written completely?\n");
        if (command[0] != "compare") {
            EXPECT_EQ(run("good.obj").status, 0) << command[0];
        }
    }
}

TEST(Notes, NameWhatAnObjAndItsMaterialsHaveThatIsNotDrawn) {
    const TemporaryFolder folder;
    folder.write("a.mtl", "newmtl m\nKd 1 \\\n0 0\nd 0,5 x\nd nan\nnewmtl n\nd 0.5\n");
    folder.write("a.obj",
                 "mtllib a.mtl\nmtllib missing.mtl\n" + std::string(kCubeObj) + "usemtl m\np 1 2\np 3\nf 1 2 3\n");
    const ProgramResult info = run_burin(folder.path(), {"info", "a.obj", "--json"});
    EXPECT_EQ(info.status, 0) << info.err;
    const Json notes = Json::parse(info.out).at("notes");
    EXPECT_EQ(notes, Json::array({"a.obj: material files that are not read: 1; the first one is 'missing.mtl'; "
                                  "materials have the default colour",
                                  "a.obj: values of Kd, d and Tr that are not understood: 2; the first one is at " +
                                      folder.file("a.mtl") + ":4",
                                  "a.obj: points left out: 2"}));
    const ProgramResult strict = run_burin(folder.path(), {"info", "a.obj", "--strict"});
    EXPECT_EQ(strict.status, 1);
    EXPECT_NE(strict.err.find("missing.mtl"), std::string::npos) << strict.err;
    folder.write("b.obj", "mtllib a.mtl\n" + std::string(kCubeObj) + "usemtl n\nf 1 2 3\n");
    folder.write("a.mtl", "newmtl n\nKd 1 \\\n0 0\nd \\\n0.5\n");
    EXPECT_EQ(run_burin(folder.path(), {"info", "b.obj", "--strict"}).status, 0);
}

TEST(Notes, NameWhatStandsBehindTheLastElementAndWordsThatAreNotKnown) {
    const TemporaryFolder folder;
    folder.write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n");
    folder.write(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n7\n");
    folder.write("a.stl", stl_with_a_nan(3).substr(0, 84 + 50).replace(80, 4, bytes_of(std::uint32_t{1})) + "more");
    folder.write("a.obj", std::string(kCubeObj) + "face 1 2 3\nface 1 2 4\n");
    for (const auto& [name, note] :
         {std::pair{"a.off", "lines behind the last polygon left out: 1; the first one is line 7"},
          {"a.ply", "lines behind the last element left out: 1; the first one is line 14"},
          {"a.stl", "bytes behind the last triangle left out: 4"},
          {"a.obj", "lines left out that begin with a word that is not known: 2; the first one is line "}}) {
        const ProgramResult info = run_burin(folder.path(), {"info", name});
        EXPECT_EQ(info.status, 0) << info.err;
        EXPECT_NE(info.out.find("note       " + std::string(name) + ": " + note), std::string::npos) << info.out;
        const ProgramResult picture = run_burin(folder.path(), {"render", name, "-r", "16x12", "-o", "out.png"});
        EXPECT_EQ(picture.status, 0) << picture.err;
        EXPECT_TRUE(is_one_line(picture.err)) << picture.err;
        EXPECT_NE(picture.err.find(note), std::string::npos) << picture.err;
        const ProgramResult strict = run_burin(folder.path(), {"info", name, "--strict"});
        EXPECT_EQ(strict.status, 1);
        EXPECT_TRUE(is_one_line(strict.err)) << strict.err;
        EXPECT_NE(strict.err.find(note), std::string::npos) << strict.err;
    }
}

TEST(Notes, PolygonsThatWereCutAreCounted) {
    const TemporaryFolder folder;
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0.5 1 0\nv 0.5 1.5 0\nv 0.5 2 0\nf 1 2 3 1 2 4 1 2 5\nf 3 4 1\n");
    const Json json = Json::parse(run_burin(folder.path(), {"info", "a.obj", "--json"}).out);
    EXPECT_EQ(json["repairs"]["cut_polygons"], 1);
    EXPECT_EQ(json["repairs"]["cut_pieces"], 3);
    EXPECT_EQ(json["polygons"], 2);
    const std::string info = run_burin(folder.path(), {"info", "a.obj"}).out;
    EXPECT_NE(info.find("  cut        1 polygons that pass an edge twice in one direction, into 3\n"),
              std::string::npos)
        << info;
    folder.write("b.obj", kCubeObj);
    EXPECT_EQ(run_burin(folder.path(), {"info", "b.obj"}).out.find("  cut "), std::string::npos);
}

// An option is stronger than --set, but not without a word.
TEST(Notes, OfSetsThatAnOptionMakesUseless) {
    const TemporaryFolder folder;
    folder.write("cube.toml",
                 "[[object]]\nshape = \"box\"\n[[camera]]\nname = \"a\"\neye = [1, 2, 9]\n[[camera]]\nname = "
                 "\"b\"\neye = [2, 2, 9]\n");
    const struct {
        std::vector<std::string> option;
        std::string set, name;
        std::vector<std::string> more;
    } pairs[] = {
        {{"-w", "3"}, "style.width=8", "--line-width", {"--style", "comic"}},
        {{"--color", "#102030"}, "style.color=#405060", "--color", {"--style", "comic"}},
        {{"-w", "3"}, "lines.width=8", "--line-width", {}},
        {{"--lines", "crease"}, "lines.draw=all", "--lines", {}},
        {{"--hidden", "dashed"}, "lines.hidden.style=solid", "--hidden", {}},
        {{"--crease-angle", "20"}, "lines.crease_angle=30", "--crease-angle", {}},
        {{"--eye", "1,2,3"}, "camera.0.eye=4,5,6", "--eye", {}},
        {{"--shutter", "-1,1"}, "shutter.close=2", "--shutter", {}},
        {{"--background", "#ffffff"}, "picture.background=#000000", "--background", {}},
    };
    const auto render = [&](const std::vector<std::string>& words) {
        std::vector<std::string> arguments = {"render", "cube.toml", "-r", "24x16", "-o", "a.png"};
        for (const std::string& word : words) arguments.push_back(word);
        const ProgramResult result = run_burin(folder.path(), arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        return result.err;
    };
    for (const auto& [option, set, name, more] : pairs) {
        std::vector<std::string> words = option;
        words.insert(words.end(), more.begin(), more.end());
        render(words);
        const std::string alone = read_file(folder.file("a.png"));
        words.insert(words.end(), {"--set", set});
        const std::string note = "burin: note: --set " + set.substr(0, set.find('=')) + " is left out: " + name +
                                 " says the same, and is stronger\n";
        EXPECT_NE(render(words).find(note), std::string::npos) << note;
        EXPECT_TRUE(read_file(folder.file("a.png")) == alone) << set;
        words.emplace_back("-q");
        EXPECT_EQ(render(words), "");
    }
    // Others stand beside each other.
    EXPECT_EQ(render({"-w", "3", "--set", "lines.hidden.width=2", "--eye", "1,2,3", "--set", "camera.1.target=0,0,0",
                      "--set", "lines.color=#102030"})
                  .find("is left out"),
              std::string::npos);
}

}  // namespace
}  // namespace burin::test::notes_test
