// Lines behind surfaces: hidden ones by themselves beside all kinds together.

#include "strokes/hidden_strokes.h"

#include <gtest/gtest.h>

#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::hidden_strokes_test {
namespace {

using namespace test;

constexpr int kSize = HiddenStrokes::kTilePx;

TEST(HiddenStrokes, HiddenLinesAloneAreDrawnAsAmongOthers) {
    Scene scene = scene_of({soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})});
    scene.lines.style.hidden.style = HiddenStyle::solid;
    const PixelRect rect{0, 0, kSize, kSize};
    const Frame frame = make_frame(scene, pixel_camera(kSize, kSize), kSize, kSize, rect);
    VisibleStrokes visible(frame);
    LayerSet layers;
    layers.lines_hidden = true;
    Random random(5);
    const auto place = [&] { return glm::dvec2(random.real(-2, kSize + 2), random.real(-2, kSize + 2)); };
    for (int round = 0; round < 40; ++round) {
        std::vector<LinePiece> in_front(5);
        std::vector<const LinePiece*> listed;
        for (LinePiece& s : in_front) {
            s.from = place();
            s.to = place();
            listed.push_back(&s);
        }
        visible.draw(listed, rect);
        std::vector<LinePiece> hidden;
        for (int i = 0; i < 8; ++i) {
            LinePiece s;
            s.from = place();
            s.to = place();
            s.invisibility = 1;
            s.transmission = round % 2 == 0 ? 255 : 100;
            hidden.push_back(s);
        }
        const auto drawn = [&] {
            Film film(rect, rect, layers, LineClassSet::all());
            for (int y = 0; y < kSize; ++y) film.put_background(0, kSize, y);
            HiddenStrokes strokes(frame, best_kernels(), 1, rect, {hidden}, false);
            EXPECT_TRUE(strokes.has_any(0));
            strokes.draw_below(0, 0, visible, film, nullptr);
            return film;
        };
        const Film alone = drawn();
        // One more, of another kind, that ends beside the tile.
        LinePiece beside = hidden.front();
        beside.from = {kSize + 1.2, 3};
        beside.to = {kSize + 1.3, 5};
        beside.transmission = 50;
        hidden.push_back(beside);
        EXPECT_TRUE(same_bits(alone.image(), drawn().image())) << round;
    }
}

}  // namespace
}  // namespace burin::hidden_strokes_test
