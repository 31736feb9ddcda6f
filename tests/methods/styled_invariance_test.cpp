// What must change nothing in a picture with looks, and what a change may reach.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#include "tests/support/shaded_scene.h"

namespace burin::styled_invariance_test {
namespace {

using namespace test;

constexpr int kWidth = 180, kHeight = 140;

std::string sheet_file(const std::string& name) { return BURIN_SOURCE_FOLDER "/styles/" + name + ".toml"; }
ShadedScene styled(const std::string& scene, const std::string& sheet, const std::vector<Override>& overrides = {}) {
    SceneDescription description =
        read_scene_file(BURIN_SOURCE_FOLDER "/scenes/" + scene + ".toml", overrides, sheet_file(sheet));
    return {std::move(description), kWidth, kHeight};
}

class StyledInvariance : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {};
INSTANTIATE_TEST_SUITE_P(Sheets, StyledInvariance,
                         ::testing::Combine(::testing::Values("still_life", "crossing", "teapot"),
                                            ::testing::Values("comic", "pencil", "technical", "patent", "architect")),
                         [](const auto& of) {
                             return std::string(std::get<0>(of.param)) + "_" + std::get<1>(of.param);
                         });

TEST_P(StyledInvariance, ThreadsMemoryAndCropsChangeNothing) {
    const auto& [scene_name, sheet] = GetParam();
    const ShadedScene scene = styled(scene_name, sheet);
    const Image whole = scene.draw(1);
    double ink = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) ink += value_at(whole, "lines.A", x, y);
    }
    EXPECT_GT(ink, 100);
    EXPECT_TRUE(same_bits(whole, scene.draw(3)));
    EXPECT_TRUE(same_bits(whole, scene.draw(2, std::uint64_t{200} << 20)));
    const PixelRect crop{41, 23, 130, 97};
    const Image part = scene.draw(crop, 2);
    std::size_t different = 0;
    for (const Channel& channel : part.channels()) {
        const Channel* const other = whole.find(channel.name);
        ASSERT_NE(other, nullptr);
        for (int y = crop.y0; y < crop.y1; ++y) {
            for (int x = crop.x0; x < crop.x1; ++x)
                different += part.value(channel, x - part.data().x0, y - part.data().y0) != whole.value(*other, x, y);
        }
    }
    EXPECT_EQ(different, 0u);
}

/// A style that matches one object: pixels away from that object's strokes stay as they are.
TEST(StyledOrder, AStyleOfOneObjectChangesNoOther) {
    const std::string scene = R"(
[camera]
eye = [3, 3, 8]
[[object]]
name = "left"
shape = "box"
translate = [-1, 0, 0]
[[object]]
name = "right"
shape = "torus"
translate = [0.7, 0, 0.4]
rotate = [60, 0, 20]
)";
    const auto sheet = [](const std::string& style) {
        return R"(style_version = 1
[[set]]
name = "one"
classes = ["silhouette", "crease", "border"]
objects = ["left"]
style = "one"
[[set]]
name = "all"
classes = ["silhouette", "crease", "border"]
style = "all"
[style.all]
width = "=1 + 2 * facing2 + t"
taper = { start = 12, end = 9 }
wobble = { amplitude = 1 }
[style.one]
)" + style;
    };
    const ShadedScene a(scene, sheet("width = 2\n"), kWidth, kHeight);
    const ShadedScene b(
        scene, sheet("width = \"=3 + 2 * noise(s / 7)\"\ncolor = \"#ff0000\"\novershoot = 4\ntaper = { start = 8 }\n"),
        kWidth, kHeight);
    const Image image_a = a.draw(), image_b = b.draw();
    // Where any stroke of the object may be.
    std::vector<bool> reached(static_cast<std::size_t>(kWidth * kHeight), false);
    for (const ShadedScene* scene_of : {&a, &b}) {
        const InkedLines lines = scene_of->inked();
        for (const InkStroke& s : lines.strokes) {
            if (s.order.set != 0) continue;
            const auto points = lines.points_of(s);
            for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                const double reach =
                    0.5 * static_cast<double>(std::max(points[i].width_px, points[i + 1].width_px)) + 1.5;
                const glm::dvec2 low = glm::min(points[i].place, points[i + 1].place) - reach,
                                 high = glm::max(points[i].place, points[i + 1].place) + reach;
                for (int y = std::max(0, static_cast<int>(low.y)); y < std::min<double>(kHeight, high.y); ++y) {
                    for (int x = std::max(0, static_cast<int>(low.x)); x < std::min<double>(kWidth, high.x); ++x)
                        reached[static_cast<std::size_t>(y * kWidth + x)] = true;
                }
            }
        }
    }
    std::size_t elsewhere = 0, changed = 0;
    for (const Channel& channel : image_a.channels()) {
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const bool differs = image_a.value(channel, x, y) != image_b.value(*image_b.find(channel.name), x, y);
                (reached[static_cast<std::size_t>(y * kWidth + x)] ? changed : elsewhere) += differs;
            }
        }
    }
    EXPECT_EQ(elsewhere, 0u);
    EXPECT_GT(changed, 500u);
}

