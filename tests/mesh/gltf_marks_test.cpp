#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "mesh/gltf.h"
#include "mesh/model.h"
#include "tests/mesh/gltf_builder.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::ByteWriter;
using test::gltf_of;
using test::GltfAccessors;
using test::GltfParts;

using Marks = std::vector<std::array<std::uint32_t, 2>>;

/// Five vertices, and in accessor 1 the numbers 4, 2, 0, 1, 3.
GltfAccessors five_vertices() {
    GltfAccessors a;
    a.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
    a.add_indices({4, 2, 0, 1, 3});
    return a;
}

class GltfMarks : public testing::Test {
  protected:
    PolygonSoup soup_of(const GltfParts& parts) {
        return read_gltf(folder_.write("part.gltf", parts.json())).meshes.at(0);
    }
    Marks marks_of(const GltfParts& parts) {
        const PolygonSoup soup = soup_of(parts);
        EXPECT_EQ(soup.marked_edge_object, std::vector<std::uint32_t>(soup.marked_edges.size(), 0));
        return soup.marked_edges;
    }
    testing::AssertionResult refuses(const GltfParts& parts, std::initializer_list<std::string_view> texts) {
        return test::refuses([](const std::string& p) { read_gltf(p); }, folder_.write("part.gltf", parts.json()),
                             texts);
    }
    test::TemporaryFolder folder_;
};

TEST_F(GltfMarks, LinesLoopsAndStripsAreMarkedEdges) {
    const auto marks = [&](int mode, const char* indices) {
        return marks_of(gltf_of(five_vertices(), "{\"mode\": " + std::to_string(mode) +
                                                     ", \"attributes\": {\"POSITION\": 0}" + indices + "}"));
    };
    const char* const numbered = ", \"indices\": 1";
    EXPECT_EQ(marks(1, ""), (Marks{{0, 1}, {2, 3}})) << "one is left over";
    EXPECT_EQ(marks(2, ""), (Marks{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}}));
    EXPECT_EQ(marks(3, ""), (Marks{{0, 1}, {1, 2}, {2, 3}, {3, 4}}));
    EXPECT_EQ(marks(1, numbered), (Marks{{4, 2}, {0, 1}}));
    EXPECT_EQ(marks(2, numbered), (Marks{{4, 2}, {2, 0}, {0, 1}, {1, 3}, {3, 4}}));
    EXPECT_EQ(marks(3, numbered), (Marks{{4, 2}, {2, 0}, {0, 1}, {1, 3}}));
}

TEST_F(GltfMarks, TheLinesOfAMeshAreNumberedBehindItsTriangles) {
    GltfAccessors a = five_vertices();
    a.add_positions({0, 0, 0, 0, 1, 0});
    const GltfParts parts = gltf_of(
        a,
        R"({"attributes": {"POSITION": 0}}, {"mode": 3, "attributes": {"POSITION": 2}}, {"mode": 1, "attributes": {"POSITION": 0}})");
    const PolygonSoup soup = soup_of(parts);
    EXPECT_EQ(soup.positions.size(), 7u);
    EXPECT_EQ(soup.polygon_count(), 1u);
    EXPECT_EQ(soup.marked_edges, (Marks{{5, 6}, {0, 1}, {2, 3}}));
    // The first two lie along edges of the triangle, the third one is a line by itself.
    const Model model = read_model(folder_.write("part.gltf", parts.json()), {});
    EXPECT_EQ(count_edges(model.meshes.at(0)).marked, 3u);
    EXPECT_EQ(count_edges(model.meshes.at(0)).loose, 1u);
    EXPECT_EQ(model.skipped_primitives, 0u);
}

