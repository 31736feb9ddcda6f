// Looks and views of a page become scenes and command lines.

#include "web/viewed_tables.h"

#include <gtest/gtest.h>

#include <string>

#include "base/error.h"
#include "scene/sheet_toml.h"
#include "tests/support/temporary_folder.h"
#include "web/command_text.h"
#include "web/sheet_values.h"

namespace burin::test::viewed_tables_test {
namespace {

View some_view() {
    View view;
    view.width = 400;
    view.height = 300;
    view.eye = {1.25, -3e-7, 0.1};
    view.target = {1e6, 2, 1.0 / 3};
    view.up = {0, 0, 1};
    return view;
}

SceneDescription read_back(const TemporaryFolder& folder, const std::string& text) {
    folder.write("back.toml", text);
    return read_scene_file(folder.file("back.toml"), {});
}

TEST(ViewedTables, NumbersComeBackToTheBit) {
    const TemporaryFolder folder;
    folder.write(
        "a.toml",
        "[[object]]\nfile = \"models/a.obj\"\n[[camera]]\nshift = [0.1, 0.2]\nlens_radius = 2\n"
        "[shutter]\n[turntable]\nframes = 10\n[picture]\npaper = \"A4\"\nscale = \"1:3\"\nbackground = \"#204060\"\n");
    const ViewedTables tables({folder.file("a.toml"), "", {}});
    const SceneDescription back = read_back(folder, tables.scene_text(tables.first_look(), some_view()));
    ASSERT_EQ(back.cameras.size(), 1u);
    EXPECT_EQ(back.cameras[0].eye, some_view().eye);
    EXPECT_EQ(back.cameras[0].target, some_view().target);
    EXPECT_EQ(back.cameras[0].shift, glm::dvec2(0.1, 0.2));
    EXPECT_EQ(back.cameras[0].lens_radius, 0);
    EXPECT_FALSE(back.shutter);
    EXPECT_FALSE(back.turntable);
    EXPECT_EQ(back.picture.width, 400);
    EXPECT_EQ(back.picture.dpi, tables.described(tables.first_look()).picture.dpi);
    EXPECT_GT(back.picture.dpi, 100);  // that of the paper
    EXPECT_EQ(back.objects[0].file, folder.file("models/a.obj"));
    EXPECT_FALSE(tables.command(tables.first_look(), some_view()));  // paper, shutter and lens are no view's
}

TEST(ViewedTables, OnlyWhatChangesIsWritten) {
    const TemporaryFolder folder;
    folder.write(
        "a.toml",
        "[[object]]\nshape = \"box\"\n[lines]\ncrease_angle = [30, 50]\n[lines.hidden]\ncolor = \"#ff0000\"\n");
    const ViewedTables tables({folder.file("a.toml"), "", {}});
    Look look = tables.first_look();
    look.hidden = HiddenStyle::solid;
    const SceneDescription changed = tables.described(look);
    EXPECT_EQ(changed.lines.crease_fade_deg, 20);
    EXPECT_EQ(changed.lines.style.hidden.style, HiddenStyle::solid);
    EXPECT_EQ(changed.lines.style.hidden.color, glm::vec3(1, 0, 0));
    look.crease_angle_deg = 12;
    look.classes = {};
    EXPECT_EQ(tables.described(look).lines.crease_fade_deg, 0);
    EXPECT_TRUE(tables.described(look).lines.classes.empty());
    EXPECT_EQ(tables.command(look, some_view()).value_or(""),
              "burin render " + folder.file("a.toml") +
                  " --eye=1.25,-3e-07,0.1 --target=1e+06,2,0.3333333333333333 --up=0,0,1 --fov=35 --size=400x300"
                  " --crease-angle=12 --lines=none --hidden=solid -o a.png");
}

TEST(ViewedTables, SheetsOfTheSceneCanBeLeft) {
    const TemporaryFolder folder;
    folder.write("mine.toml",
                 "style_version = 1\n[parameters]\nw = { value = 2, min = 0, max = 9 }  # wide\n"
                 "[[set]]\nname = \"a\"\nclasses = [\"crease\"]\nstyle = \"s\"\n[style.s]\nwidth = \"=w\"\n");
    folder.write("a.toml", "style = \"mine.toml\"\n[[object]]\nshape = \"box\"\n");
    const ViewedTables tables({folder.file("a.toml"), "", {}});
    Look look = tables.first_look();
    EXPECT_EQ(look.style, "mine.toml");
    EXPECT_EQ(read_back(folder, tables.scene_text(look, some_view())).sheet->file, folder.file("mine.toml"));
    look.parameters = {{"w", "7.5"}};
    const std::string text = tables.scene_text(look, some_view());
    EXPECT_NE(text.find("w = { value = 7.5, min = 0, max = 9 }  # wide"), std::string::npos) << text;
    EXPECT_EQ(read_back(folder, text).sheet->parameters[0].value.number, 7.5);
    EXPECT_EQ(tables.described(look).sheet->parameters[0].value.number, 7.5);
    look.style.clear();
    EXPECT_EQ(read_back(folder, tables.scene_text(look, some_view())).sheet, nullptr);
    EXPECT_FALSE(tables.command(look, some_view()));
    look.parameters.clear();
    look.sheet = "style_version = 1\n";
    EXPECT_THROW(tables.described(look), InputError);
}

TEST(SheetValues, ChangeNothingElse) {
    const std::string sheet =
        "style_version = 1\n# größe: ähnlich\n[parameters]\nwidth = 3  # ünits\nink = \"#ff0000\"\nlong = { min = 0, "
        "value = 1e2 }\n"
        "[[set]]\nname = \"a\"\nclasses = [\"crease\"]\nstyle = \"s\"\n[style.s]\nwidth = \"=width * long\"\ncolor = "
        "\"=ink\"\n";
    std::string wanted = sheet;
    wanted.replace(wanted.find("width = 3"), 9, "width = 12");
    EXPECT_EQ(sheet_with_values(sheet, {{"width", "12"}}), wanted);
    const std::string colored = sheet_with_values(sheet, {{"ink", "#0000ff"}, {"long", "0.25"}});
    EXPECT_NE(colored.find("# größe: ähnlich"), std::string::npos);
    EXPECT_NE(colored.find("#0000ff"), std::string::npos);
    EXPECT_NE(colored.find("value = 0.25"), std::string::npos);
    // What is no parameter changes, too, if not in its place.
    const std::string other = sheet_with_values(sheet, {{"s.width", "4"}});
    EXPECT_EQ(read_sheet_text(other, "s").styles[0].width.number, 4);
}

TEST(SheetValues, TextsComeBackFromToml) {
    for (const char* const text : {"a\nb\n", "it''' is\n", "tab\tand \x01\n", "\n", "'''''\n", "\"\"\"\\u0041\n"}) {
        const TemporaryFolder folder;
        folder.write("a.toml", text_in_toml("style", text) + "[[object]]\nshape = \"box\"\n");
        try {
            read_scene_file(folder.file("a.toml"), {});
        } catch (const InputError& error) {  // none of them is a sheet; but all were read as texts
            EXPECT_NE(std::string(error.what()).find(": style"), std::string::npos) << error.what();
        }
    }
}

TEST(CommandText, IsSafeInAShell) {
    EXPECT_EQ(in_shell("a-b_c.obj"), "a-b_c.obj");
    EXPECT_EQ(in_shell("it's $(rm) here"), "'it'\\''s $(rm) here'");
    EXPECT_EQ(in_shell(""), "''");
    CommandText command;
    command.add("-model.obj");
    EXPECT_EQ(command.text(), "burin render ./-model.obj");
}

}  // namespace
}  // namespace burin::test::viewed_tables_test
