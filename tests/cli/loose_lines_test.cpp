// Lines that no polygon has: counted, and named where they are not drawn.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "methods/method_table.h"
#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::loose_lines_test {
namespace {

using Json = nlohmann::json;

class LooseLinesOfFiles : public testing::Test {
  protected:
    LooseLinesOfFiles() {
        folder_.write("both.obj", std::string(kCubeObj) + "v 3 0 0\nl 1 9 5\n");
        folder_.write("lines.obj", "v 0 0 0\nv 1 0 0\nv 1 1 7\nl 1 2 3\n");
    }
    ProgramResult run(const std::vector<std::string>& arguments) const { return run_burin(folder_.path(), arguments); }
    TemporaryFolder folder_;
};

TEST_F(LooseLinesOfFiles, AreCounted) {
    const Json both = Json::parse(run({"info", "both.obj", "--json"}).out).at("edges"),
               lines = Json::parse(run({"info", "lines.obj", "--json"}).out);
    EXPECT_EQ(both.at("total"), 12);
    EXPECT_EQ(both.at("marked"), 2);
    EXPECT_EQ(both.at("loose"), 2);
    EXPECT_EQ(lines.at("edges").at("loose"), 2);
    EXPECT_EQ(lines.at("bounds").at("max"), Json::array({1, 1, 7}));
    EXPECT_NE(run({"info", "lines.obj"}).out.find("2 of those marked that no polygon has"), std::string::npos);
}

TEST_F(LooseLinesOfFiles, WhatIsLeftOutIsNamedOnce) {
    const ProgramResult plain = run({"render", "both.obj", "-o", "a.png", "-r", "40x40"});
    EXPECT_EQ(plain.status, 0);
    EXPECT_EQ(plain.err,
              "burin: note: the class mark is not drawn, and so 2 lines of the input are missing; "
              "--lines mark,border,silhouette,intersection,object,crease has it, too\n");
    EXPECT_EQ(run({"render", "both.obj", "-o", "a.png", "-r", "40x40", "--lines", "mark"}).err, "");
    EXPECT_EQ(run({"render", "lines.obj", "-o", "a.png", "-r", "40x40", "--lines", "mark"}).err, "");
    const ProgramResult other =
        run({"render", "both.obj", "-m", "simple", "-o", "a.png", "-r", "40x40", "--lines", "mark"});
    EXPECT_EQ(other.err,
              "burin: note: method simple draws edges of polygons only, and leaves out 2 lines of the input; abuffer "
              "draws them\n");
}

TEST_F(LooseLinesOfFiles, AreDrawnByDefaultWhereNoPolygonIs) {
    EXPECT_EQ(run({"render", "lines.obj", "-o", "default.png", "-r", "40x40"}).err, "");
    EXPECT_EQ(run({"render", "lines.obj", "-o", "marks.png", "-r", "40x40", "--lines", "mark"}).err, "");
    EXPECT_EQ(run({"render", "lines.obj", "-q", "-o", "creases.png", "-r", "40x40", "--lines", "crease"}).err, "");
    EXPECT_EQ(read_file(folder_.file("default.png")), read_file(folder_.file("marks.png")));
    EXPECT_NE(read_file(folder_.file("default.png")), read_file(folder_.file("creases.png")));
}

TEST_F(LooseLinesOfFiles, NoMethodFailsWithoutPolygons) {
    for (const Method& method : methods()) {
        const ProgramResult result = run({"render", "lines.obj", "-q", "-m", std::string(method.name), "-o", "a.png",
                                          "-r", "40x40", "--lines", "mark"});
        EXPECT_EQ(result.status, 0) << method.name;
        EXPECT_EQ(result.err, "") << method.name;
    }
}

}  // namespace
}  // namespace burin::test::loose_lines_test
