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

/// The notes on a sheet with one set `a` and one style `ink`, in a scene of a box and a door.
std::vector<std::string> notes_of_names(const std::string& set, const std::string& style,
                                        const std::string& rest = "") {
    const StyleSheet sheet =
        read_sheet_text("style_version = 1\n[[set]]\nname = \"a\"\nclasses = [\"crease\"]\nstyle = \"ink\"\n" + set +
                            "\n[style.ink]\n" + style + "\n" + rest,
                        "sheet.toml");
    SheetContext context;
    context.objects = {"box", "door"};
    context.materials = {"steel"};
    return CompiledSheet(sheet, context).notes_on_names();
}

using Notes = std::vector<std::string>;

TEST(StyledNotes, NameNamesInExpressionsThatNothingHas) {
    const std::string listed = " (burin info lists them)";
    const std::string bxo = "no object fits 'bxo', did you mean 'box'?" + listed;
    EXPECT_EQ(notes_of_names("select = 'object == \"bxo\" or object2 == \"bxo\"'", ""), Notes{"set a: " + bxo});
    EXPECT_EQ(notes_of_names("select = 'between_objects(\"bxo\", \"door\")'", ""), Notes{"set a: " + bxo});
    EXPECT_EQ(notes_of_names("select = 'between_materials(\"stele\", \"*\")'", ""),
              Notes{"set a: no material fits 'stele', did you mean 'steel'?" + listed});
    EXPECT_EQ(notes_of_names("select = 'object != \"wheel*\"'", ""), Notes{"set a: no object fits 'wheel*'" + listed});
    EXPECT_EQ(notes_of_names("", "width = '=object == \"bxo\" ? 2 : 1'\nopacity = '=material == \"x\"'"),
              (Notes{"style ink: " + bxo, "style ink: no material fits 'x'" + listed}));
    EXPECT_EQ(notes_of_names("", "width = \"=wide\"\nopacity = \"=wide\"",
                             "[let]\nwide = '=object == \"bxo\" ? 2 : 1'\nnone = '=object == \"door 2\"'"),
              Notes{"style ink: " + bxo});
    EXPECT_EQ(notes_of_names("select = 'object == \"bo*\" or class == \"mark\" or object2 == \"door\"'", ""), Notes{});
    EXPECT_EQ(notes_of_names("enabled = false\nselect = 'object == \"bxo\"'", "width = '=object == \"bxo\"'"), Notes{});
    EXPECT_EQ(notes_of_names("", "", "[style.other]\nwidth = '=object == \"bxo\"'"), Notes{});
}

TEST(StyledNotes, NameWhatPatternsOfASetMayMean) {
    const std::string parts = "; parts of a file are called NAME/PART (burin info lists them)";
    EXPECT_EQ(notes_of_names("objects = [\"bxo\"]", ""),
              Notes{"set a: no object fits its objects, did you mean 'box'?" + parts});
    const std::string groups = "[groups]\ng = { objects = [\"box\"] }\nm = { materials = [\"steel\"] }\n";
    EXPECT_EQ(notes_of_names("objects = [\"g\"]", "", groups),
              Notes{"set a: no object fits its objects; 'g' is a group, which is written select = \"object in g\""});
    EXPECT_EQ(
        notes_of_names("materials = [\"m\"]", "", groups),
        Notes{"set a: no material fits its materials; 'm' is a group, which is written select = \"material in m\""});
    EXPECT_EQ(notes_of_names("objects = [\"m\"]", "", groups), Notes{"set a: no object fits its objects" + parts});
}

TEST(StyledNotes, NameColoursThatAreProbablyMeantFrom0To255) {
    const auto note = [](const std::string& values, const std::string& hex) {
        return Notes{"style ink: a colour has " + values + ", beyond 1: components are from 0 to 1" + hex};
    };
    const Notes brown = note("120, 60, 30", "; for 0 to 255 write #783c1e");
    EXPECT_EQ(notes_of_names("", "color = [120, 60, 30]"), brown);
    EXPECT_EQ(notes_of_names("", "color = \"=rgb(120, 60, 30)\""), brown);
    EXPECT_EQ(notes_of_names("", "color = \"=light > 0.5 ? (facing > 0 ? #000000 : rgb(2*60, 60, 30)) : C\""), brown);
    EXPECT_EQ(notes_of_names("", "color = \"=c\"", "[parameters]\nc = [120, 60, 30]"), brown);
    EXPECT_EQ(notes_of_names("", "color = \"=c\"", "[let]\nc = \"=rgb(120, 60, 30)\""), brown);
    EXPECT_EQ(notes_of_names("", "color = { over = \"t\", stops = [[0, [0, 0, 0]], [1, [120, 60, 30]]] }"), brown);
    EXPECT_EQ(notes_of_names("", "color = '=ramp(\"r\", t)'", "[ramp.r]\nstops = [[0, [120, 60, 30]]]"), brown);
    EXPECT_EQ(notes_of_names("", "color = [1.5, 1, 0]"), note("1.5, 1, 0", ""));
    EXPECT_EQ(notes_of_names("", "color = [2, 2, 2]"), note("2, 2, 2", ""));  // rather light than nearly black
    EXPECT_EQ(notes_of_names("", "color = [1, 1, 256]"), note("1, 1, 256", ""));
    for (const char* right : {"color = [1, 1, 1]", "color = \"=rgb(1, t, 200)\"", "color = \"=rgb(120, 60, 30) / 255\"",
                              "width = \"=rgb(1, 1, 0.5).r\""})
        EXPECT_EQ(notes_of_names("", right), Notes{}) << right;
    EXPECT_EQ(notes_of_names("", "", "[style.other]\ncolor = [120, 60, 30]"), Notes{});
    EXPECT_EQ(
        notes_of_names("", "color = '=ramp(\"r\", t) * 0.2'", "[ramp.r]\nstops = [[0, [4, 4, 4]], [1, [2, 2, 2]]]"),
        Notes{});
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
