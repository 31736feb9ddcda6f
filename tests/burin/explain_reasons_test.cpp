// Why ink is not as a style sheet says: halos, tapers, lines that leave none in a pixel.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "image/half.h"
#include "tests/burin/shapes.h"

namespace burin::test::explain_reasons_test {
namespace {

using Json = nlohmann::json;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Scene styled(const std::string& scene, const std::string& sheet) {
    Scene made;
    made.add_text(scene);
    made.set_style(sheet);
    return made;
}

/// A bar in front of two that stand behind it, and halos of the front one.
constexpr const char* kBars = R"(
[camera]
eye = [0, 0, 10]
target = [0, 0, 0]
fov = 30
[[object]]
name = "front"
shape = "box"
scale = [4, 0.8, 0.2]
translate = [0, 0, 2]
[[object]]
name = "left"
shape = "box"
scale = [0.15, 5, 0.1]
translate = [-1.2, 0, -2]
[[object]]
name = "right"
shape = "box"
scale = [0.15, 5, 0.1]
translate = [0.6, 0, -2]
)";
const std::string kHalos = R"(
[[set]]
name = "near"
classes = ["silhouette", "border"]
objects = ["front"]
style = "near"
[[set]]
name = "far"
classes = ["silhouette", "border", "crease"]
style = "far"
[style.near]
width = 3
color = "#c00000"
dash = [40, 40]
halo = 14
[style.far]
width = 3
)";
const View kBarsView{.width = 600, .height = 300};

TEST(ExplainReasons, HalosTakeWhatStrokesShow) {
    Scene with = styled(kBars, kHalos),
          without = styled(kBars, std::string(kHalos).replace(kHalos.find("halo = 14"), 9, "halo = 0"));
    // The left side of the left bar, 8 px above the front one.
    const std::string text = with.explain(248, 114, kBarsView);
    EXPECT_TRUE(contains(text, "covers 1, shows 0, 1 erased by the halo of set near: silhouette of front, chain "))
        << text;
    const Json erased = Json::parse(with.explain(248, 114, kBarsView, "json"))["strokes"][0],
               plain = Json::parse(without.explain(248, 114, kBarsView, "json"))["strokes"][0];
    EXPECT_EQ(erased["covers"], 1);
    EXPECT_EQ(erased["shows"], 0);
    EXPECT_EQ(erased["erased"], 1);
    ASSERT_EQ(erased["erased_by"].size(), 1u);
    EXPECT_EQ(erased["erased_by"][0]["set"], "near");
    EXPECT_EQ(erased["erased_by"][0]["class"], "silhouette");
    EXPECT_EQ(erased["erased_by"][0]["front"]["object"], "front");
    EXPECT_EQ(plain["shows"], 1);
    EXPECT_EQ(plain["erased"], 0);
    EXPECT_EQ(plain["erased_by"], Json::array());
}

/// What strokes show is what a picture has of them.
TEST(ExplainReasons, WhatShowsIsInThePicture) {
    Scene scene = styled(kBars, kHalos);
    const Picture picture = scene.render(kBarsView, {.layers = "lines"});
    const std::span<const std::uint16_t> halves = picture.channel<std::uint16_t>("lines.A");
    int erased = 0, partly = 0;
    for (int y = 90; y < 124; ++y) {
        for (int x = 244; x < 252; x += 2) {
            double shows = 0;
            const Json strokes = Json::parse(scene.explain(x, y, kBarsView, "json"))["strokes"];
            for (const Json& stroke : strokes) {
                shows += stroke["shows"].get<double>();
                if (stroke["erased"] > 0) ++erased;
                if (stroke["erased"] > 0 && stroke["erased"] < stroke["covers"]) ++partly;
            }
            EXPECT_NEAR(shows,
                        static_cast<double>(
                            float_from_half(halves[static_cast<std::size_t>(y) * 600 + static_cast<std::size_t>(x)])),
                        2e-3)
                << x << "," << y;
        }
    }
    EXPECT_GT(erased, 20);
    EXPECT_GT(partly, 0);
}

/// Lines that bend have parts that are near a pixel by their halo alone, beside those that have ink there.
TEST(ExplainReasons, WhatShowsIsInThePictureWhereLinesBend) {
    const View view{.width = 120, .height = 90};
    Scene scene = styled(
        "[camera]\neye = [3, 2.5, 5]\nfov = 30\n"
        "[[object]]\nname = \"ring\"\nshape = \"torus\"\nrotate = [50, 0, 20]\n"
        "[[object]]\nname = \"pin\"\nshape = \"cylinder\"\nradius = 0.4\nheight = 2.5\n",
        "[[set]]\nname = \"all\"\nclasses = [\"silhouette\", \"crease\", \"intersection\"]\n"
        "style = \"ink\"\n[style.ink]\nwidth = 2\nhalo = 4\n");
    const Picture picture = scene.render(view, {.layers = "lines"});
    const std::span<const std::uint16_t> halves = picture.channel<std::uint16_t>("lines.A");
    int inked = 0;
    for (std::size_t i = 0; i < halves.size(); i += 7) {
        const double alpha = static_cast<double>(float_from_half(halves[i]));
        if (alpha < 0.05) continue;
        const int x = static_cast<int>(i % 120), y = static_cast<int>(i / 120);
        double shows = 0;
        const Json strokes = Json::parse(scene.explain(x, y, view, "json"))["strokes"];
        for (const Json& stroke : strokes) shows += stroke["shows"].get<double>();
        EXPECT_NEAR(shows, alpha, 0.01) << x << "," << y;
        ++inked;
    }
    EXPECT_GT(inked, 40);
}

