// Lines with one look are drawn as they are without looks of their own, to the bit; and what must change nothing.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "tests/strokes/ink_picture.h"
#include "tests/support/random.h"

namespace burin::ink_equality_test {
namespace {

using namespace test;

/// The lines of a drawing, one stroke for each piece, with the look that the scene asks for.
InkedLines inked(const LineDrawing& drawing, const LineStyle& style) {
    InkedLines lines;
    lines.filter = style.filter;
    const auto add = [&](const LinePiece& piece) {
        InkOrder order;
        order.is_hidden = piece.is_hidden();
        order.drawn_as = piece.drawn_as;
        if (piece.occludes && !piece.is_hidden()) {
            lines.boundaries.push_back({piece.from, piece.to, piece.nearness_from, piece.nearness_to,
                                        piece.front_on_left, order, piece.is_drawn});
        }
        if (!piece.is_drawn) return;
        InkStroke stroke;
        stroke.first_point = lines.points.size();
        stroke.point_count = 2;
        stroke.order = order;
        stroke.chain = lines.strokes.size();
        stroke.side = style.side;
        stroke.is_behind = piece.is_hidden() || piece.transmission < 255;
        InkPoint point;
        point.place = piece.from;
        point.nearness = piece.nearness_from;
        point.width_px = static_cast<float>(piece.is_hidden() ? style.hidden_width_px() : style.width_px);
        point.opacity = static_cast<float>(piece.seen_opacity()) / 255.0f;
        point.color = piece.is_hidden() ? style.hidden.color : style.color_of(piece.drawn_as);
        point.occludes = piece.occludes;
        point.front_on_left = piece.front_on_left;
        if (piece.occludes && !piece.is_hidden())
            point.boundary = static_cast<std::uint32_t>(lines.boundaries.size() - 1);
        lines.points.push_back(point);
        point.place = piece.to;
        point.nearness = piece.nearness_to;
        lines.points.push_back(point);
        lines.strokes.push_back(stroke);
    };
    for (const auto& list : drawing.visible()) std::for_each(list.begin(), list.end(), add);
    for (const auto& list : drawing.behind()) std::for_each(list.begin(), list.end(), add);
    return lines;
}

struct Pair {
    Image drawn, inked;
};
Pair draw_twice(const Scene& scene, const Camera& camera, int size) {
    const PixelRect all{0, 0, size, size};
    const Frame frame = make_frame(scene, camera, size, size, all);
    RunOptions options;
    options.threads = 1;
    LayerSet layers{true, true, true, true, true, true, true, true};
    Film film(all, all, layers, frame.criteria.classes);
    const LineDrawing drawing = laid_out_if_needed(find_drawing(frame, options, film), frame, 1);
    Film other = film.copy();
    draw_lines(frame, drawing, options, film);
    draw_ink(frame, inked(drawing, scene.lines.style), 2, other);
    return {film.image(), other.image()};
}

Scene some_scene(int kind) {
    const auto turned = [](glm::dvec3 p) {
        return glm::dvec3(64 + p.x, 64 + 0.8 * p.y - 0.6 * p.z, 0.6 * p.y + 0.8 * p.z);
    };
    std::vector<PolygonSoup> objects;
    if (kind == 0)
        objects = {transformed(make_box({50, 40, 30}), turned), transformed(make_torus(40, 9, 48, 24), turned)};
    if (kind == 1)
        objects = {transformed(make_sphere(40, 24, 12), turned), transformed(make_cylinder(20, 30, 90, 16), turned)};
    if (kind == 2)
        objects = {
            transformed(make_box({46, 46, 46}), turned),
            soup_of({{34.2, 38.1, 100}, {60.7, 33.6, 100}, {65.4, 58.8, 100}, {38.3, 63.3, 100}}, {{0, 1, 2, 3}})};
    return scene_of(std::move(objects));
}

TEST(InkEquality, OpaqueStrokesOfOneWidthAreDrawnAsLinesAre) {
    for (int kind = 0; kind < 3; ++kind) {
        for (const double width : {315.0 / 1024, 1.0, 3.0, 12.0}) {
            for (const bool has_hidden : {false, true}) {
                Scene scene = some_scene(kind);
                scene.lines.style.width_px = width;
                scene.lines.classes = LineClassSet::all();
                for (int c = 0; c < kLineClassCount; ++c)
                    scene.lines.style.colors[static_cast<std::size_t>(c)] =
                        glm::vec3(0.1f * static_cast<float>(c), 0.3f, 0);
                if (has_hidden) scene.lines.style.hidden.style = HiddenStyle::dashed;
                const Pair pair = draw_twice(scene, pixel_camera(128, 128), 128);
                EXPECT_TRUE(same_bits(pair.drawn, pair.inked)) << kind << " " << width << " " << has_hidden;
            }
        }
    }
}

/// Crease lines of a box end at a plate whose border nobody asked for; and strokes on one side of a line.
TEST(InkEquality, StrokesAreCutAtNearerSurfacesAsLinesAre) {
    for (const StrokeSide side : {StrokeSide::both, StrokeSide::inside, StrokeSide::outside}) {
        for (const double width : {1.0, 5.0, 20.0}) {
            Scene scene = some_scene(2);
            scene.lines.style.width_px = width;
            scene.lines.style.side = side;
            scene.lines.classes = LineClassSet(LineClass::crease) | LineClass::silhouette;
            const Pair pair = draw_twice(scene, pixel_camera(128, 128), 128);
            EXPECT_TRUE(same_bits(pair.drawn, pair.inked)) << static_cast<int>(side) << " " << width;
        }
    }
}

TEST(InkEquality, FiltersAreThoseOfLines) {
    for (const PixelFilter filter : {PixelFilter::gaussian, PixelFilter::mitchell}) {
        for (const double width : {0.5, 1.0, 4.0}) {
            Scene scene = some_scene(0);
            scene.lines.style.width_px = width;
            scene.lines.style.filter = filter;
            const Pair pair = draw_twice(scene, pixel_camera(128, 128), 128);
            EXPECT_TRUE(same_bits(pair.drawn, pair.inked)) << static_cast<int>(filter) << " " << width;
        }
    }
}

/// Strokes of every kind, with places and looks at random.
InkPicture some_strokes(std::uint64_t seed, int count) {
    Random random(seed);
    InkPicture picture(100, 80);
    picture.lines.layers = {"", "fine"};
    for (int i = 0; i < count; ++i) {
        std::vector<InkPoint> points;
        glm::dvec2 place(random.real(0, 100), random.real(0, 80));
        const bool is_constant = random.integer(0, 1) == 0;
        for (int k = random.integer(2, 6); k > 0; --k) {
            const bool is_first = points.empty();
            InkPoint p = InkPicture::point(
                place, random.integer(0, 4) == 0 ? 0.1f : static_cast<float>(random.real(0, 9)),
                random.integer(0, 2) == 0 ? 1.0f : static_cast<float>(random.real(0, 1)),
                {static_cast<float>(random.integer(0, 2)) * 0.5f, 0.25f, static_cast<float>(random.real(0, 1))});
            if (is_constant && !is_first) {
                const glm::dvec2 own = p.place;
                p = points.front();
                p.place = own;
            }
            p.nearness = static_cast<float>(-random.integer(50, 60));
            p.occludes = random.integer(0, 2) == 0;
            points.push_back(p);
            place += glm::dvec2(random.real(-30, 30), random.real(-30, 30));
        }
        InkStroke& stroke = picture.add(points);
        stroke.order.below = random.integer(-1, 0);
        stroke.order.is_hidden = random.integer(0, 3) == 0;
        stroke.order.set = static_cast<std::uint32_t>(random.integer(0, 1));
        stroke.order.drawn_as = random.integer(0, 1) == 0 ? LineClass::crease : LineClass::silhouette;
        stroke.chain = static_cast<std::uint64_t>(random.integer(0, count));
        stroke.caps = random.integer(0, 3) == 0 ? StrokeCaps::butt : StrokeCaps::round;
        stroke.blend = random.integer(0, 5) == 0 ? InkBlend::multiply : InkBlend::over;
        stroke.side = random.integer(0, 5) == 0 ? StrokeSide::inside : StrokeSide::both;
        if (random.integer(0, 7) == 0) stroke.halo_px = 3, stroke.halo_depth_px = {1, 5};
    }
    for (int i = 0; i < count / 2; ++i) {
        InkBoundary b;
        b.from = {random.real(0, 100), random.real(0, 80)};
        b.to = b.from + glm::dvec2(random.real(-30, 30), random.real(-30, 30));
        b.nearness_from = b.nearness_to = static_cast<float>(-random.integer(40, 60));
        b.is_drawn = random.integer(0, 1) == 0;
        b.order = picture.lines.strokes[static_cast<std::size_t>(random.integer(0, count - 1))].order;
        picture.lines.boundaries.push_back(b);
    }
    picture.lines.filter = seed % 3 == 0 ? PixelFilter::gaussian : PixelFilter::box;
    picture.paper = seed % 2 == 0 ? glm::vec4(1.0f) : glm::vec4(0.2f, 0.1f, 0.0f, 0.5f);
    return picture;
}

TEST(InkEquality, ThreadsAndTheOrderOfTheListChangeNothing) {
    for (std::uint64_t seed = 0; seed < 15; ++seed) {
        InkPicture picture = some_strokes(seed, 30);
        const Image first = picture.draw(1);
        ASSERT_TRUE(same_bits(first, picture.draw(3))) << seed;
        Random random(seed + 1000);
        std::vector<InkStroke>& strokes = picture.lines.strokes;
        for (std::size_t i = strokes.size() - 1; i > 0; --i)
            std::swap(strokes[i], strokes[static_cast<std::size_t>(random.integer(0, static_cast<int>(i)))]);
        ASSERT_TRUE(same_bits(first, picture.draw(2))) << seed;
    }
}

TEST(InkEquality, CropsShowWhatTheWholePictureShows) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const InkPicture picture = some_strokes(seed, 25);
        const Image whole = picture.draw(1);
        Random random(seed);
        const int x0 = random.integer(0, 60), y0 = random.integer(0, 50);
        const PixelRect crop{x0, y0, random.integer(x0 + 1, 100), random.integer(y0 + 1, 80)};
        const Image part = picture.draw(crop, 2);
        for (const Channel& channel : part.channels()) {
            for (int y = crop.y0; y < crop.y1; ++y) {
                for (int x = crop.x0; x < crop.x1; ++x)
                    ASSERT_EQ(at(part, channel.name, x, y), at(whole, channel.name, x, y))
                        << seed << " " << channel.name << " " << x << "," << y;
            }
        }
    }
}