TEST_F(GltfMarks, LinesOfInvisibleMaterialsAreNoMarks) {
    GltfParts parts =
        gltf_of(five_vertices(),
                R"({"attributes": {"POSITION": 0}}, {"mode": 3, "attributes": {"POSITION": 0}, "material": 0})");
    parts.materials = R"([{"alphaMode": "MASK", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0]}}])";
    const GltfScene scene = read_gltf(folder_.write("part.gltf", parts.json()));
    EXPECT_TRUE(scene.meshes.at(0).marked_edges.empty());
    EXPECT_EQ(scene.notes, std::vector<std::string>{"left out 4 lines that their alphaCutoff makes invisible"});
}

TEST_F(GltfMarks, LinesMustUseVerticesThatExist) {
    GltfAccessors a = five_vertices();
    a.add_indices({0, 5});
    EXPECT_TRUE(refuses(gltf_of(a, R"({"mode": 1, "attributes": {"POSITION": 0}, "indices": 2})"),
                        {"meshes[0].primitives[0].indices: vertex 5 does not exist (there are 5)"}));
    EXPECT_TRUE(refuses(gltf_of(a, R"({"mode": 2, "attributes": {"POSITION": 0}, "indices": 0})"),
                        {"accessors[0]: the type must be SCALAR"}));
}

/// A primitive with EXT_mesh_primitive_edge_visibility or CESIUM_primitive_outline.
std::string primitive_with(const char* extension, const std::string& content, const std::string& more = "") {
    return R"({"attributes": {"POSITION": 0}, )" + more + "\"extensions\": {\"" + extension + "\": {" + content + "}}}";
}
const char* const kVisibility = "EXT_mesh_primitive_edge_visibility";
const char* const kOutline = "CESIUM_primitive_outline";

/// Accessor 2 has two bits for each of the given edges.
GltfAccessors with_visibility(std::vector<int> values) {
    GltfAccessors a = five_vertices();
    std::string bytes((2 * values.size() + 7) / 8, '\0');
    for (std::size_t i = 0; i < values.size(); ++i)
        bytes[i / 4] = static_cast<char>(bytes[i / 4] | values[i] << (2 * (i % 4)));
    a.add(bytes, "SCALAR", 5121, bytes.size());
    return a;
}

TEST_F(GltfMarks, EdgesOfVisibilityTwoAndThreeAreMarked) {
    // Triangles 4 2 0 of the list, with the rest left over.
    EXPECT_EQ(marks_of(gltf_of(with_visibility({2, 0, 1}),
                               primitive_with(kVisibility, R"("visibility": 2)", R"("indices": 1, )"))),
              (Marks{{4, 2}}));
    EXPECT_EQ(marks_of(gltf_of(with_visibility({1, 3, 2}),
                               primitive_with(kVisibility, R"("visibility": 2)", R"("indices": 1, )"))),
              (Marks{{2, 0}, {0, 4}}));
    // Without indices: 0 1 2.
    EXPECT_EQ(marks_of(gltf_of(with_visibility({0, 2, 0}), primitive_with(kVisibility, R"("visibility": 2)"))),
              (Marks{{1, 2}}));
}

TEST_F(GltfMarks, EdgesOfStripsAndFansAreCountedAsGltfOrdersTheirCorners) {
    // Strip: 0 1 2, 1 3 2, 2 3 4. Fan: 1 2 0, 2 3 0, 3 4 0.
    const auto marks = [&](const char* mode, int edge) {
        std::vector<int> values(9, 0);
        values[static_cast<std::size_t>(edge)] = 2;
        return marks_of(gltf_of(with_visibility(values), primitive_with(kVisibility, R"("visibility": 2)",
                                                                        "\"mode\": " + std::string(mode) + ", ")));
    };
    const Marks strip{{0, 1}, {1, 2}, {2, 0}, {1, 3}, {3, 2}, {2, 1}, {2, 3}, {3, 4}, {4, 2}};
    const Marks fan{{1, 2}, {2, 0}, {0, 1}, {2, 3}, {3, 0}, {0, 2}, {3, 4}, {4, 0}, {0, 3}};
    for (int edge = 0; edge < 9; ++edge) {
        EXPECT_EQ(marks("5", edge), Marks{strip[static_cast<std::size_t>(edge)]}) << edge;
        EXPECT_EQ(marks("6", edge), Marks{fan[static_cast<std::size_t>(edge)]}) << edge;
    }
}

