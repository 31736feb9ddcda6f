// Lines found once and drawn later make the picture that a render makes, to the bit: for all scenes and looks.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "methods/abuffer.h"
#include "scene/scene_description.h"
#include "tests/support/drawing.h"

namespace burin::drawing_test {
namespace {

using namespace test;

struct Look {
    std::string name;
    std::vector<Override> overrides;
    bool is_cropped = false;
    std::uint64_t memory_bytes = 0;
};

std::vector<Look> looks() {
    std::vector<Look> all = {
        {"plain", {}},
        {"hidden", {{"lines.hidden.style", "\"solid\""}, {"lines.hidden.width", "2"}}},
        {"hidden dashed", {{"lines.hidden.style", "\"dashed\""}}},
        {"dashed", {{"lines.dash", "[7, 4]"}, {"lines.width", "2"}}},
        {"both dashed", {{"lines.dash", "[6, 3]"}, {"lines.hidden.style", "\"dashed\""}}},
        {"fading", {{"lines.crease_angle", "[20, 60]"}, {"lines.hidden.style", "\"solid\""}}},
        {"one side", {{"lines.side", "\"outside\""}, {"lines.width", "4"}}},
        {"filter", {{"lines.filter", "\"mitchell\""}, {"lines.hidden.style", "\"solid\""}}},
        {"smooth", {{"lines.contours", "\"smooth\""}, {"lines.hidden.style", "\"dashed\""}}},
    };
    Look crop = all[1], cropped_dashes = all[4], capped = all[1], capped_plain = all[0];
    crop.name = "hidden, cropped";
    cropped_dashes.name = "both dashed, cropped";
    crop.is_cropped = cropped_dashes.is_cropped = true;
    capped.name = "hidden, capped";
    capped_plain.name = "plain, capped";
    capped.memory_bytes = capped_plain.memory_bytes = std::uint64_t{200} << 20;
    all.insert(all.end(), {crop, cropped_dashes, capped, capped_plain});
    return all;
}

constexpr int kWidth = 120, kHeight = 90;

Film film_of(const Frame& frame) {
    LayerSet layers;
    layers.coverage = layers.surface = layers.lines_hidden = true;
    return {{0, 0, kWidth, kHeight}, frame.crop, layers, frame.criteria.classes};
}

/// A scene's lines, found once, are drawn twice over the surfaces that were found with them.
void expect_same(const std::string& path, const Look& look) {
    Scene scene = load_scene(read_scene_file(path, look.overrides));
    const Camera camera =
        resolve_camera(scene.cameras.front(), scene_points(scene), static_cast<double>(kWidth) / kHeight);
    const PixelRect crop = look.is_cropped ? PixelRect{37, 21, 101, 70} : PixelRect{0, 0, kWidth, kHeight};
    Frame frame = make_frame(scene, camera, kWidth, kHeight, crop);
    RunOptions options{1, nullptr, look.memory_bytes};
    Film whole = film_of(frame);
    render_abuffer(frame, options, whole);
    options.threads = 2;
    // However much finding tells of lines, they are drawn alike.
    for (const bool tells_invisibility : {false, true}) {
        frame.needs.tells_invisibility = tells_invisibility;
        Film surfaces = film_of(frame);
        const LineDrawing drawing = laid_out_if_needed(find_drawing(frame, options, surfaces), frame, 2);
        for (const int threads : {1, 3}) {
            options.threads = threads;
            Film film = surfaces.copy();
            draw_lines(frame, drawing, options, film);
            EXPECT_TRUE(same_bits(film.image(), whole.image())) << path << ", " << look.name << ", " << threads;
        }
    }
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(BURIN_SOURCE_FOLDER "/scenes")) {
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// Tests of a scene, each with some of the looks.
constexpr std::size_t kParts = 3;

class Drawings : public ::testing::TestWithParam<std::tuple<std::string, std::size_t>> {};

TEST_P(Drawings, OfFoundLinesAreTheRenderedPicture) {
    const auto& [scene, first] = GetParam();
    const std::vector<Look> all = looks();
    for (std::size_t i = first; i < all.size(); i += kParts)
        expect_same(BURIN_SOURCE_FOLDER "/scenes/" + scene + ".toml", all[i]);
}
INSTANTIATE_TEST_SUITE_P(
    Scenes, Drawings, ::testing::Combine(::testing::ValuesIn(scene_names()), ::testing::Range<std::size_t>(0, kParts)),
    [](const auto& of) { return std::get<0>(of.param) + "_" + std::to_string(std::get<1>(of.param)); });

}  // namespace
}  // namespace burin::drawing_test
