// How the text of an STL may begin, and what is said of others.

#include <gtest/gtest.h>

#include <string>

#include "mesh/readers.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

const std::string kFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

class StlBeginnings : public testing::Test {
  protected:
    PolygonSoup read(std::string_view text) { return read_stl(folder_.write("part.stl", text)); }
    testing::AssertionResult refuses(std::string_view text, std::initializer_list<std::string_view> parts,
                                     bool strict = false) {
        return test::refuses([strict](const std::string& path) { return read_stl(path, strict); },
                             folder_.write("part.stl", text), parts);
    }
    test::TemporaryFolder folder_;
};

TEST_F(StlBeginnings, BlanksAMarkAndAnyCaseStandBeforeTheWordSolid) {
    for (const char* begin :
         {"solid", "SoLiD", "  solid", "\n\r\n\t Solid", "\xEF\xBB\xBFsolid", "\xEF\xBB\xBF \n SOLID"}) {
        const PolygonSoup soup = read(std::string(begin) + " a\n" + kFacet + kFacet + "endsolid\n");
        EXPECT_EQ(soup.polygon_count(), 2u) << begin;
        EXPECT_EQ(soup.object_names, std::vector<std::string>{"a"}) << begin;
        EXPECT_TRUE(soup.notes.empty()) << begin;
    }
}

TEST_F(StlBeginnings, TheWordSolidMayBeMissing) {
    for (const char* begin : {"", "\n \n", "\xEF\xBB\xBF", "\xEF\xBB\xBF\r\n"}) {
        for (const char* end : {"", "endsolid\n", "endsolid b\n\n"}) {
            const std::string text = begin + kFacet + kFacet + end;
            const PolygonSoup soup = read(text);
            EXPECT_EQ(soup.polygon_count(), 2u) << text;
            EXPECT_EQ(soup.object_names, std::vector<std::string>{"part"}) << text;
            ASSERT_EQ(soup.notes.size(), 1u) << text;
            EXPECT_NE(soup.notes[0].find("the word 'solid' is missing in front of the first facet"), std::string::npos);
            EXPECT_TRUE(refuses(text, {"the word 'solid' is missing"}, true)) << text;
        }
    }
    std::string capitals = kFacet;
    for (char& c : capitals) c = static_cast<char>(std::toupper(c));
    EXPECT_EQ(read(capitals).polygon_count(), 1u);
    const PolygonSoup two = read(kFacet + "endsolid\nsolid b\n" + kFacet + "endsolid b\n");
    EXPECT_EQ(two.object_names, (std::vector<std::string>{"part", "b"}));
}

TEST_F(StlBeginnings, WithoutTheWordFilesMustEndBehindAFacet) {
    for (std::size_t size = 1; size + 1 < kFacet.size(); ++size) {
        EXPECT_TRUE(refuses(kFacet + kFacet.substr(0, size), {})) << size;
    }
    EXPECT_TRUE(refuses(kFacet + "facet normal 0 0 1\n", {":8: the file ends in the middle of a facet"}));
    EXPECT_TRUE(refuses("solid a\n" + kFacet, {":8: the file ends in the middle of a solid"}));
    EXPECT_TRUE(refuses(kFacet + "solid a\n" + kFacet, {":15: the file ends in the middle of a solid"}));
    EXPECT_TRUE(refuses(kFacet + "endsolid\n" + kFacet, {":11: a vertex stands outside of any solid"}));
}

TEST_F(StlBeginnings, OtherTextIsRefusedForWhatItIs) {
    EXPECT_TRUE(refuses("sold a\n" + kFacet + "endsolid\n", {":1: unknown word 'sold'"}));
    EXPECT_TRUE(refuses("# by hand\nsolid a\n" + kFacet + "endsolid\n", {":1: unknown word '#'"}));
    std::string wide = "\xFF\xFE";
    for (const char c : "solid a\n" + kFacet + kFacet + "endsolid\n") wide += {c, '\0'};
    EXPECT_TRUE(refuses(wide, {"the text is UTF-16"}));
}

}  // namespace
}  // namespace burin