/// A box that fills 100 x 100 pixels in the middle: its left side lies at x = 30.
const std::string kBox = R"(
[camera]
eye = [0, 0, 5]
target = [0, 0, 0]
projection = "orthographic"
height = 1.2
[[object]]
name = "bolt"
shape = "box"
)";
const View kView{.width = 160, .height = 120};

std::string sheet_of(const std::string& set, const std::string& style) {
    return "[[set]]\nname = \"a\"\nclasses = [\"silhouette\"]\nstyle = \"ink\"\n" + set + "\n[style.ink]\n" + style;
}

/// The rim of a plate is one line, with the plate on its right where it is an outline.
TEST(ExplainReasons, OffsetsAreThoseOfTheSheet) {
    const View view{.width = 120, .height = 90};
    Scene scene = styled(
        "[camera]\neye = [3, 2.5, 6]\nfov = 30\n[[object]]\nname = \"plate\"\n"
        "shape = \"cylinder\"\nradius = 2\nheight = 0.15\n",
        "[[set]]\nname = \"shore\"\nclasses = [\"silhouette\"]\nstyle = \"shore\"\n"
        "[[set]]\nname = \"edges\"\nclasses = [\"crease\"]\nstyle = \"edge\"\n"
        "[style.shore]\nwidth = 1\noffset = 4\n[style.edge]\nwidth = 0\n");
    const Picture picture = scene.render(view, {.layers = "lines"});
    const std::span<const std::uint16_t> halves = picture.channel<std::uint16_t>("lines.A");
    int told = 0;
    for (std::size_t i = 0; i < halves.size(); i += 3) {
        if (static_cast<double>(float_from_half(halves[i])) < 0.3) continue;
        const int x = static_cast<int>(i % 120), y = static_cast<int>(i / 120);
        const Json strokes = Json::parse(scene.explain(x, y, view, "json"))["strokes"];
        for (const Json& stroke : strokes) {
            EXPECT_EQ(stroke["offset"]["value"], 4) << x << "," << y;
            ++told;
        }
    }
    EXPECT_GT(told, 30);
}

TEST(ExplainReasons, LinesWithoutInkHaveAReason) {
    struct Case {
        std::string set, style, reason;
        bool is_taken = true;
    };
    for (const Case& c :
         std::vector<Case>{{"select = \"dihedral < 0\"", "", "no set takes it (a: its select is false)", false},
                           {"objects = [\"nut\"]", "", "no set takes it (a: no object fits its objects)", false},
                           {"qi = [3, 4]", "", "no set takes it (a: qi 0 is not in its range)", false},
                           {"", "width = 0", "its width is 0 there"},
                           {"", "width = \"=0 * t\"", "its width is 0 there"},
                           {"", "opacity = 0", "its opacity is 0 there"},
                           {"", "min_length = 500", "its run of 200 px is too short for min_length 500"},
                           {"", "width = 2\noffset = 12", "it is moved aside by 12 px"},
                           {"", "width = 8\nside = \"inside\"", "side = \"inside\" has it on its other side only"},
                           {"", "width = 0.5\noffset = 1.5", "its ink is 0.5 px wide and ends "}}) {
        Scene scene = styled(kBox, sheet_of(c.set, c.style));
        const std::string text = scene.explain(29, 60, kView);
        const std::string line = "near it, but with no ink in it:\n    silhouette of bolt before background" +
                                 std::string(c.is_taken ? ", set a, style ink" : "") + ": " + c.reason;
        EXPECT_EQ(text.find("the style sheet draws nothing in this pixel\n" + line), 0u) << text;
        const Json json = Json::parse(scene.explain(29, 60, kView, "json"));
        EXPECT_EQ(json["strokes"], Json::array());
        ASSERT_FALSE(json["not_drawn"].empty());
        const Json& first = json["not_drawn"][0];
        EXPECT_EQ(first["reason"].get<std::string>().find(c.reason), 0u) << first;
        EXPECT_EQ(first["class"], "silhouette");
        EXPECT_EQ(first["front"]["object"], "bolt");
        EXPECT_EQ(first["set"], c.is_taken ? Json("a") : Json());
        EXPECT_EQ(first["style"], c.is_taken ? Json("ink") : Json());
        EXPECT_EQ(first["refused_by"].size(), c.is_taken ? 0u : 1u);
        EXPECT_NEAR(first["distance"].get<double>(), 0.5, 0.01);
    }
}