/// Objects in another order in the file make the same ink.
TEST(StyledOrder, TheOrderOfObjectsChangesNothing) {
    const std::string
        camera = "[camera]\neye = [3, 3, 8]\n",
        a = "[[object]]\nname = \"a\"\nshape = \"box\"\ntranslate = [-1, 0, 0]\n",
        b = "[[object]]\nname = \"b\"\nshape = \"torus\"\ntranslate = [0.7, 0, 0.4]\nrotate = [60, 0, 20]\n",
        c = "[[object]]\nname = \"c\"\nshape = \"cylinder\"\ntranslate = [0, 1.2, 0]\n";
    const std::string sheet = sheet_of(R"("silhouette", "crease", "border", "object", "intersection")",
                                       "width = \"=1 + 2 * rand_object + rand_chain + t\"\nopacity = 0.7\n"
                                       "wobble = { amplitude = 1.5, wavelength = 20 }\ntaper = { start = 10 }");
    const Image one = ShadedScene(camera + a + b + c, sheet, kWidth, kHeight).draw(),
                other = ShadedScene(camera + c + b + a, sheet, kWidth, kHeight).draw();
    std::size_t different = 0;
    for (const std::string channel : {"R", "G", "lines.A", "lines.R"}) {
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x)
                different += value_at(one, channel, x, y) != value_at(other, channel, x, y);
        }
    }
    EXPECT_EQ(different, 0u);
}

/// What changes the most from one frame to the next while the camera moves by 1/32 pixel: the ink of a block of pixels.
double largest_pop(ShadedScene scene) {
    double most = 0;
    const Camera first = scene.camera();
    const Frame frame = scene.frame(scene.whole());
    const double px = frame.surfaces.projection.pixel_size(glm::length(first.to_world[3]));
    Image before = scene.draw(2);
    for (int i = 1; i <= 32; ++i) {
        scene.camera() = first;
        scene.camera().to_world[3] += first.to_world[0] * (i * px / 32);
        const Image now = scene.draw(2);
        for (int y = 0; y + 4 <= kHeight; y += 4) {
            for (int x = 0; x + 4 <= kWidth; x += 4) {
                double change = 0;
                for (int k = 0; k < 16; ++k) {
                    change += value_at(now, "lines.A", x + k % 4, y + k / 4) -
                              value_at(before, "lines.A", x + k % 4, y + k / 4);
                }
                most = std::max(most, std::abs(change));
            }
        }
        before = now;
    }
    return most;
}

/// A sheet that draws all that another one does with one width.
std::string one_width_of(const std::string& sheet) {
    const StyleSheet of = read_sheet_file(sheet_file(sheet));
    LineClassSet classes;
    for (const LineSet& set : of.sets) classes |= set.classes;
    std::string names;
    for (int c = 0; c < kLineClassCount; ++c) {
        const auto line_class = static_cast<LineClass>(c);
        if (classes.has(line_class)) names += (names.empty() ? "\"" : ", \"") + std::string(name_of(line_class)) + "\"";
    }
    const std::array<double, 2> crease = of.crease_angle_deg.value();
    return "crease_angle = [" + std::to_string(crease[0]) + ", " + std::to_string(crease[1]) +
           "]\n[[set]]\nname = \"all\"\nclasses = [" + names + "]\nstyle = \"one\"\n[style.one]\nwidth = 4.8\n";
}

TEST(StyledAnimation, LooksPopNoMoreThanOneWidthDoes) {
    struct View {
        const char* scene;
        std::vector<Override> overrides;
        double most_of_pencil = 1.5;
    };
    const Override eye{"camera.eye", "[3, 2.5, 6]"};
    // Where a contour breaks between facets, strokes that let others through show it more than opaque ones.
    constexpr double kBroken = 1.65;
    const View views[] = {{"cube", {}},
                          {"cube", {eye, {"camera.target", "[0, 0, 0]"}, {"camera.fov", "30"}}},
                          {"still_life", {}},
                          {"still_life", {eye, {"camera.target", "[0, 0.3, 0]"}, {"camera.fov", "35"}}, kBroken}};
    for (const View& view : views) {
        const std::string file = BURIN_SOURCE_FOLDER "/scenes/" + std::string(view.scene) + ".toml";
        for (const std::string sheet : {"comic", "pencil"}) {
            ShadedScene plain(read_scene_file(file, view.overrides), one_width_of(sheet), kWidth, kHeight);
            EXPECT_LE(largest_pop(styled(view.scene, sheet, view.overrides)),
                      (sheet == "pencil" ? view.most_of_pencil : 1.5) * largest_pop(std::move(plain)))
                << view.scene << " " << sheet << " " << view.overrides.size();
        }
    }
}

/// Contours break and join while the camera moves; the tapers of ends that come and go so add nothing to the pops.
TEST(StyledAnimation, TapersDoNotPopWhereContoursBreak) {
    std::ifstream file(sheet_file("comic"));
    std::string sheet{std::istreambuf_iterator<char>(file), {}};
    const std::string key = "taper = { ";
    const std::size_t begin = sheet.find(key);
    ASSERT_NE(begin, std::string::npos);
    const std::string without = sheet.replace(begin, sheet.find('\n', begin) - begin, "");
    for (const char* scene : {"teapot", "still_life"}) {
        ShadedScene bare(read_scene_file(BURIN_SOURCE_FOLDER "/scenes/" + std::string(scene) + ".toml", {}), without,
                         kWidth, kHeight);
        EXPECT_LE(largest_pop(styled(scene, "comic")), 1.1 * largest_pop(std::move(bare))) << scene;
    }
}

}  // namespace
}  // namespace burin::styled_invariance_test
