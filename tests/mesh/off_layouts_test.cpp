// An OFF file is a row of values: vertices and polygons may share lines, or go on over several.

#include <gtest/gtest.h>

#include <string>

#include "mesh/readers.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

class OffLayouts : public testing::Test {
  protected:
    void expect_square(const std::string& text) {
        const PolygonSoup soup = read_off(folder_.write("part.off", text), true);
        EXPECT_EQ(soup.positions, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1.5, 0}})) << text;
        EXPECT_EQ(test::polygons_of(soup), (test::Polygons{{0, 1, 2}, {0, 2, 3}})) << text;
        EXPECT_TRUE(soup.notes.empty()) << text;
    }
    testing::AssertionResult refuses(std::string_view text, std::initializer_list<std::string_view> parts) {
        return test::refuses([](const std::string& path) { return read_off(path); }, folder_.write("part.off", text),
                             parts);
    }
    test::TemporaryFolder folder_;
};

TEST_F(OffLayouts, ItemsMayShareLines) {
    const std::string vertices[] = {"0 0 0\n1 0 0\n1 1 0\n0 1.5 0\n", "0 0 0 1 0 0 1 1 0 0 1.5 0\n",
                                    "0 0 0  1 0 0 # two\n\n1 1 0\t0 1.5 0\n", "0\n0 0 1\n0 0 1 1\n0 0\n1.5 0\n"};
    const std::string polygons[] = {"3 0 1 2\n3 0 2 3\n", "3 0 1 2 3 0 2 3", "3 0 1 2  3 0\n2 3\n# end\n",
                                    "3\n0\n1\n2\n3\n0\n2\n3\n"};
    for (const std::string& v : vertices) {
        for (const std::string& p : polygons) {
            for (const char* head : {"OFF\n4 2 5\n", "OFF 4 2 5\n", "OFF\n4 2 0\n# made by hand\n"})
                expect_square(head + v + p);
        }
    }
    expect_square("OFF 4 2 5 0 0 0 1 0 0 1 1 0 0 1.5 0 3 0 1 2 3 0 2 3");
    expect_square("OFF\n4 2 5\n0 0 0 1 0 0 1 1 0 0 1.5 0 3 0 1 2 3 0 2 3\n\n");
}

TEST_F(OffLayouts, VerticesThatShareLinesMayHaveWhatTheWordAnnounces) {
    const auto vertices = [](const std::string& more) {
        return "0 0 0 " + more + " 1 0 0 " + more + "\n1 1 0 " + more + " 0 1.5 0 " + more + "\n";
    };
    const std::string polygons = "3 0 1 2 255 0 0\n3 0 2 3 0.1 0.2 0.3 1\n";
    expect_square("NOFF\n4 2 0\n" + vertices("0 0 1") + polygons);
    expect_square("COFF\n4 2 0\n" + vertices("255 0 0 255") + polygons);
    expect_square("STOFF\n4 2 0\n" + vertices("0.5 0.5") + polygons);
    expect_square("STCNOFF\n4 2 0\n" + vertices("0 0 1 1 0.5 0 1 0.5 0.5") + polygons);
}

TEST_F(OffLayouts, ColoursOfPolygonsAreNoPolygons) {
    const PolygonSoup soup = read_off(
        folder_.write("part.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 0 1 0\n3 2 1 0 1 1 1 1\n"), true);
    EXPECT_EQ(test::polygons_of(soup), (test::Polygons{{0, 1, 2}, {2, 1, 0}}));
}

TEST_F(OffLayouts, WhatIsLeftOverIsNotedInEachLayout) {
    for (const char* polygons : {"3 0 1 2 3 0 2 3 9\n", "3 0 1 2\n3 0 2 3\nmore\n"}) {
        const std::string text = std::string("OFF\n4 2 0\n0 0 0 1 0 0\n1 1 0 0 1.5 0\n") + polygons;
        const PolygonSoup soup = read_off(folder_.write("part.off", text));
        EXPECT_EQ(test::polygons_of(soup), (test::Polygons{{0, 1, 2}, {0, 2, 3}})) << text;
        ASSERT_EQ(soup.notes.size(), 1u) << text;
        EXPECT_NE(soup.notes[0].find("lines behind the last polygon left out: 1"), std::string::npos) << soup.notes[0];
    }
    EXPECT_TRUE(refuses("OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1.5 0\n3 0 1 2 3 0 2\n3 0 2 3 1 1 1\n",
                        {"the file ends where a polygon should be"}));
}

TEST_F(OffLayouts, WhatIsWrongIsNamedInEachLayout) {
    const std::string head = "OFF\n4 2 0\n0 0 0 1 0 0\n1 1 0 0 1.5 0\n";
    EXPECT_TRUE(refuses(head + "3 0 1 2 3 0 9 3\n", {"vertex 9 does not exist"}));
    EXPECT_TRUE(refuses(head + "3 0 1 2 3 0 x 3\n", {"has only 1 vertex numbers"}));
    EXPECT_TRUE(refuses(head + "3 0 1 2 3 0 2\n", {"the file ends where"}));
    EXPECT_TRUE(refuses(head + "3 0 1 2 0 3 0 2 3\n", {"a polygon starts with its number of corners"}));
}

}  // namespace
}  // namespace burin
