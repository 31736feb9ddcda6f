// STL as programs in use write it: wrong counts, other keywords, coordinates that are no numbers.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "mesh/readers.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::ByteWriter;
using test::Polygons;
using test::polygons_of;

std::string binary(const std::string& header, std::uint32_t count, std::initializer_list<float> last_corners) {
    ByteWriter w;
    w.add<std::uint32_t>({count});
    for (const float x : last_corners) {
        w.add<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, x, 1, 0}).add<std::uint16_t>({0});
    }
    std::string text = header;
    text.resize(80, ' ');
    return text + w.bytes();
}

std::string facet(const std::string& last) {
    return "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex " + last + "\nendloop\nendfacet\n";
}

class StlVariants : public testing::Test {
  protected:
    PolygonSoup read(std::string_view text) { return read_stl(folder_.write("part.stl", text)); }
    testing::AssertionResult refuses(std::string_view text, std::initializer_list<std::string_view> parts,
                                     bool strict = false) {
        return test::refuses([strict](const std::string& path) { return read_stl(path, strict); },
                             folder_.write("part.stl", text), parts);
    }
    /// Reads a file of which something is noted.
    PolygonSoup read_noted(std::string_view text, std::string_view note) {
        PolygonSoup soup = read(text);
        EXPECT_EQ(soup.notes.size(), 1u);
        for (const std::string& n : soup.notes) EXPECT_NE(n.find(note), std::string::npos) << n;
        return soup;
    }
    test::TemporaryFolder folder_;
};

TEST_F(StlVariants, ACountThatDoesNotFitIsReplacedByTheSize) {
    for (const char* header : {"made by hand", "solid", "SOLID part", ""}) {
        for (const std::uint32_t count : {0u, 1u, 4u, 0xFFFFFFFFu, 0x80000000u}) {
            const std::string text = binary(header, count, {1, 2, 3});
            EXPECT_EQ(read_noted(text, "promises " + std::to_string(count) + " triangles, the file has 3").positions[8],
                      glm::dvec3(3, 1, 0))
                << header << count;
            EXPECT_TRUE(refuses(text, {"promises " + std::to_string(count) + " triangles, the file has"}, true))
                << header << count;
        }
        EXPECT_TRUE(read(binary(header, 3, {1, 2, 3})).notes.empty());
    }
    // Not a whole number of triangles: then the count counts, if there are as many.
    EXPECT_TRUE(refuses(binary("x", 4, {1, 2, 3}) + "yz", {"promises 4 triangles, the file has room for 3"}));
    EXPECT_TRUE(refuses(binary("x", 0, {1, 2, 3}) + "yz", {"no triangles"}));
    EXPECT_EQ(read(binary("x", 2, {1, 2, 3}) + "yz").polygon_count(), 2u);
}

TEST_F(StlVariants, AnyTextIsNoBinaryFileByItsSizeAlone) {
    EXPECT_TRUE(refuses(std::string(84 + 500, 'x'), {"neither text that starts with 'solid'"}));
}

TEST_F(StlVariants, KeywordsMayBeSpeltInManyWays) {
    const std::string text = "solid a Name\n" + facet("1 1 0") + facet("2 1 0") + "endsolid a Name\nsolid b\n" +
                             facet("1 1 3") + "endsolid b\n";
    const PolygonSoup expected = read(text);
    ASSERT_EQ(expected.polygon_count(), 3u);
    const auto with = [&](std::initializer_list<std::pair<std::string, std::string>> changes) {
        std::string changed = text;
        for (const auto& [from, to] : changes) {
            for (std::size_t at = changed.find(from); at != std::string::npos; at = changed.find(from, at + to.size()))
                changed.replace(at, from.size(), to);
        }
        return changed;
    };
    for (const std::string& variant :
         {with({{"endloop", "end loop"}, {"endfacet", "end facet"}, {"endsolid", "end solid"}}),
          with({{"endsolid", "end solid"}}),
          with({{"endloop", "END\tLOOP"},
                {"endfacet", "END FACET"},
                {"endsolid", "END SOLID"},
                {"facet normal", "FACET NORMAL"},
                {"outer loop", "OUTER LOOP"},
                {"vertex", "VERTEX"}}),
          with({{"endsolid", "EndSolid"},
                {"solid", "Solid"},
                {"EndSolid", "endSolid"},
                {"vertex", "Vertex"},
                {"endloop", "EndLoop"}}),
          with({{"solid", "SOLID"}, {"endSOLID", "ENDSOLID"}}), "\xEF\xBB\xBF" + text}) {
        const PolygonSoup soup = read(variant);
        EXPECT_EQ(soup.positions, expected.positions) << variant;
        EXPECT_EQ(polygons_of(soup), polygons_of(expected)) << variant;
        EXPECT_EQ(soup.object_names, (std::vector<std::string>{"a Name", "b"})) << variant;
        EXPECT_EQ(soup.polygon_object, (std::vector<std::uint32_t>{0, 0, 1})) << variant;
    }
    // Statements may share a line: all of the file, a facet a line, or as the words happen to be broken.
    std::string one_line = text;
    std::replace(one_line.begin(), one_line.end(), '\n', ' ');
    for (const std::string& variant :
         {one_line, one_line + "\n",
          with({{"\nouter loop\n", " outer loop "}, {"\nvertex", " vertex"}, {"\nend", " end"}}),
          with({{"endfacet\n", "endfacet "}}), with({{"\nfacet", " facet"}, {"\nendsolid", " ENDSOLID"}}),
          with({{"endsolid a Name\nsolid b\n", "endsolid a solid Name solid b "}}),
          with({{"endsolid a Name\nsolid b\n", "endsolid solid b "}})}) {
        const PolygonSoup soup = read(variant);
        EXPECT_EQ(soup.positions, expected.positions) << variant;
        EXPECT_EQ(polygons_of(soup), polygons_of(expected)) << variant;
        EXPECT_EQ(soup.object_names, (std::vector<std::string>{"a Name", "b"})) << variant;
        EXPECT_EQ(soup.polygon_object, (std::vector<std::uint32_t>{0, 0, 1})) << variant;
    }
    EXPECT_EQ(read("solid the outer facet end\n" + facet("1 1 0") + "endsolid the solid of facet end\n").object_names,
              (std::vector<std::string>{"the outer facet end"}));
    EXPECT_TRUE(read("solid none endsolid none solid a " + facet("1 1 0") + "endsolid\n").notes.empty());
    EXPECT_TRUE(refuses("solid a facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 endloop",
                        {":1: a vertex needs three numbers"}));
    EXPECT_TRUE(
        refuses("solid a facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0", {"in the middle of a solid"}));
    EXPECT_TRUE(refuses("solid a\n" + facet("1 1 0") + "end\n", {":9: unknown word 'end'"}));
    EXPECT_TRUE(refuses("solid a\n" + facet("1 1 0") + "end of it\n", {":9: unknown word 'endof'"}));
}

