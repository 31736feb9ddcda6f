#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "mesh/build_meshes.h"
#include "mesh/readers.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::ByteWriter;
using test::Polygons;
using test::polygons_of;

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
    return "  facet normal 0 0 1\n    outer loop\n      vertex " + a + "\n      vertex " + b + "\n      vertex " + c +
           "\n    endloop\n  endfacet\n";
}

/// Two triangles of a square.
std::string binary_square(std::string header, std::uint32_t count) {
    header.resize(80, ' ');
    ByteWriter w;
    w.add<std::uint32_t>({count});
    w.add<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1.5f, 0}).add<std::uint16_t>({0});
    w.add<float>({0, 0, 1, 0, 0, 0, 1, 1.5f, 0, 0, 1, 0}).add<std::uint16_t>({0xFFFF});
    return header + w.bytes();
}

class ReadStl : public testing::Test {
  protected:
    PolygonSoup read(std::string_view text) { return read_stl(folder_.write("part.stl", text)); }
    testing::AssertionResult refuses(std::string_view text, std::initializer_list<std::string_view> parts) {
        return test::refuses([](const std::string& path) { return read_stl(path); }, folder_.write("part.stl", text),
                             parts);
    }
    test::TemporaryFolder folder_;
};

TEST_F(ReadStl, ReadsText) {
    const std::string text = "solid a name\n" + facet("0 0 0", "1 0 0", "1 1.5e0 -2") + "endsolid a name\n";
    for (const std::string& variant : {text, "\n\n " + text, text.substr(0, text.size() - 1)}) {
        const PolygonSoup soup = read(variant);
        EXPECT_EQ(polygons_of(soup), (Polygons{{0, 1, 2}}));
        EXPECT_EQ(soup.positions[2], glm::dvec3(1, 1.5, -2));
        EXPECT_EQ(soup.object_names, std::vector<std::string>{"a name"});
        EXPECT_EQ(soup.materials.size(), 1u);
    }
    std::string crlf;
    for (const char c : text) crlf += c == '\n' ? "\r\n" : std::string(1, c);
    EXPECT_EQ(read(crlf).object_names, std::vector<std::string>{"a name"});
    EXPECT_EQ(polygons_of(read(crlf)), (Polygons{{0, 1, 2}}));
}

TEST_F(ReadStl, EachSolidIsAnObject) {
    const PolygonSoup soup =
        read("solid left\n" + facet("0 0 0", "1 0 0", "1 1 0") + facet("0 0 1", "1 0 1", "1 1 1") +
             "endsolid\nsolid empty\nendsolid empty\n\nsolid\n" + facet("0 0 2", "1 0 2", "1 1 2") + "endsolid\n");
    EXPECT_EQ(soup.object_names, (std::vector<std::string>{"left", "empty", "part"}));
    EXPECT_EQ(soup.polygon_object, (std::vector<std::uint32_t>{0, 0, 2}));
    const std::vector<Mesh> meshes = build_meshes(soup, {});
    ASSERT_EQ(meshes.size(), 2u);
    EXPECT_EQ(meshes[0].triangles.size(), 2u);
    EXPECT_EQ(meshes[1].name, "part");
}

TEST_F(ReadStl, ReadsBinary) {
    const PolygonSoup soup = read(binary_square("made by hand", 2));
    EXPECT_EQ(polygons_of(soup), (Polygons{{0, 1, 2}, {3, 4, 5}}));
    EXPECT_EQ(soup.positions[2], glm::dvec3(1, 1.5, 0));
    EXPECT_EQ(soup.positions[5], glm::dvec3(0, 1, 0));
    EXPECT_EQ(soup.object_names, std::vector<std::string>{"part"});
    EXPECT_EQ(read(binary_square("", 1) + "x").polygon_count(), 1u) << "what follows the triangles is ignored";
    EXPECT_TRUE(soup.notes.empty());
}