TEST(ExplainReasons, LinesOfClassesThatNoSetAsksForAreFound) {
    Scene scene = styled(kBox, "[[set]]\nname = \"a\"\nclasses = [\"mark\"]\nstyle = \"ink\"\n[style.ink]\n");
    const std::string nothing = "the style sheet draws nothing in this pixel\nnear it, but with no ink in it:\n";
    EXPECT_EQ(scene.explain(29, 60, kView)
                  .find(nothing + "    silhouette of bolt before background: no set asks for class silhouette\n"),
              0u)
        << scene.explain(29, 60, kView);
    scene.set_style(sheet_of("enabled = false\n[[set]]\nname = \"b\"\nclasses = [\"mark\"]\nstyle = \"ink\"\n", ""));
    EXPECT_TRUE(
        contains(scene.explain(29, 60, kView), "no set asks for class silhouette, but set a, which is not enabled\n"));
    // A line that is behind more than any set asks for.
    Scene behind = styled(kBars, kHalos);
    EXPECT_TRUE(contains(behind.explain(248, 150, kBarsView),
                         "silhouette of left, behind 2: no set takes it (near: qi 2 is not in its "
                         "range; far: qi 2 is not in its range)\n"))
        << behind.explain(248, 150, kBarsView);
    // Edges that turn by too little to be creases; hidden ones are not worth a word.
    behind.set_style(
        "crease_angle = 120\n[[set]]\nname = \"a\"\nclasses = [\"crease\"]\nstyle = \"ink\"\n[style.ink]\n");
    EXPECT_TRUE(contains(behind.explain(248, 114, kBarsView),
                         "    polygon of left: no set asks for class polygon; creases begin at 120°, and its polygons "
                         "turn by 90°\n"))
        << behind.explain(248, 114, kBarsView);
    const std::string hidden = behind.explain(248, 150, kBarsView);
    EXPECT_TRUE(contains(hidden, "in it:\n    2 lines behind surfaces, which the JSON has\n")) << hidden;
    EXPECT_EQ(Json::parse(behind.explain(248, 150, kBarsView, "json"))["not_drawn"].size(), 2u);
    // In the middle of a face there is none.
    EXPECT_EQ(scene.explain(80, 60, kView), "the style sheet draws nothing in this pixel\n");
}

TEST(ExplainReasons, GapsOfDashesAreTold) {
    Scene scene = styled(kBox, sheet_of("", "width = 3\ncaps = \"butt\"\ndash = [6, 14]"));
    int gaps = 0, dashes = 0;
    for (int y = 20; y < 60; ++y) {
        const Json json = Json::parse(scene.explain(29, y, kView, "json"));
        if (!json["strokes"].empty()) {
            ++dashes;
            for (const Json& line : json["not_drawn"]) EXPECT_NE(line["set"], "a") << y;
            continue;
        }
        ++gaps;
        EXPECT_EQ(json["not_drawn"][0]["reason"], "the pixel is in a gap of its dashes") << y;
    }
    EXPECT_GE(gaps, 24);
    EXPECT_GE(dashes, 10);
}

TEST(ExplainReasons, ValuesNameTheirFactorsAndWhatIsInThem) {
    const std::string plate = kBox +
                              "[[object]]\nname = \"plate\"\nshape = \"box\"\nscale = [2, 0.5, 0.1]\n"
                              "translate = [0, -0.25, 1]\n";
    const auto sheet = [](const std::string& width) {
        return "[parameters]\nbroad = 2\nneon = \"#ff00aa\"\nunused = 7\n[let]\ntwice = \"=2 * broad\"\n" +
               sheet_of("objects = [\"bolt\"]",
                        "width = " + width +
                            "\ncolor = \"=neon\"\nopacity = 0.5\ntaper = { start = 40, end = 40, shape = \"linear\", "
                            "at = \"all\" }");
    };
    Scene scene = styled(plate, sheet("\"=twice + broad\""));
    // The side of the box is seen from y = 10 to y = 60, behind the plate below that.
    const std::string text = scene.explain(29, 29, kView);
    EXPECT_TRUE(contains(text, "\n    width 4.575 px = twice + broad, taper 0.7625\n    opacity 0.5\n")) << text;
    EXPECT_TRUE(contains(text, "\n    where twice 4, broad 2, neon #ff00aa\n")) << text;
    EXPECT_TRUE(contains(text, "covers 0.5 (its opacity over 1), shows 0.5\n")) << text;
    const Json stroke = Json::parse(scene.explain(29, 29, kView, "json"))["strokes"][0];
    EXPECT_NEAR(stroke["width"]["taper"].get<double>(), 0.7625, 1e-4);
    EXPECT_EQ(stroke["names"], Json({{"twice", 4}, {"broad", 2}, {"neon", "#ff00aa"}}));
    EXPECT_EQ(stroke["area"], 1);
    EXPECT_EQ(stroke["covers"], 0.5);
    scene.set_style(sheet("6"));
    EXPECT_TRUE(contains(scene.explain(29, 29, kView), "\n    width 4.575 px = 6, taper 0.7625\n"));
    scene.set_style(sheet("6\nmin_length = [0, 1000]"));
    const std::string faded = scene.explain(29, 29, kView);
    EXPECT_TRUE(contains(faded, " = 0.5, min_length 0.")) << faded;
}

}  // namespace
}  // namespace burin::test::explain_reasons_test