/// Only pixels that a stroke reaches change with its look.
TEST(InkEquality, AStylesChangeStaysWhereItsStrokesAre) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        InkPicture picture = some_strokes(seed, 25);
        for (InkStroke& s : picture.lines.strokes) s.halo_px = 0;
        picture.lines.filter = PixelFilter::box;
        const Image before = picture.draw();
        InkPicture alone(100, 80), changed = picture;
        const InkStroke& stroke = picture.lines.strokes[7];
        changed.lines.strokes[7].is_constant = false;
        for (std::size_t i = 0; i < stroke.point_count; ++i) {
            InkPoint& p = changed.lines.points[stroke.first_point + i];
            p.color = {0.9f, 0.8f, 0.1f * static_cast<float>(i)};
            p.opacity *= 0.5f;
        }
        std::vector<InkPoint> points;
        for (const InkPoint& p : picture.lines.points_of(stroke))
            points.push_back(InkPicture::point(p.place, p.width_px));
        InkStroke& reaching = alone.add(points);
        reaching.caps = stroke.caps;
        reaching.side = stroke.side;  // else its finest pen is finer
        const Image reached = alone.draw(), after = changed.draw();
        for (const Channel& channel : before.channels()) {
            for (int y = 0; y < 80; ++y) {
                for (int x = 0; x < 100; ++x) {
                    if (at(reached, "lines.A", x, y) > 0) continue;
                    ASSERT_EQ(at(before, channel.name, x, y), at(after, channel.name, x, y))
                        << seed << " " << channel.name << " " << x << "," << y;
                }
            }
        }
    }
}

}  // namespace
}  // namespace burin::ink_equality_test
