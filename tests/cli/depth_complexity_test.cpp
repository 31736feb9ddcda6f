// Pictures with surfaces over each other by the thousand are refused before they are drawn.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::depth_complexity_test {
namespace {

using Arguments = std::vector<std::string>;

/// Squares of 2 x 2 units above each other, as quads.
std::string pile(int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
        for (const char* corner : {"-1 -1", "1 -1", "1 1", "-1 1"})
            text += "v " + std::string(corner) + " " + std::to_string(i * 0.001) + "\n";
    }
    for (int i = 0; i < count; ++i) {
        const int first = 4 * i + 1;
        text += "f";
        for (int k = 0; k < 4; ++k) text += " " + std::to_string(first + k);
        text += "\n";
    }
    return text;
}

class DepthOfPiles : public testing::Test {
  protected:
    DepthOfPiles() { folder_.write("pile.obj", pile(kSquares)); }

    /// The squares fill the picture.
    ProgramResult draw(const char* size, const Arguments& more, const std::string& x = "0") const {
        Arguments arguments = {"render", "pile.obj", "-o", "out.png", "-q", "-r", size, "--ortho", "2"};
        arguments.insert(arguments.end(), {"--eye", x + ",0,5", "--target", x + ",0,0"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_burin(folder_.path(), arguments);
    }

    static constexpr int kSquares = 40;
    TemporaryFolder folder_;
};

TEST_F(DepthOfPiles, IsTheNumberOfSurfacesOverEachPixel) {
    EXPECT_EQ(draw("40x40", {"--depth-complexity", "1"}).status, 1);
    EXPECT_EQ(folder_.names().size(), 1u);                    // nothing is written
    for (const char* size : {"16x16", "40x40", "128x128"}) {  // of small triangles, and of large ones
        EXPECT_EQ(draw(size, {"--depth-complexity", "40.1"}).status, 0) << size;
        const ProgramResult refused = draw(size, {"--depth-complexity", "39.9"});
        EXPECT_EQ(refused.status, 1) << size;
        EXPECT_EQ(refused.err.find("pile.obj: 40 surfaces lie over each pixel, on average, more than the 40 "), 0u)
            << refused.err;
        EXPECT_NE(refused.err.find("--depth-complexity 42\n"), std::string::npos) << refused.err;
    }
}

TEST_F(DepthOfPiles, CountsWhatIsInThePicture) {
    // Half of the squares' area is beside the picture.
    for (const char* size : {"40x40", "128x128"}) {
        EXPECT_EQ(draw(size, {"--depth-complexity", "20.1"}, "1").status, 0) << size;
        EXPECT_EQ(draw(size, {"--depth-complexity", "19.9"}, "1").status, 1) << size;
    }
}

TEST_F(DepthOfPiles, IsRefusedByAnyNumberOfThreadsAndPieces) {
    for (const Arguments& how : {Arguments{"-j", "3"}, Arguments{"--memory", "60M"}}) {
        for (const char* most : {"39.9", "40.1"}) {
            Arguments arguments = how;
            arguments.insert(arguments.end(), {"--depth-complexity", most});
            EXPECT_EQ(draw("128x128", arguments).status, most == std::string("40.1") ? 0 : 1) << how[0] << " " << most;
        }
    }
}

TEST_F(DepthOfPiles, IsLimitedUnlessMoreIsAllowed) {
    folder_.write("pile.obj", pile(2100));
    EXPECT_EQ(draw("16x16", {}).status, 1);
    EXPECT_EQ(draw("16x16", {"--depth-complexity", "1e6"}).status, 0);
    for (const char* wrong : {"0", "-3", "nan", "2e9", "many", ""})
        EXPECT_EQ(draw("16x16", {"--depth-complexity", wrong}).status, 2) << wrong;
    EXPECT_EQ(draw("16x16", {"--depth-complexity", "5", "-m", "patel"}).status, 2);
}

}  // namespace
}  // namespace burin::test::depth_complexity_test
