// What of a model is not drawn is named.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::left_out_test {
namespace {

using Json = nlohmann::json;

/// A triangle, two primitives of points, and a node that is not visible.
constexpr const char* kModel =
    R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}, {"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": false}}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}, {"attributes": {"POSITION": 0}, "mode": 0}, {"attributes": {"POSITION": 0}, "mode": 0}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

const std::string kNotes =
    "burin: note: part.gltf: left out 2 primitives of points\n"
    "burin: note: part.gltf: left out 1 node with a mesh that is not visible\n";

TEST(LeftOut, IsNamedOnceWhenAPictureIsMade) {
    const TemporaryFolder folder;
    folder.write("part.gltf", kModel);
    const ProgramResult once = run_burin(folder.path(), {"render", "part.gltf", "-r", "64x64", "-o", "a.png"});
    EXPECT_EQ(once.status, 0) << once.err;
    EXPECT_NE(once.err.find(kNotes), std::string::npos) << once.err;
    // A scene that has the file twice, in two ways.
    folder.write("scene.toml", "[[object]]\nfile = \"part.gltf\"\n[[object]]\nfile = \"part.gltf\"\nsubdivide = 1\n");
    const ProgramResult twice = run_burin(folder.path(), {"render", "scene.toml", "-r", "64x64", "-o", "a.png"});
    EXPECT_EQ(twice.status, 0) << twice.err;
    const std::size_t first = twice.err.find("left out 2 primitives of points");
    EXPECT_NE(first, std::string::npos) << twice.err;
    EXPECT_EQ(twice.err.find("left out 2 primitives of points", first + 1), std::string::npos) << twice.err;
    const ProgramResult quiet = run_burin(folder.path(), {"render", "part.gltf", "-q", "-r", "64x64", "-o", "a.png"});
    EXPECT_EQ(quiet.err, "");
}

TEST(LeftOut, IsCountedByInfo) {
    const TemporaryFolder folder;
    folder.write("part.gltf", kModel);
    const ProgramResult text = run_burin(folder.path(), {"info", "part.gltf"});
    EXPECT_NE(text.out.find("  note       part.gltf: left out 2 primitives of points\n"), std::string::npos)
        << text.out;
    EXPECT_NE(text.out.find("  note       part.gltf: left out 1 node with a mesh that is not visible\n"),
              std::string::npos)
        << text.out;
    const Json info = Json::parse(run_burin(folder.path(), {"info", "--json", "part.gltf"}).out);
    EXPECT_EQ(info.at("repairs").at("skipped_primitives"), 2);
    EXPECT_EQ(info.at("notes"), Json::array({"part.gltf: left out 2 primitives of points",
                                             "part.gltf: left out 1 node with a mesh that is not visible"}));
}

TEST(LeftOut, IsRefusedWithStrictUnlessTheFileMeansIt) {
    const TemporaryFolder folder;
    folder.write("part.gltf", kModel);
    const ProgramResult points = run_burin(folder.path(), {"info", "part.gltf", "--strict"});
    EXPECT_EQ(points.status, 1);
    EXPECT_EQ(points.err,
              "part.gltf: 2 primitives of points, which cannot be drawn; re-export the model without, or leave out "
              "--strict\n");
    const std::string primitive = R"(, {"attributes": {"POSITION": 0}, "mode": 0})";
    std::string invisible = kModel;
    for (std::size_t at; (at = invisible.find(primitive)) != std::string::npos;) invisible.erase(at, primitive.size());
    folder.write("part.gltf", invisible);
    const ProgramResult node = run_burin(folder.path(), {"info", "part.gltf", "--strict"});
    EXPECT_EQ(node.status, 0) << node.err;
    EXPECT_NE(node.out.find("left out 1 node"), std::string::npos) << node.out;
}

}  // namespace
}  // namespace burin::test::left_out_test
