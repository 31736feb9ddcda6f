// Why a pixel looks as it does: the library and the program say the same, as text and as JSON.
#include <gtest/gtest.h>

#include <string>

#include "tests/burin/shapes.h"
#include "tests/cli/program.h"

namespace burin::test::explain_test {
namespace {

const View kView{.width = 160, .height = 120};
/// A box that fills 100 x 100 pixels in the middle: its left side lies at x = 30.
constexpr const char* kScene = R"(
[camera]
eye = [0, 0, 5]
target = [0, 0, 0]
projection = "orthographic"
height = 1.2
[[material]]
name = "steel"
[[object]]
name = "bolt"
shape = "box"
material = "steel"
)";
constexpr const char* kSheet = R"(
[[set]]
name = "creases"
classes = ["crease"]
style = "ink"
[[set]]
name = "nuts"
classes = ["silhouette"]
objects = ["nut*"]
style = "ink"
[[set]]
name = "far"
classes = ["silhouette"]
select = "qi > 2"
style = "ink"
[[set]]
name = "outline"
classes = ["silhouette"]
style = "ink"
[style.ink]
width = "=depth - 1.5"
color = "#336699"
opacity = { over = "facing", stops = [[0, 0.5], [1, 0.5]] }
)";

/// What stands behind a key, up to the end of its line.
std::string behind(const std::string& json, const std::string& key) {
    const std::size_t at = json.find("\"" + key + "\": ");
    if (at == std::string::npos) return "no " + key;
    const std::size_t begin = at + key.size() + 4;
    std::string value = json.substr(begin, json.find('\n', begin) - begin);
    if (value.ends_with(',')) value.pop_back();
    return value;
}

Scene scene() {
    Scene scene;
    scene.add_text(kScene);
    scene.set_style(kSheet);
    return scene;
}

TEST(LibraryExplain, TellsSetsStylesLinesAndValues) {
    Scene from = scene();
    const std::string text = from.explain(30, 60, kView), json = from.explain(30, 60, kView, "json");
    EXPECT_EQ(text.find("1 set outline (creases: class silhouette is not in its classes; nuts: no object fits its "
                        "objects; far: its select is false), style ink: silhouette of bolt/steel before background"),
              0u)
        << text;
    EXPECT_NE(text.find("width 3 px = depth - 1.5"), std::string::npos) << text;
    for (const auto& [key, value] :
         std::vector<std::pair<std::string, std::string>>{{"reason", "\"class silhouette is not in its classes\""},
                                                          {"style", "\"ink\""},
                                                          {"class", "\"silhouette\""},
                                                          {"object", "\"bolt\""},
                                                          {"material", "\"steel\""},
                                                          {"is_behind", "true"},
                                                          {"invisibility", "0"},
                                                          {"copy", "0"},
                                                          {"linear", "["},
                                                          {"shader", "null"},
                                                          {"test", "null"},
                                                          {"depth", "4.5"}}) {
        EXPECT_EQ(behind(json, key), value) << key;
    }
    const auto after = [&](const std::string& key) { return json.substr(json.find("\"" + key + "\": {")); };
    EXPECT_EQ(behind(after("width"), "value"), "3");
    EXPECT_EQ(behind(after("width"), "source"), "\"=depth - 1.5\"");
    EXPECT_EQ(behind(after("opacity"), "value"), "0.5");
    EXPECT_EQ(behind(after("opacity"), "source"), "\"ramp over facing\"");
    EXPECT_EQ(behind(after("color"), "value"), "\"#336699\"");
    EXPECT_EQ(behind(after("color"), "source"), "null");
    // 3 px in the middle of the border of pixels 29 and 30, at opacity 1/2.
    EXPECT_NEAR(std::stod(behind(json, "covers")), 0.5, 0.01);
    EXPECT_NEAR(std::stod(behind(json, "shows")), 0.5, 0.01);
    const std::string nothing = from.explain(80, 60, kView, "json");
    EXPECT_EQ(behind(nothing, "strokes"), "[]") << nothing;
    EXPECT_EQ(from.explain(80, 60, kView), "the style sheet draws nothing in this pixel\n");
}

TEST(LibraryExplain, IsWhatTheProgramSays) {
    const TemporaryFolder folder;
    folder.write("scene.toml", kScene);
    folder.write("sheet.toml", kSheet);
    Scene from = scene();
    for (const auto& [style, pixel] : std::vector<std::pair<std::string, std::array<int, 2>>>{
             {"./sheet.toml", {30, 60}}, {"comic", {29, 60}}, {"pencil", {80, 10}}, {"technical", {130, 100}}}) {
        from.set_style(style == "./sheet.toml" ? kSheet : style);
        const auto program = [&, &s = style, &p = pixel](const char* option) {
            const ProgramResult result =
                run_burin(folder.path(), {"explain", "scene.toml", "--size", "160x120", "--style", s, "--pixel",
                                          std::to_string(p[0]) + "," + std::to_string(p[1]), option});
            EXPECT_EQ(result.status, 0) << result.err;
            return result.out;
        };
        EXPECT_EQ(program("--json"), from.explain(pixel[0], pixel[1], kView, "json"));
        const std::string text = from.explain(pixel[0], pixel[1], kView, "text", {.threads = 2});
        // What the sheet does comes before the surfaces.
        const std::string place = std::to_string(pixel[0]) + "," + std::to_string(pixel[1]);
        EXPECT_EQ(program("-v").find("pixel " + place + " of a picture of 160x120 pixels\n" + text + "\npixel " +
                                     place + " of 160x120: "),
                  0u)
            << program("-v");
    }
    const ProgramResult result =
        run_burin(folder.path(), {"explain", "scene.toml", "--size", "160x120", "--pixel", "3,3", "--json"});
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find("--json: has the strokes of a style sheet; give one with --style"), std::string::npos);
}

