// What stands before the vertices of an OFF file, as the programs in use write it.

#include <gtest/gtest.h>

#include <string>

#include "mesh/readers.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::Polygons;
using test::polygons_of;

const std::string kPositions = "0 0 0\n1 0 0\n1 1 0\n0 1.5 0\n";
const std::string kRest = kPositions + "3 0 1 2\n4 0 1 2 3";

class OffHeaders : public testing::Test {
  protected:
    testing::AssertionResult is_read(const std::string& header) {
        const std::string path = folder_.write("part.off", header + kRest);
        try {
            const PolygonSoup soup = read_off(path);
            if (polygons_of(soup) != Polygons{{0, 1, 2}, {0, 1, 2, 3}} || soup.positions[3] != glm::dvec3(0, 1.5, 0))
                return testing::AssertionFailure() << "read wrongly";
        } catch (const InputError& error) {
            return testing::AssertionFailure() << error.what();
        }
        return testing::AssertionSuccess();
    }
    testing::AssertionResult refuses(std::string_view text, std::initializer_list<std::string_view> parts) {
        return test::refuses([](const std::string& path) { return read_off(path); }, folder_.write("part.off", text),
                             parts);
    }
    test::TemporaryFolder folder_;
};

TEST_F(OffHeaders, CountsMayBeGluedToTheWord) {
    for (const char* header : {"OFF4 2 5\n", "OFF4 2\n", "OFF4\n2 5\n", "COFF4 2 5 # counts\n", "STCNOFF4 2 0\n",
                               "off4 2 5\n", "OFF+4 2 0\n"}) {
        EXPECT_TRUE(is_read(header)) << header;
    }
    EXPECT_TRUE(refuses("OFF-4 2 5\n" + kRest, {":1: the number of vertices must be a positive integer"}));
    EXPECT_TRUE(refuses("OFF4.5 2 5\n" + kRest, {":1: the number of vertices must be a positive integer"}));
    EXPECT_TRUE(refuses("OFF40000 2 5\n" + kRest, {":1: 40000 vertices do not fit"}));
}

TEST_F(OffHeaders, CountsMayStandOnSeveralLines) {
    for (const char* header :
         {"OFF\n4 2 5\n", "OFF\n4 2\n", "OFF\n4\n2\n5\n", "OFF 4\n2\n", "OFF\n4\n2 5\n", "OFF\n4 2\n5\n",
          "OFF # a\n# b\n4 # vertices\n\n2 # polygons\n# edges\n5\n\n", "OFF 4 2\n5\n", "\n \nOFF\n\n4\n\n2\n"}) {
        EXPECT_TRUE(is_read(header)) << header;
    }
    EXPECT_TRUE(refuses("OFF\n4\n" + kRest, {":2: the number of polygons is missing"}));
    EXPECT_TRUE(refuses("OFF\n4\n2\nx\n" + kRest, {":4: a vertex needs three numbers"}));
    EXPECT_TRUE(refuses("OFF\n4 # and no more\n", {"the file ends where the number of polygons should be"}));
}

TEST_F(OffHeaders, TheWordMayBeMissing) {
    for (const char* header : {"4 2 5\n", "4 2\n", "# made by hand\n\n4 2 0 # counts\n"})
        EXPECT_TRUE(is_read(header)) << header;
    EXPECT_TRUE(refuses("4\n2\n" + kRest, {":1: this is no OFF file"}));
    EXPECT_TRUE(refuses("4 2 5 1\n" + kRest, {":1: this is no OFF file"}));
}

/// nOFF: the number of dimensions stands before the counts.
TEST_F(OffHeaders, ThreeDimensionsMayBeSaid) {
    for (const char* header : {"nOFF\n3\n4 2 5\n", "nOFF 3\n4 2\n", "nOFF 3 4 2 5\n", "nOFF # a\n\n3 # b\n4\n2\n",
                               "CnOFF\n3\n4 2 0\n", "NnOFF\n3\n4 2 0\n"}) {
        EXPECT_TRUE(is_read(header)) << header;
    }
    for (const char* header : {"nOFF\n4\n4 2 0\n", "nOFF\n2\n4 2 0\n", "nOFF\n4 2 0\n", "CnOFF\nx\n4 2 0\n"})
        EXPECT_TRUE(refuses(header + kRest, {":2: ", "three dimensions"})) << header;
}

TEST_F(OffHeaders, TheWordMayBeInSmallLettersWhereThatIsClear) {
    for (const char* word :
         {"off", "Off", "coff", "stoff", "COFF", "NOFF", "Noff", "CNOFF", "STOFF", "STCNOFF", "\xEF\xBB\xBFOFF"}) {
        EXPECT_TRUE(is_read(std::string(word) + "\n4 2 0\n")) << word;
    }
    EXPECT_TRUE(refuses("noff\n4 2 0\n" + kRest, {":1: 'noff' may mean normals (NOFF) or dimensions (nOFF)"}));
    EXPECT_TRUE(refuses("cnoff\n4 2 0\n" + kRest, {":1: 'cnoff' may mean"}));
    for (const char* word : {"4OFF", "4nOFF", "C4OFF", "4off"}) {
        EXPECT_TRUE(refuses(std::string(word) + "\n4 2 0\n" + kRest, {":1: ", "three dimensions"})) << word;
    }
    EXPECT_TRUE(refuses("nstoff\n4 2 0\n" + kRest, {":1: 'nstoff' may mean"}));
    for (const char* word : {"OF", "XOFF", "OFFS", "4", "4 OFF", "OFF_"}) {
        EXPECT_TRUE(refuses(std::string(word) + "\n4 2 0\n" + kRest, {":1: this is no OFF file"})) << word;
    }
    EXPECT_TRUE(refuses("OFF Binary\n4 2 0\n", {":1: binary OFF is not read"}));
}

}  // namespace
}  // namespace burin
