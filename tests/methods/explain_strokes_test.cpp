// What `burin explain` says of a style sheet in one pixel.

#include "methods/explain_strokes.h"

#include <gtest/gtest.h>

#include "tests/support/shaded_scene.h"

namespace burin::explain_strokes_test {
namespace {

using namespace test;

constexpr std::string_view kScene = R"(
[[object]]
shape = "box"
name = "crate"
[[camera]]
eye = [0, 0, 5]
target = [0, 0, 0]
height = 2
)";
constexpr std::string_view kSheet = R"(
[[set]]
name = "marks"
classes = ["mark"]
style = "thin"
[[set]]
name = "elsewhere"
classes = ["silhouette", "crease"]
objects = ["barrel"]
style = "thin"
[[set]]
name = "far"
classes = ["silhouette"]
select = "dihedral < 0"
style = "thin"
[[set]]
name = "outline"
classes = ["silhouette"]
style = "brush"
[style.thin]
[style.brush]
width = "=2 + 2*is_silhouette"
opacity = 0.5
color = "#ff0000"
)";

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(ExplainStrokes, TellsSetStyleOwnerSharesAndValues) {
    const ShadedScene scene(kScene, kSheet, 100, 100);
    const Frame frame = scene.frame(scene.whole());
    // The box's left side is at x = 25 px: the stroke of 4 px covers 23 to 27.
    const std::string text = text_of(explain_strokes(frame, 24, 50));
    EXPECT_TRUE(contains(text, "1 set outline (")) << text;
    EXPECT_TRUE(contains(text, "marks: class silhouette is not in its classes")) << text;
    EXPECT_TRUE(contains(text, "elsewhere: no object fits its objects")) << text;
    EXPECT_TRUE(contains(text, "far: its select is false")) << text;
    EXPECT_TRUE(contains(text, "style brush: silhouette of crate")) << text;
    EXPECT_TRUE(contains(text, "before background")) << text;
    EXPECT_TRUE(contains(text, "covers 0.5 (its opacity over 1), shows 0.5\n    width 4 px = 2 + 2*is_silhouette"))
        << text;
    EXPECT_TRUE(contains(text, "opacity 0.5\n    color #ff0000")) << text;
    EXPECT_TRUE(contains(text, "where is_silhouette 1")) << text;
    EXPECT_EQ(text_of(explain_strokes(frame, 50, 50)), "the style sheet draws nothing in this pixel\n");
}

TEST(ExplainStrokes, TakesTheNearestInk) {
    const ShadedScene scene(kScene, kSheet, 100, 100);
    const Frame frame = scene.frame(scene.whole());
    // Columns 23 to 26 have ink, and as many at the other side, 73 to 76.
    struct Click {
        int x, reach_px, found;
    };
    for (const Click& click : {Click{20, 3, 23}, {24, 3, 24}, {29, 3, 26}, {29, 64, 26}, {60, 64, 73}, {99, 64, 76}}) {
        const ExplainedPlace place = explain_strokes_near(frame, click.x, 50, click.reach_px);
        EXPECT_EQ(place.x, click.found) << click.x;
        EXPECT_EQ(place.y, 50);
        ASSERT_FALSE(place.strokes.empty());
        ExplainedPlace same = explain_strokes(frame, place.x, place.y);
        same.undrawn.clear();
        EXPECT_EQ(text_of(place), text_of(same));
        EXPECT_EQ(reasons_of(place.strokes),
                  std::vector<std::string>{"silhouette of crate: its surface turns away from the eye here, before the "
                                           "background; also of class crease"});
    }
    for (const int reach_px : {0, 1, 2}) {
        const ExplainedPlace place = explain_strokes_near(frame, 20, 50, reach_px);
        EXPECT_EQ(place.x, 20);
        EXPECT_TRUE(place.strokes.empty());
    }
}

}  // namespace
}  // namespace burin::explain_strokes_test
