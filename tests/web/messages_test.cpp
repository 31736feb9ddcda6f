// What a page sends is checked before anything is done.

#include "web/view_message.h"

#include <gtest/gtest.h>

#include <string>

#include "base/error.h"

namespace burin::test::messages_test {
namespace {

const std::string kCamera = "[camera]\neye = [1, 2, 3]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\n";

std::string refusal_of(const std::string& text) {
    try {
        read_view_message(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "it was read";
}

TEST(ViewMessages, SayWhatIsWanted) {
    const ViewMessage draw =
        read_view_message("kind = \"draw\"\nnumber = 5\nsize = [640, 480]\nfull = true\n" + kCamera + "height = 2.5\n");
    EXPECT_EQ(draw.kind, ViewMessage::Kind::draw);
    EXPECT_EQ(draw.number, 5);
    EXPECT_EQ(draw.view.width, 640);
    EXPECT_EQ(draw.view.eye, glm::dvec3(1, 2, 3));
    EXPECT_TRUE(draw.is_full);
    EXPECT_TRUE(draw.view.camera().orthographic);
    EXPECT_EQ(draw.view.camera().height, 2.5);
    const ViewMessage look = read_view_message(
        "kind = \"look\"\nlines = [\"crease\", \"mark\"]\nwidth = 2\nhidden = \"dashed\"\nstyle = \"comic\"\n"
        "sheet = \"a\\nb\"\n[parameters]\nwidth = \"3mm\"\n");
    EXPECT_EQ(look.look.classes, LineClass::crease | LineClass::mark);
    EXPECT_EQ(look.look.hidden, HiddenStyle::dashed);
    EXPECT_EQ(look.look.sheet, "a\nb");
    ASSERT_EQ(look.look.parameters.size(), 1u);
    EXPECT_EQ(look.look.parameters[0].second, "3mm");
}

TEST(ViewMessages, AreRefusedWithAReason) {
    const std::string size = "kind = \"draw\"\nsize = [640, 480]\n";
    const std::pair<std::string, std::string> bad[] = {
        {"", "kind is missing"},
        {"kind = \"quit\"", "kind: must be one of"},
        {"kind = 3", "kind"},
        {"this is no TOML", "message:1:"},
        {"kind = \"draw\"\n" + kCamera, "size is missing"},
        {size, "camera is missing"},
        {size + "[camera]\neye = [1, 2, 3]\nup = [0, 1, 0]\n", "target is missing"},
        {size + "[camera]\neye = [nan, 2, 3]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\n", "must be a finite number"},
        {size + "[camera]\neye = [inf, 2, 3]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\n", "must be a finite number"},
        {size + kCamera + "fov = 180\n", "fov"},
        {size + kCamera + "fov = nan\n", "fov"},
        {size + kCamera + "height = -1\n", "height"},
        {size + kCamera + "fov = 30\nheight = 1\n", "height"},
        {size + kCamera + "file = \"/etc/passwd\"\n", "file"},
        {size + "file = \"/etc/passwd\"\n" + kCamera, "file"},
        {"kind = \"draw\"\nsize = [0, 480]\n" + kCamera, "size"},
        {"kind = \"draw\"\nsize = [4097, 480]\n" + kCamera, "size"},
        {"kind = \"draw\"\nsize = [64.5, 480]\n" + kCamera, "size"},
        {"kind = \"draw\"\nsize = [nan, 480]\n" + kCamera, "size"},
        {"kind = \"draw\"\nsize = [64]\n" + kCamera, "size"},
        {"kind = \"explain\"\nsize = [64, 48]\nx = 64\ny = 0\n" + kCamera, "x"},
        {"kind = \"explain\"\nsize = [64, 48]\nx = 0\ny = -1\n" + kCamera, "y"},
        {"kind = \"explain\"\nsize = [64, 48]\nx = 0\n" + kCamera, "x or y is missing"},
        {"kind = \"explain\"\nsize = [64, 48]\nx = 0\ny = 0\nreach = 65\n" + kCamera, "reach"},
        {"kind = \"save\"\nsize = [64, 48]\n" + kCamera, "format is missing"},
        {"kind = \"save\"\nsize = [64, 48]\nformat = \"exr\"\n" + kCamera, "format"},
        {"kind = \"look\"\nlines = [\"lines\"]", "unknown line class 'lines'"},
        {"kind = \"look\"\nwidth = 0", "width"},
        {"kind = \"look\"\ncrease_angle = 181", "crease_angle"},
        {"kind = \"look\"\nhidden = \"maybe\"", "hidden"},
        {"kind = \"look\"\nshading = \"expression\"", "shading"},
        {"kind = \"look\"\n[parameters]\nwidth = 3", "width"},
        {"kind = \"look\"\n" + std::string(kMostMessageBytes, '#'), "more than 64 kB"},
        {"a = " + std::string(1000, '['), "message"},
    };
    for (const auto& [text, reason] : bad) {
        const std::string refusal = refusal_of(text);
        EXPECT_NE(refusal.find(reason), std::string::npos) << text.substr(0, 200) << "\n" << refusal;
        EXPECT_TRUE(refusal.starts_with("message")) << refusal;
    }
}

}  // namespace
}  // namespace burin::test::messages_test
