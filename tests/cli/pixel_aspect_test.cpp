// What files say of pixels that are not square, and which cannot.

#include <gtest/gtest.h>

#include <cstring>

#include "tests/cli/program.h"
#include "tests/support/exr_header.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::pixel_aspect_test {
namespace {

const std::string kScene = std::string(BURIN_SOURCE_FOLDER) + "/scenes/still_life.toml";

ProgramResult rendered(const TemporaryFolder& folder, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"render", kScene, "-r", "160x120", "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_burin(folder.path(), arguments);
}
float number_of(const ExrHeader& header, const std::string& name) {
    float value = 0;
    std::memcpy(&value, header.parts[0].at(name).bytes.data(), sizeof value);
    return value;
}

TEST(PixelAspect, IsAnAttributeOfAnExr) {
    const TemporaryFolder folder;
    ASSERT_EQ(rendered(folder, {"-o", "square.exr"}).err, "");
    ASSERT_EQ(rendered(folder, {"--set", "camera.pixel_aspect=1", "-o", "same.exr"}).err, "");
    ASSERT_EQ(rendered(folder, {"--set", "camera.pixel_aspect=2", "-o", "wide.exr"}).err, "");
    EXPECT_TRUE(read_file(folder.file("square.exr")) == read_file(folder.file("same.exr")));
    const ExrHeader square(read_file(folder.file("square.exr"))), wide(read_file(folder.file("wide.exr")));
    EXPECT_EQ(number_of(square, "pixelAspectRatio"), 1);
    EXPECT_EQ(number_of(wide, "pixelAspectRatio"), 2);
    // The camera is as far away and sees as much upwards, so twice as much to the sides.
    EXPECT_NEAR(number_of(wide, "screenWindowWidth"), 2 * number_of(square, "screenWindowWidth"), 1e-5);
    EXPECT_NE(wide.parts[0].at("burin/camera").bytes.find(", pixel_aspect = 2"), std::string::npos);
}

TEST(PixelAspect, IsKeptWithSavedLines) {
    const TemporaryFolder folder;
    ASSERT_EQ(rendered(folder, {"--set", "camera.pixel_aspect=0.5", "--style", "pencil", "--layers", "lines", "-o",
                                "a.exr", "--save-lines", "a.lines"})
                  .err,
              "");
    ASSERT_EQ(
        run_burin(folder.path(), {"restyle", "a.lines", "--style", "pencil", "--layers", "lines", "-o", "b.exr"}).err,
        "");
    EXPECT_TRUE(read_file(folder.file("a.exr")) == read_file(folder.file("b.exr")));
}

TEST(PixelAspect, IsRefusedWhereThereAreNoSuchPixels) {
    const TemporaryFolder folder;
    for (const char* const file : {"a.svg", "a.pdf", "a.dxf"}) {
        const ProgramResult result = rendered(folder, {"--set", "camera.pixel_aspect=2", "-o", file});
        EXPECT_EQ(result.status, 2) << file;
        EXPECT_NE(result.err.find("pixel_aspect"), std::string::npos) << result.err;
        EXPECT_TRUE(folder.names().empty());
    }
    const ProgramResult paper = rendered(folder, {"--set", "camera.pixel_aspect=2", "--paper", "A4", "-o", "a.png"});
    EXPECT_NE(paper.status, 0);
    EXPECT_NE(paper.err.find("pixels on paper are square"), std::string::npos) << paper.err;
    for (const char* const bad : {"0", "0.09", "10.5", "nan", "wide", "[1, 2]"}) {
        const ProgramResult result =
            rendered(folder, {"--set", std::string("camera.pixel_aspect=") + bad, "-o", "a.png"});
        EXPECT_NE(result.status, 0) << bad;
        EXPECT_NE(result.err.find("pixel_aspect"), std::string::npos) << result.err;
    }
}

}  // namespace
}  // namespace burin::test::pixel_aspect_test
