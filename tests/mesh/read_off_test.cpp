#include <gtest/gtest.h>

#include <string>

#include "mesh/readers.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin::read_off_test {
namespace {

using test::Polygons;
using test::polygons_of;

const std::string kPositions = "0 0 0\n1 0 0\n1 1 0\n0 1.5 0\n";

class ReadOff : public testing::Test {
  protected:
    PolygonSoup read(std::string_view text) { return read_off(folder_.write("part.off", text)); }
    testing::AssertionResult refuses(std::string_view text, std::initializer_list<std::string_view> parts) {
        return test::refuses([](const std::string& path) { return read_off(path); }, folder_.write("part.off", text),
                             parts);
    }
    test::TemporaryFolder folder_;
};

TEST_F(ReadOff, ReadsPolygonsOfAnySize) {
    const std::string text = "OFF\n4 3 0\n" + kPositions + "3 0 1 2\n4 0 1 2 3\n2 0 1\n";
    const Polygons expected{{0, 1, 2}, {0, 1, 2, 3}, {0, 1}};
    const PolygonSoup soup = read(text);
    EXPECT_EQ(polygons_of(soup), expected);
    EXPECT_EQ(soup.positions[3], glm::dvec3(0, 1.5, 0));
    EXPECT_EQ(soup.object_names, std::vector<std::string>{"part"});
    EXPECT_EQ(polygons_of(read(text.substr(0, text.size() - 1))), expected) << "no final line feed";
    std::string crlf;
    for (const char c : text) crlf += c == '\n' ? "\r\n" : std::string(1, c);
    EXPECT_EQ(polygons_of(read(crlf)), expected);
}

TEST_F(ReadOff, CountsMayStandOnTheHeaderLine) {
    for (const char* head :
         {"OFF 4 1 0\n", "OFF 4 1\n", "OFF\n4 1\n", " OFF\t4 1 # counts\n", "OFF # see below\n\n4 1 5\n"}) {
        EXPECT_EQ(polygons_of(read(head + kPositions + "3 0 1 2\n")), (Polygons{{0, 1, 2}})) << head;
    }
}

TEST_F(ReadOff, CommentsAndEmptyLinesAreSkipped) {
    EXPECT_EQ(polygons_of(read("# made by hand\n\nOFF\n# counts\n4 1 0\n\n0 0 0 # first\n1 0 0\n#\n1 1 0\n0 1 0\n  \n3 "
                               "0 1 2#end\n# tail\n")),
              (Polygons{{0, 1, 2}}));
}

TEST_F(ReadOff, ColoursNormalsAndTextureCoordinatesAreSkipped) {
    const Polygons expected{{0, 1, 2}, {0, 2, 1}};
    for (const char* word : {"OFF", "COFF", "NOFF", "STOFF", "CNOFF", "STCNOFF"}) {
        const PolygonSoup soup =
            read(std::string(word) +
                 "\n3 2 0\n0 0 0 255 0 0 255\n2 0 0 0.5 0.5 1\n0 3 0 1 1\n3 0 1 2 255 0 0\n3 0 2 1 0.1 0.2 0.3 1.0\n");
        EXPECT_EQ(polygons_of(soup), expected) << word;
        EXPECT_EQ(soup.positions[1], glm::dvec3(2, 0, 0)) << word;
    }
}

TEST_F(ReadOff, OtherHeadersAreRefused) {
    const std::string rest = "4 1 0\n" + kPositions + "3 0 1 2\n";
    EXPECT_TRUE(refuses("PLY\n" + rest, {":1: this is no OFF file"}));
    EXPECT_TRUE(refuses("x" + rest, {":1: this is no OFF file"}));
    EXPECT_TRUE(refuses("4OFF\n" + rest, {":1: ", "three dimensions"}));
    EXPECT_TRUE(refuses("nOFF\n4\n" + rest, {":2: ", "three dimensions"}));
    EXPECT_TRUE(refuses("OFF BINARY\n" + rest, {":1: binary OFF is not read"}));
    EXPECT_TRUE(refuses("# nothing\n", {"the file ends where the word OFF should be"}));
    EXPECT_TRUE(refuses("", {"empty"}));
}

TEST_F(ReadOff, CountsMustFitTheFile) {
    for (const char* count : {"4000000000", "400000000", "9223372036854775807"}) {
        EXPECT_TRUE(
            refuses("OFF\n" + std::string(count) + " 1 0\n" + kPositions, {":2: ", count, " vertices do not fit"}));
        EXPECT_TRUE(
            refuses("OFF\n4 " + std::string(count) + " 0\n" + kPositions, {":2: ", count, " polygons do not fit"}));
    }
    for (const char* count : {"0", "-1", "x", "1.5", "99999999999999999999"}) {
        EXPECT_TRUE(refuses("OFF\n" + std::string(count) + " 1 0\n" + kPositions,
                            {":2: the number of vertices must be a positive integer"}));
        EXPECT_TRUE(refuses("OFF\n4 " + std::string(count) + " 0\n" + kPositions,
                            {":2: the number of polygons must be a positive integer"}));
    }
    EXPECT_TRUE(refuses("OFF\n4\n" + kPositions, {":2: the number of polygons"}));
}

TEST_F(ReadOff, TruncatedFilesAreRefused) {
    const std::string whole = "OFF\n4 2 0\n" + kPositions + "3 0 1 2\n4 0 1 2 3";
    for (std::size_t size = 1; size < whole.size(); ++size) {
        EXPECT_TRUE(refuses(whole.substr(0, size), {})) << "after " << size;
    }
    EXPECT_TRUE(refuses("OFF\n4 2 0\n" + kPositions + "3 0 1 2\n", {":7: the file ends where a polygon should be"}));
}

TEST_F(ReadOff, VerticesMustBeThreeFiniteNumbers) {
    for (const char* bad : {"nan 0 0", "0 inf 0", "0 0 1e31", "0 0 -1e31", "1 2", "0 0 x", "1,0,0"}) {
        EXPECT_TRUE(refuses("OFF\n3 1 0\n0 0 0\n" + std::string(bad) + "\n0 1 0\n3 0 1 2\n", {":4: "})) << bad;
    }
}

TEST_F(ReadOff, VertexNumbersMustExist) {
    const std::string head = "OFF\n4 1 0\n" + kPositions;
    for (const char* bad : {"4", "-1", "4294967296", "99999999999999999999", "x", "1.5"}) {
        EXPECT_TRUE(refuses(head + "3 0 1 " + bad + "\n", {":7: "})) << bad;
    }
    for (const char* bad : {"4 0 1 2", "4000000000 0 1 2", "9223372036854775807 0 1 2", "-3 0 1 2", "x 0 1 2"}) {
        EXPECT_TRUE(refuses(head + bad + "\n", {":7: a polygon"})) << bad;
    }
}

}  // namespace
}  // namespace burin::read_off_test