/// Pixels of a model are those of a picture whose size nobody has said.
TEST(LibraryExplain, SizeOfThePictureIsTold) {
    const TemporaryFolder folder;
    folder.write("scene.toml", kScene);
    folder.write("tile.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    const auto told = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "explain");
        arguments.insert(arguments.end(), {"--pixel", "9,8"});
        return run_burin(folder.path(), arguments).out;
    };
    const std::string hint = "pixel 9,8 of a picture of 1920x1080 pixels; --size WxH asks for another one\n";
    EXPECT_EQ(told({"tile.obj"}).find(hint + "pixel 9,8 of 1920x1080: "), 0u) << told({"tile.obj"});
    EXPECT_EQ(told({"tile.obj", "--style", "comic"}).find(hint), 0u);
    EXPECT_EQ(told({"tile.obj", "--size", "100x80"}).find("pixel 9,8 of 100x80: "), 0u);
    EXPECT_EQ(told({"scene.toml"}).find("pixel 9,8 of 1920x1080: "), 0u);
    Scene from = scene();
    EXPECT_NE(from.explain(9, 8, kView, "json").find("\"size\": [\n    160,\n    120\n  ]"), std::string::npos);
}

TEST(LibraryExplain, NamesShadersAndWhatTheyRead) {
    struct Wide final : LineShader {
        std::string needs() const override { return "C.g"; }
        void shade(const LineSamples&, LineInk& out) const override {
            for (float& width : out.width_px) width *= 2;
        }
    };
    struct Half final : LineTest {
        std::string needs() const override { return "gap"; }
        void test(const LineSamples&, std::span<float> strength) const override {
            std::fill(strength.begin(), strength.end(), 0.5f);
        }
    };
    Scene from = scene();
    from.add_line_shader("wide", std::make_shared<Wide>());
    from.add_line_test("half", std::make_shared<Half>());
    from.set_style(
        "[[set]]\nname = \"a\"\nclasses = [\"silhouette\"]\nstyle = \"ink\"\ntest = \"half\"\n"
        "[style.ink]\nwidth = 3\nshader = \"wide\"\n");
    const std::string json = from.explain(30, 60, kView, "json"), text = from.explain(30, 60, kView);
    EXPECT_EQ(behind(json, "shader"), "\"wide\"");
    EXPECT_EQ(behind(json, "test"), "\"half\"");
    EXPECT_EQ(behind(json.substr(json.find("\"width\"")), "value"), "6");
    EXPECT_EQ(behind(json.substr(json.find("\"opacity\"")), "value"), "0.5");
    EXPECT_EQ(behind(json, "gap"), "null");  // infinite
    EXPECT_NE(behind(json, "y"), "no y");
    EXPECT_EQ(behind(json, "x"), "no x");
    EXPECT_NE(text.find("\n    changed by shader wide\n    opacity times test half\n    where gap inf, C.y "),
              std::string::npos)
        << text;
    struct Never final : LineTest {
        void test(const LineSamples&, std::span<float> strength) const override {
            std::fill(strength.begin(), strength.end(), 0.0f);
        }
    };
    struct Gone final : LineShader {
        void shade(const LineSamples&, LineInk& out) const override {
            std::fill(out.width_px.begin(), out.width_px.end(), 0.0f);
        }
    };
    from.add_line_test("never", std::make_shared<Never>());
    from.add_line_shader("gone", std::make_shared<Gone>());
    from.set_style(
        "[[set]]\nname = \"a\"\nclasses = [\"silhouette\"]\nstyle = \"ink\"\ntest = \"never\"\n[style.ink]\n");
    EXPECT_NE(from.explain(30, 60, kView).find("test never makes its opacity 0\n"), std::string::npos);
    from.set_style(
        "[[set]]\nname = \"a\"\nclasses = [\"silhouette\"]\nstyle = \"ink\"\n[style.ink]\nshader = \"gone\"\n");
    EXPECT_NE(from.explain(30, 60, kView).find("shader gone makes its width 0\n"), std::string::npos);
}

TEST(LibraryExplain, ArgumentsAreChecked) {
    Scene from = scene();
    std::string error;
    for (const auto& [x, y] : std::vector<std::pair<int, int>>{{-1, 0}, {160, 0}, {0, 120}, {0, -1}})
        EXPECT_EQ(failure_of([&, &px = x, &py = y] { from.explain(px, py, kView); }), BURIN_BAD_ARGUMENT);
    View crop = kView;
    crop.crop = {20, 50, 40, 70};
    EXPECT_EQ(failure_of([&] { from.explain(40, 60, crop); }), BURIN_BAD_ARGUMENT);
    EXPECT_EQ(from.explain(30, 60, crop).substr(0, 13), "1 set outline");
    EXPECT_EQ(failure_of([&] { from.explain(1, 1, kView, "xml"); }, &error), BURIN_BAD_ARGUMENT);
    EXPECT_EQ(error, "format: must be \"text\" or \"json\", not 'xml'");
    from.set_style("");
    EXPECT_EQ(failure_of([&] { from.explain(1, 1, kView); }, &error), BURIN_BAD_ARGUMENT);
    EXPECT_EQ(error, "the scene has no style sheet; burin_set_style() gives it one");
}

}  // namespace
}  // namespace burin::test::explain_test
