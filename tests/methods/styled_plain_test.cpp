// A sheet with the look of [lines] makes the picture that [lines] makes.

#include <gtest/gtest.h>

#include "tests/support/shaded_scene.h"

namespace burin::styled_plain_test {
namespace {

using namespace test;

std::string classes_of(LineClassSet classes) {
    std::string text;
    for (std::size_t c = 0; c < kLineClassCount; ++c) {
        if (classes.has(static_cast<LineClass>(c)))
            text += (text.empty() ? "\"" : ", \"") + std::string(kLineClassNames[c]) + "\"";
    }
    return text;
}

constexpr int kWidth = 200, kHeight = 160;

struct PlainLook {
    std::string name, sheet;
    std::vector<Override> overrides;
};

std::vector<PlainLook> plain_looks() {
    const std::string set = "[[set]]\nname='visible'\nstyle='ink'\nclasses=[CLASSES]\n";
    const std::string behind = "[[set]]\nname='behind'\nstyle='behind'\nqi=[1,255]\nclasses=[CLASSES]\n";
    return {
        {"plain", set + "[style.ink]\nwidth=1\n", {}},
        {"wide", set + "[style.ink]\nwidth=6\n", {{"lines.width", "6"}}},
        {"hidden",
         set + behind + "[style.ink]\nwidth=1\n[style.behind]\nwidth=2\ncolor='#808080'\n",
         {{"lines.hidden.style", "\"solid\""}, {"lines.hidden.width", "2"}, {"lines.hidden.color", "\"#808080\""}}},
        {"inside", set + "[style.ink]\nwidth=6\nside='inside'\n", {{"lines.side", "\"inside\""}, {"lines.width", "6"}}},
        {"outside",
         set + "[style.ink]\nwidth=6\nside='outside'\n",
         {{"lines.side", "\"outside\""}, {"lines.width", "6"}}},
        {"fading",
         "crease_angle=[20,60]\n" + set + "[style.ink]\nwidth=2\n",
         {{"lines.crease_angle", "[20, 60]"}, {"lines.width", "2"}}},
    };
}

class StyledPlain : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, StyledPlain,
                         ::testing::Values("cage", "crossing", "cube", "flange", "star", "still_life", "teapot"),
                         [](const auto& of) { return of.param; });

/// The pictures are equal to the bit, layers of classes and of hidden lines as well. Only where creases that fade meet
/// do they differ: of these, [lines] shows the more opaque one, and a sheet lays one over the other.
TEST_P(StyledPlain, IsWhatLinesSay) {
    const std::string path = BURIN_SOURCE_FOLDER "/scenes/" + GetParam() + ".toml";
    for (const PlainLook& look : plain_looks()) {
        if (look.name == "fading" && (GetParam() == "cage" || GetParam() == "teapot")) continue;
        std::vector<Override> overrides = look.overrides;
        for (const std::string_view c : kLineClassNames)
            overrides.push_back({"lines.colors." + std::string(c), "\"#000000\""});
        ShadedScene plain(read_scene_file(path, overrides), kWidth, kHeight);
        std::string sheet = look.sheet;
        for (std::size_t at; (at = sheet.find("CLASSES")) != std::string::npos;)
            sheet.replace(at, 7, classes_of(plain.scene().lines.classes));
        const ShadedScene styled(read_scene_file(path, {{"lines.draw", "\"all\""}}), sheet, kWidth, kHeight);
        // Sheets look for edges that another one covers, too.
        Frame frame = plain.frame(plain.whole());
        frame.needs.whole_picture = true;
        EXPECT_TRUE(same_bits(plain.draw(frame), styled.draw())) << look.name;
    }
}

}  // namespace
}  // namespace burin::styled_plain_test