TEST_F(StlVariants, BinaryTrianglesWithoutFiniteCoordinatesAreLeftOut) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(), -1.1e30f}) {
        const PolygonSoup soup =
            read_noted(binary("x", 4, {1, bad, 3, bad}),
                       "triangles left out: 2; the first one is triangle 1: a coordinate is not finite");
        EXPECT_EQ(soup.non_finite_polygons, 2u);
        EXPECT_EQ(polygons_of(soup), (Polygons{{0, 1, 2}, {3, 4, 5}}));
        EXPECT_EQ(soup.positions[5], glm::dvec3(3, 1, 0));
        EXPECT_TRUE(
            refuses(binary("x", 4, {1, bad, 3, bad}), {"triangle 1: a coordinate is not finite or beyond 1e30"}, true));
        EXPECT_TRUE(refuses(binary("x", 2, {bad, bad}), {"no triangle has finite coordinates"}));
    }
}

TEST_F(StlVariants, FacetsWithoutFiniteCoordinatesAreLeftOut) {
    for (const char* bad :
         {"nan 0 0", "0 -nan 0", "0 0 NaN", "-nan(ind) 0 0", "0 nan(snan) 0", "inf 0 0", "0 -INF 0", "0 Infinity 0",
          "1.#QNAN 0 0", "0 -1.#IND 0", "0 0 1.#INF", "-1.#IND00 0 1.#INF00e+000", "0 0 1e31", "1e999 0 0"}) {
        const std::string text =
            "solid a\n" + facet("1 1 0") + facet(bad) + facet("3 1 0") + facet(bad) + "endsolid a\n";
        const PolygonSoup soup =
            read_noted(text, "triangles left out: 2; the first one is on line 13: a coordinate is not finite");
        EXPECT_EQ(soup.non_finite_polygons, 2u) << bad;
        EXPECT_EQ(polygons_of(soup), (Polygons{{0, 1, 2}, {3, 4, 5}})) << bad;
        EXPECT_EQ(soup.positions.size(), 6u) << bad;
        EXPECT_EQ(soup.positions[5], glm::dvec3(3, 1, 0)) << bad;
        EXPECT_TRUE(refuses(text, {":13: a coordinate is not finite or beyond 1e30"}, true)) << bad;
        EXPECT_TRUE(refuses("solid a\n" + facet(bad) + "endsolid a\n", {"no triangle has finite coordinates"})) << bad;
    }
    for (const char* bad : {"none 0 0", "n 0 0", "1.x 0 0", "- 0 0"}) {
        EXPECT_TRUE(refuses("solid a\n" + facet(bad) + "endsolid a\n", {":6: a vertex needs three numbers"})) << bad;
    }
}

TEST_F(StlVariants, ASolidThatLosesAllItsFacetsLeavesTheOthers) {
    const PolygonSoup soup =
        read("solid a\n" + facet("nan 0 0") + "endsolid\nsolid b\n" + facet("1 1 0") + "endsolid\n");
    EXPECT_EQ(soup.object_names, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(soup.polygon_object, std::vector<std::uint32_t>{1});
}

}  // namespace
}  // namespace burin
