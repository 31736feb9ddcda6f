// What a sheet says that comes to nothing is told once.

#include <gtest/gtest.h>

#include "tests/methods/level_crease.h"

namespace burin::styled_notes_test {
namespace {

using namespace test;

std::vector<std::string> notes_on(const ShadedScene& scene) {
    std::vector<std::string> notes;
    scene.inked(scene.whole(), 1, &notes);
    return notes;
}

TEST(StyledNotes, SayWhichValuesOfALineAreNotNumbers) {
    const std::string style =
        "width = 2\ndash = [\"=0/0\", 4, \"=0/0\", 4]\ndash_phase = \"=0/0\"\nmin_length = \"=0/0\"\n"
        "taper = { start = 3, end = \"=0/0\" }\nwobble = { amplitude = \"=0/0\", wavelength = 9 }\n"
        "overshoot = \"=0/0\"\nhalo = \"=0/0\"\nhalo_depth = [\"=0/0\", 9]\n";
    std::vector<std::string> names;
    for (const std::string& note : notes_on(level(20, 220, 50, style))) {
        EXPECT_NE(note.find(" is not a number at 1 lines, first at pixel "), std::string::npos) << note;
        names.push_back(note.substr(0, note.find(" is not")));
    }
    EXPECT_EQ(names, (std::vector<std::string>{"style ink: taper.end", "style ink: dash_phase", "style ink: overshoot",
                                               "style ink: wobble.amplitude", "style ink: halo",
                                               "style ink: halo_depth", "style ink: min_length", "style ink: dash"}));
    EXPECT_TRUE(notes_on(level(20, 220, 50, "width = 2\ndash = [4, 4]\nmin_length = 3\n")).empty());
}

TEST(StyledNotes, NameSetsWhosePatternsFitNothing) {
    const auto notes_of = [](const std::string& set) { return notes_on(level(20, 220, 50, "width = 2", set)); };
    EXPECT_EQ(notes_of("objects = [\"nothing*\", \"none\"]\n"),
              std::vector<std::string>{"set all: no object fits its objects; parts of a file are called NAME/PART "
                                       "(burin info lists them)"});
    EXPECT_EQ(notes_of("materials = [\"nothing\"]\n"),
              std::vector<std::string>{"set all: no material fits its materials (burin info lists them)"});
    EXPECT_TRUE(notes_of("objects = [\"*\"]\nmaterials = [\"*\"]\n").empty());
    EXPECT_TRUE(notes_of("objects = [\"nothing\"]\nenabled = false\n").empty());
}

TEST(StyledNotes, NameGroupsThatFitNothing) {
    const std::string text = sheet_of(R"("crease")", "width = 2", "select = \"not (object in wheels)\"\n");
    const std::size_t at = text.find("[[set]]");
    StyleSheet sheet = read_sheet_text(text.substr(0, at) +
                                           "[groups]\nwheels = { objects = [\"wheel*\"] }\n"
                                           "all_of_it = { objects = [\"*\"] }\n" +
                                           text.substr(at),
                                       "sheet.toml");
    SheetContext context;
    context.objects = {"body", "door"};
    sheet.file = "sheet.toml";
    EXPECT_EQ(CompiledSheet(sheet, context).notes_on_names(),
              std::vector<std::string>{"group wheels: no object of the scene is in it (burin info lists them)"});
    context.objects.push_back("wheel 1");
    EXPECT_TRUE(CompiledSheet(sheet, context).notes_on_names().empty());
}

TEST(StyledNotes, SayThatWobbleOfContoursJumps) {
    const auto notes_of = [](const std::string& classes, const std::string& wobble, const std::string& set = "") {
        return notes_on({{rectangle(20, 20, 60, 60, 0)},
                         pixel_camera(80, 80),
                         sheet_of(classes, "wobble = { " + wobble + " }", set),
                         80,
                         80});
    };
    const std::string contours = R"("crease", "silhouette")", others = R"("crease", "border", "intersection")";
    const std::vector<std::string> notes = notes_of(contours, "anchor = \"chain\"");
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(notes[0],
              "style ink: wobble with anchor = \"chain\" makes contours jump from frame to frame, for they begin "
              "elsewhere in each view; anchor = \"object\" keeps the waves where they are");
    EXPECT_TRUE(notes_of(contours, "anchor = \"object\"").empty());
    EXPECT_TRUE(notes_of(contours, "amplitude = 2").empty());
    EXPECT_TRUE(notes_of(contours, "anchor = \"chain\", amplitude = 0").empty());
    EXPECT_TRUE(notes_of(others, "anchor = \"chain\"").empty());
    EXPECT_TRUE(notes_of(contours, "anchor = \"chain\"", "enabled = false\n").empty());
    // Two sets with one style: one note.
    const std::string twice =
        "style_version = 1\n[[set]]\nname = \"a\"\nclasses = [\"silhouette\"]\nstyle = \"ink\"\n"
        "[[set]]\nname = \"b\"\nclasses = [\"silhouette\"]\nqi = 1\nstyle = \"ink\"\n"
        "[style.ink]\nwobble = { anchor = \"chain\" }\n";
    EXPECT_EQ(notes_on({{rectangle(20, 20, 60, 60, 0)}, pixel_camera(80, 80), twice, 80, 80}).size(), 1u);
}

}  // namespace
}  // namespace burin::styled_notes_test