TEST_F(GltfMarks, LineStringsRunFromVertexToVertexUpToARestart) {
    GltfAccessors a = five_vertices();
    a.add(ByteWriter().add<std::uint8_t>({0, 1, 3, 255, 4, 2}).bytes(), "SCALAR", 5121, 6);
    a.add(ByteWriter().add<std::uint16_t>({0, 1, 65535, 4, 2}).bytes(), "SCALAR", 5123, 5);
    a.add(ByteWriter().add<std::uint32_t>({3, 1, 0xFFFFFFFF, 4, 2}).bytes(), "SCALAR", 5125, 5);
    EXPECT_EQ(
        marks_of(gltf_of(
            a, primitive_with(kVisibility, R"("lineStrings": [{"indices": 2}, {"indices": 3}, {"indices": 4}])"))),
        (Marks{{0, 1}, {1, 3}, {4, 2}, {0, 1}, {4, 2}, {3, 1}, {4, 2}}));
}

TEST_F(GltfMarks, OutlinesArePairsOfVertices) {
    GltfAccessors a = five_vertices();
    a.add_indices({0, 1, 2, 0});
    EXPECT_EQ(marks_of(gltf_of(a, primitive_with(kOutline, R"("indices": 2)"))), (Marks{{0, 1}, {2, 0}}));
}

TEST_F(GltfMarks, BrokenMarksAreRefused) {
    GltfAccessors a = with_visibility({2, 2, 2});
    a.add(std::string(2, '\0'), "SCALAR", 5121, 2);                     // 3
    a.add(std::string(2, '\0'), "SCALAR", 5123, 1);                     // 4
    a.add_indices({0, 1, 5});                                           // 5
    a.add_indices({0, 5});                                              // 6
    a.add(ByteWriter().add<float>({0, 1}).bytes(), "SCALAR", 5126, 2);  // 7
    const std::string place = "meshes[0].primitives[0].extensions.";
    const auto visibility = [&](const char* content) { return gltf_of(a, primitive_with(kVisibility, content)); };
    const auto outline = [&](const char* content) { return gltf_of(a, primitive_with(kOutline, content)); };
    EXPECT_NO_THROW(soup_of(visibility(R"("visibility": 2)")));
    EXPECT_TRUE(refuses(visibility(R"("visibility": 3)"),
                        {place + kVisibility + ".visibility: has 2 bytes; 1 triangles need 1"}));
    EXPECT_TRUE(
        refuses(visibility(R"("visibility": 4)"), {place + kVisibility + ".visibility: must be unsigned bytes"}));
    EXPECT_TRUE(refuses(visibility(R"("visibility": 0)"), {"accessors[0]: the type must be SCALAR"}));
    EXPECT_TRUE(
        refuses(visibility(R"("visibility": 99)"), {place + kVisibility + ".visibility: accessor 99 does not exist"}));
    EXPECT_TRUE(refuses(visibility(R"("lineStrings": [{"indices": 5}])"),
                        {"lineStrings[0].indices: vertex 5 does not exist (there are 5)"}));
    EXPECT_TRUE(refuses(visibility(R"("lineStrings": [{}])"), {"lineStrings[0]: 'indices' is missing"}));
    EXPECT_TRUE(refuses(visibility(R"("lineStrings": [{"indices": 7}])"),
                        {"lineStrings[0].indices: must be unsigned integers"}));
    EXPECT_TRUE(
        refuses(outline(R"("indices": 5)"), {place + kOutline + ".indices: an outline needs two vertices per edge"}));
    EXPECT_TRUE(
        refuses(outline(R"("indices": 6)"), {place + kOutline + ".indices: vertex 5 does not exist (there are 5)"}));
    EXPECT_TRUE(refuses(outline(R"("indices": 7)"), {place + kOutline + ".indices: must be unsigned integers"}));
}

}  // namespace
}  // namespace burin
