// Style sheets through the interface: pictures are the program's, and lines that were found once are drawn by any sheet
// that needs no more than was found.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/burin/shapes.h"
#include "tests/cli/program.h"

namespace burin::test::style_test {
namespace {

const std::string kScenes = std::string(BURIN_SOURCE_FOLDER) + "/scenes/";
constexpr View kView{.width = 160, .height = 120};

/// One set of creases and outlines; `more` are keys of its style.
std::string sheet(const std::string& more, const std::string& top = {}) {
    return "style_version = 1\n" + top +
           "[[set]]\nname = \"all\"\nclasses = [\"silhouette\", \"border\", \"crease\"]\nstyle = \"ink\"\n"
           "[style.ink]\n" +
           more + "\n";
}

/// A glass cube before waves, so that much is hidden.
Scene scene() {
    Scene scene;
    const int glass = scene.add(Material{.name = "glass", .color = {0, 0.5f, 0}, .opacity = 0.25f});
    const int mesh = scene.add_mesh(cube().mesh());
    scene.add(waves(12).mesh("waves"));
    scene.add_object(mesh, "solid", {0.3, 0, 0, 0.3, 0, 0.3, 0, -0.1, 0, 0, 0.3, 0.3, 0, 0, 0, 1});
    scene.add_object(mesh, "glass", {0.4, 0, 0, 0.2, 0, 0.4, 0, 0, 0, 0, 0.4, 1.2, 0, 0, 0, 1}, glass);
    return scene;
}

std::vector<std::byte> exr(Scene& scene, const View& view = kView) { return scene.render(view).encode("exr"); }

TEST(LibraryStyle, PicturesAreTheProgramsByNameByFileAndByText) {
    const TemporaryFolder folder;
    const std::string text = sheet("width = \"=3 * t + 1\"");
    folder.write("mine.toml", text);
    const auto of_program = [&](const std::string& style) {
        const ProgramResult result = run_burin(folder.path(), {"render", kScenes + "cube.toml", "--size", "160x120",
                                                               "-q", "--style", style, "-o", "program.exr"});
        EXPECT_EQ(result.status, 0) << result.err;
        return read_file(folder.file("program.exr"));
    };
    for (const char* const name : {"technical", "comic", "pencil"}) {
        Scene scene = Scene::load(kScenes + "cube.toml");
        scene.set_style(name);
        EXPECT_TRUE(exr_of(scene, kView) == of_program(name)) << name;
    }
    Scene scene = Scene::load(kScenes + "cube.toml");
    const std::string plain = exr_of(scene, kView);
    scene.set_style(text);
    const std::string by_text = exr_of(scene, kView);
    EXPECT_FALSE(by_text == plain);
    EXPECT_TRUE(by_text == of_program("mine.toml"));
    scene.set_style(folder.file("mine.toml"));
    EXPECT_TRUE(exr_of(scene, kView) == by_text);
    folder.write("mine.toml", "no sheet any more");
    scene.set("picture.dpi=96");  // files are not read again
    EXPECT_TRUE(exr_of(scene, kView) == by_text);
    scene.set_style("");
    EXPECT_TRUE(exr_of(scene, kView) == plain);
}

TEST(LibraryStyle, ADrawingIsTheRenderedPictureOfTheSameStyle) {
    for (const char* const name : {"technical", "comic", "pencil", "architect", "patent"}) {
        Scene from = scene();
        from.set_style(name);
        const std::vector<std::byte> rendered = exr(from);
        const Drawing drawing = from.find_lines(kView);
        from.clear();
        from = Scene();
        EXPECT_TRUE(drawing.draw().encode("exr") == rendered) << name;
        EXPECT_TRUE(drawing.draw(1).encode("exr") == rendered) << name << ", again";
        EXPECT_TRUE(drawing.draw(name).encode("exr") == rendered) << name << ", by its name";
        EXPECT_TRUE(drawing.encode("exr", name) == rendered) << name;
        EXPECT_GT(drawing.piece_count(), 20u) << name;
    }
}

/// Lines as they are found depend on what is looked for by a little, so these need chains, too.
TEST(LibraryStyle, ADrawingTakesSheetsThatNeedNoMore) {
    const std::string first = sheet("width = \"=1 + facing\"\ndash = [6, 4]");
    for (const std::string& second :
         {sheet("width = 3\ncolor = \"#ff0000\"\ntaper = { start = 9 }"),
          sheet("width = \"=2 * facing2\"\ncaps = \"butt\""), sheet("opacity = \"=light * t\"", "light = [1, 0, 0]\n"),
          sheet("dash = [5, 5]", "filter = \"mitchell\"\n")}) {
        Scene from = scene();
        from.set_style(second);
        const std::vector<std::byte> rendered = exr(from);
        from.set_style(first);
        EXPECT_FALSE(exr(from) == rendered) << second;
        EXPECT_TRUE(from.find_lines(kView).draw(second).encode("exr") == rendered) << second;
    }
}

TEST(LibraryStyle, ADrawingSaysWhatASheetNeedsThatItHasNot) {
    Scene from = scene();
    const Drawing without = from.find_lines(kView);
    from.set_style(sheet("width = 2"));
    const Drawing drawing = from.find_lines(kView);
    std::string hidden = sheet("width = 2"), more_classes = hidden;
    hidden.replace(hidden.find("style = \"ink\""), 0, "qi = [0, 255]\n");
    more_classes.replace(more_classes.find("\"border\""), 0, "\"polygon\", \"mark\", ");
    for (const auto& [style, words] : std::vector<std::pair<std::string, std::string>>{
             {more_classes, "lines of class mark,polygon"},
             {hidden, "hidden lines"},
             {sheet("width = \"=facing\""), "normals"},
             {sheet("width = \"=gap_px\""), "the surfaces behind lines"},
             {sheet("dash = [3, 3]"), "chains"},
             {sheet("width = 1", "crease_angle = 12\n"), "another crease_angle"},
             {sheet("width = 1", "contours = \"smooth\"\n"), "other contours"}}) {
        std::string error;
        EXPECT_EQ(failure_of([&, &s = style] { drawing.draw(s); }, &error), BURIN_BAD_ARGUMENT) << style;
        EXPECT_NE(error.find(words), std::string::npos) << error;
        EXPECT_NE(error.find("burin_set_style() before burin_find_lines()"), std::string::npos) << error;
        from.set_style(style);
        EXPECT_TRUE(from.find_lines(kView).draw(style).encode("exr") == exr(from)) << style;
        from.set_style(sheet("width = 2"));
    }
    std::string error;
    EXPECT_EQ(failure_of([&] { without.draw("comic"); }, &error), BURIN_BAD_ARGUMENT);
    EXPECT_NE(error.find("found without a style sheet"), std::string::npos) << error;
}

TEST(LibraryStyle, ErrorsNameThePlaceAndChangeNothing) {
    Scene from = scene();
    from.set_style(sheet("width = 2"));
    const std::vector<std::byte> before = exr(from);
    std::string error;
    EXPECT_EQ(failure_of([&] { from.set_style(sheet("widht = 2")); }, &error), BURIN_BAD_INPUT);
    EXPECT_EQ(error.find("style:7:1: [style.ink]: unknown key 'widht'; did you mean 'width'?"), 0u) << error;
    EXPECT_EQ(failure_of([&] { from.set_style("comik"); }, &error), BURIN_BAD_ARGUMENT);
    EXPECT_NE(error.find("there is no style sheet 'comik', did you mean 'comic'?"), std::string::npos) << error;
    EXPECT_EQ(failure_of([&] { from.set_style("none.toml"); }, &error), BURIN_BAD_INPUT);
    EXPECT_NE(error.find("none.toml"), std::string::npos) << error;
    EXPECT_EQ(failure_of([&] { from.set("style.ikn.width=3"); }, &error), BURIN_BAD_ARGUMENT);
    EXPECT_TRUE(exr(from) == before);
    // What is wrong with an expression is seen when a picture is made.
    from.set_style(sheet("width = \"=depht\""));
    EXPECT_EQ(failure_of([&] { exr(from); }, &error), BURIN_BAD_INPUT);
    EXPECT_EQ(error.find("style:7:11: [style.ink] width: unknown variable 'depht'"), 0u) << error;
    const Drawing drawing = (from.set_style(sheet("width = 2")), from.find_lines(kView));
    EXPECT_EQ(failure_of([&] { drawing.draw(sheet("width = \"=depht\"")); }, &error), BURIN_BAD_INPUT);
    EXPECT_EQ(error.find("style:7:11: "), 0u) << error;
    EXPECT_EQ(failure_of([&] { drawing.draw("comik"); }, &error), BURIN_BAD_ARGUMENT);
}

TEST(LibraryStyle, ValuesAreSettings) {
    Scene from = scene();
    from.set_style(sheet("width = \"=wide\"", "[parameters]\nwide = 2\n"));
    const std::vector<std::byte> two = exr(from);
    from.set("style.wide=3");
    const std::vector<std::byte> three = exr(from);
    EXPECT_FALSE(two == three);
    from.set("style.ink.width=2");
    EXPECT_TRUE(exr(from) == two);
    from.set_style(sheet("width = \"=wide\"", "[parameters]\nwide = 3\n"));  // without the changes of the one before
    EXPECT_TRUE(exr(from) == three);
}

TEST(LibraryStyle, AViewHasAFrame) {
    Scene from = scene();
    from.set_style(sheet("width = \"=frame + 2 * time\""));
    from.set("frames.fps=2");
    const auto of_frame = [&](int frame) { return exr(from, {.width = 160, .height = 120, .frame = frame}); };
    const std::vector<std::byte> third = of_frame(3);
    EXPECT_FALSE(third == of_frame(2));
    EXPECT_TRUE(of_frame(0) == exr(from));
    EXPECT_TRUE(from.find_lines({.width = 160, .height = 120, .frame = 3}).draw().encode("exr") == third);
    from.set_style(sheet("width = 6"));  // 3 + 2 * 3 / 2
    EXPECT_TRUE(exr(from) == third);
    EXPECT_EQ(failure_of([&] { of_frame(1000000001); }), BURIN_BAD_ARGUMENT);
}

TEST(LibraryStyle, SetsHaveLayersOfTheirOwn) {
    std::string text = sheet("width = 2");
    text.replace(text.find("style = \"ink\""), 0, "layer = \"edges\"\n");
    Scene from = scene();
    from.set_style(text);
    const Picture picture = from.render(kView);
    const auto own = picture.channel<std::uint16_t>("lines_edges.A"), all = picture.channel<std::uint16_t>("lines.A");
    EXPECT_TRUE(std::equal(own.begin(), own.end(), all.begin(), all.end()));  // the only set
    EXPECT_TRUE(std::any_of(own.begin(), own.end(), [](std::uint16_t bits) { return bits != 0; }));
    EXPECT_TRUE(from.find_lines(kView).draw().encode("exr") == exr(from));
    EXPECT_EQ(from.render(kView, {.layers = "Z,lines_edges"}).channel_names().size(), 5u);
    std::string error;
    EXPECT_EQ(failure_of([&] { from.render(kView, {.layers = "lines_none"}); }, &error), BURIN_BAD_ARGUMENT);
    EXPECT_EQ(error, "options.layers: unknown layer 'lines_none'; sets of the style sheet have lines_edges");
    from.set_style("");
    EXPECT_EQ(failure_of([&] { from.render(kView, {.layers = "lines_edges"}); }, &error), BURIN_BAD_ARGUMENT);
}

TEST(LibraryStyle, DrawingsAreWrittenAsPaths) {
    const TemporaryFolder folder;
    Scene scene = Scene::load(kScenes + "cube.toml");
    scene.set_style("pencil");
    const Drawing drawing = scene.find_lines(kView);
    for (const std::string format : {"svg", "pdf", "dxf"}) {
        const ProgramResult result =
            run_burin(folder.path(), {"render", kScenes + "cube.toml", "--size", "160x120", "-q", "--style", "pencil",
                                      "--set", "surfaces.shading=paper", "-o", "program." + format});
        EXPECT_EQ(result.status, 0) << result.err;
        const std::vector<std::byte> file = drawing.encode(format.c_str());
        EXPECT_TRUE(std::string(reinterpret_cast<const char*>(file.data()), file.size()) ==
                    read_file(folder.file("program." + format)))
            << format;
    }
    EXPECT_THROW(scene.render(kView).encode("svg"), Error);
}

TEST(LibraryStyle, FilesHaveTheNotesOfTheProgram) {
    const TemporaryFolder folder;
    folder.write("fades.toml",
                 "[style.a]\ncolor = \"=mix(#ff0000, #0000ff, x / 160)\"\nopacity = 0.5\n[[set]]\nname = \"s\"\n"
                 "classes = [\"silhouette\", \"crease\"]\nstyle = \"a\"\n");
    Scene scene = Scene::load(kScenes + "cube.toml");
    scene.set_style(folder.file("fades.toml"));
    const Drawing drawing = scene.find_lines(kView, {.for_paths = true}), unnamed = scene.find_lines(kView);
    for (const std::string format : {"svg", "dxf", "png"}) {
        const ProgramResult result = run_burin(folder.path(), {"render", kScenes + "cube.toml", "--size", "160x120",
                                                               "--style", "fades.toml", "-o", "program." + format});
        const std::vector<std::byte> file = drawing.encode(format);
        EXPECT_TRUE(std::string(reinterpret_cast<const char*>(file.data()), file.size()) ==
                        read_file(folder.file("program." + format)) ||
                    format == "png");  // to the bit where lines are found for paths, too
        std::string told;
        for (const std::string& note : file_notes()) told += "burin: note: " + note + "\n";
        EXPECT_EQ(result.err, told) << format;
        EXPECT_EQ(told.empty(), format == "png");
        EXPECT_THROW(drawing.encode("jpg"), Error);  // leaves them
        EXPECT_EQ(file_notes().empty(), format == "png");
        EXPECT_EQ(burin_file_note(-1), nullptr);
    }
    // This sheet asks for no chains, so edges are not told apart.
    const std::vector<std::byte> svg = unnamed.encode("svg");
    const std::string text(reinterpret_cast<const char*>(svg.data()), svg.size());
    EXPECT_EQ(text.find("data-edge"), std::string::npos);
    EXPECT_NE(text.find("<path"), std::string::npos);
}

}  // namespace
}  // namespace burin::test::style_test