TEST_F(ReadStl, BinaryFilesMayStartWithSolid) {
    EXPECT_EQ(read(binary_square("solid and so on", 2)).polygon_count(), 2u);
    EXPECT_EQ(read(binary_square("solid", 1) + "x").polygon_count(), 1u)
        << "the size does not fit, but no text has zero bytes";
    EXPECT_TRUE(refuses(binary_square("solid", 2).substr(0, 150),
                        {"the header promises 2 triangles, the file has room for 1"}));
}

TEST_F(ReadStl, CornersWithEqualCoordinatesAreWelded) {
    const std::vector<Mesh> meshes = build_meshes(read(binary_square("", 2)), {});
    ASSERT_EQ(meshes.size(), 1u);
    EXPECT_EQ(meshes[0].positions.size(), 4u);
    EXPECT_EQ(meshes[0].repairs.welded_vertices, 2u);
    EXPECT_EQ(count_edges(meshes[0]).border, 4u);
    EXPECT_EQ(count_edges(meshes[0]).edges, 5u);
}

TEST_F(ReadStl, TruncatedBinaryFilesAreRefused) {
    const std::string whole = binary_square("x", 2);
    for (std::size_t size = 1; size < whole.size(); ++size) {
        if (size == 84 + 50) continue;  // a file of one triangle, but for its count
        EXPECT_TRUE(refuses(whole.substr(0, size), {"was it written completely?"})) << "after " << size;
    }
    for (const std::uint32_t count : {3u, 4000000000u, 0xFFFFFFFFu}) {
        EXPECT_TRUE(refuses(binary_square("x", count) + "x",
                            {"the header promises " + std::to_string(count) + " triangles, the file has room for 2"}));
    }
    EXPECT_TRUE(refuses(binary_square("x", 0).substr(0, 84), {"no triangles"}));
    EXPECT_TRUE(refuses("", {"empty"}));
}

TEST_F(ReadStl, TruncatedTextIsRefused) {
    const std::string whole = "solid a\n" + facet("0 0 0", "1 0 0", "1 1 0") + "endsolid a\n";
    const std::size_t complete = whole.find("endsolid") + 8;
    for (std::size_t size = 1; size < complete; ++size) {
        EXPECT_TRUE(refuses(whole.substr(0, size), {})) << "after " << size;
    }
    EXPECT_EQ(read(whole.substr(0, complete)).polygon_count(), 1u);
}

TEST_F(ReadStl, BrokenTextIsRefused) {
    const std::string good = facet("0 0 0", "1 0 0", "1 1 0");
    for (const char* bad : {"1 2", "", "x 0 0", "0 0 1e"}) {
        EXPECT_TRUE(
            refuses("solid a\n" + facet("0 0 0", bad, "1 1 0") + "endsolid\n", {":5: a vertex needs three numbers"}));
    }
    EXPECT_TRUE(refuses("solid a\n" + good + "endsolid\n" + good, {":12: a vertex stands outside of any solid"}));
    EXPECT_TRUE(refuses("solid a\nvertices\nendsolid\n", {":2: unknown word 'vertices'"}));
    EXPECT_TRUE(refuses("solid a\nendsolid\n", {"no triangles"}));
    // A facet must be closed before the next one starts, or two would become one polygon.
    const std::string open = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n";
    EXPECT_TRUE(refuses("solid a\n" + open + "endfacet\n" + good + "endsolid\n", {":7: "}));
    EXPECT_TRUE(refuses("solid a\n" + open + good + "endsolid\n", {":7: "}));
    EXPECT_TRUE(refuses("solid a\n" + open + "endsolid\n", {":7: "}));
    EXPECT_TRUE(refuses("solid a\n" + open + "solid b\n" + good + "endsolid\n", {":7: "}));
}

TEST_F(ReadStl, NobodyReadsNormals) {
    ByteWriter w;
    w.add<std::uint32_t>({1})
        .add<float>({std::numeric_limits<float>::quiet_NaN(), 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0})
        .add<std::uint16_t>({0});
    EXPECT_EQ(read(std::string(80, 'x') + w.bytes()).polygon_count(), 1u);
    EXPECT_EQ(read(std::string(80, 'x') + w.bytes()).non_finite_polygons, 0u);
}

}  // namespace
}  // namespace burin
