// Lines that no polygon has: `l` elements of OBJ, edges of PLY, line primitives of glTF.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "methods/reference/reference.h"
#include "tests/support/layers.h"
#include "tests/support/random.h"

namespace burin::loose_lines_test {
namespace {

using namespace test;

constexpr int kPicture = 100;

/// Adds a polyline to a soup.
void add_line(PolygonSoup& soup, const std::vector<glm::dvec3>& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto vertex = static_cast<std::uint32_t>(soup.positions.size());
        soup.positions.push_back(points[i]);
        if (i > 0) soup.marked_edges.push_back({vertex - 1, vertex});
    }
}
PolygonSoup line_of(const std::vector<glm::dvec3>& points) {
    PolygonSoup soup;
    add_line(soup, points);
    return soup;
}

Scene marks_of(std::vector<PolygonSoup> objects) {
    Scene scene = scene_of(std::move(objects));
    scene.lines.classes = LineClass::mark;
    return scene;
}

Drawing drawing(const Scene& scene, const Camera& camera, PixelRect crop = {0, 0, kPicture, kPicture},
                int threads = 2) {
    return Drawing(scene, camera, kPicture, kPicture, crop, threads, render_abuffer);
}
double ink(const Scene& scene, const Camera& camera) { return drawing(scene, camera).sum("lines.A"); }

const Camera kPixels = pixel_camera(kPicture, kPicture);

/// A box around the middle of the picture, in pixels.
PolygonSoup box_at(glm::dvec3 middle, glm::dvec3 size) { return moved(make_box(size), middle); }

/// Round ends reach half a width beyond.
double stroke_px(double length) { return length + M_PI / 4; }

TEST(LooseLines, AreDrawnWhereNothingElseIs) {
    const Scene scene = marks_of({line_of({{10.3, 20.1, 0}, {70.2, 20.1, 5}, {70.2, 80.4, -5}})});
    EXPECT_TRUE(scene.meshes[0].triangles.empty());
    EXPECT_NEAR(ink(scene, kPixels), 59.9 + 60.3 + 1, 1);
    EXPECT_NEAR(drawing(scene, kPixels).sum(LineClass::mark), 59.9 + 60.3 + 1, 1);
    Scene others = scene;
    others.lines.classes = kDefaultLineClasses;
    EXPECT_EQ(ink(others, kPixels), 0);
}

TEST(LooseLines, AreDrawnWithoutLinesThatSamplesMiss) {
    Scene scene = marks_of({line_of({{10.3, 20.1, 0}, {70.2, 50.1, 5}}), box_at({50, 50, 20}, {20, 60, 10})});
    const double expected = ink(scene, kPixels);
    for (const int samples : {2, 4, 8}) {
        scene.abuffer.samples = samples;
        scene.abuffer.fine_lines = false;
        EXPECT_NEAR(ink(scene, kPixels), expected, 0.5) << samples;
    }
}

// Beside, in front of, behind and through a box; of the same object and of another one.
TEST(LooseLines, AreHiddenBySurfaces) {
    for (const bool is_one_object : {false, true}) {
        const auto drawn = [&](const std::vector<glm::dvec3>& points) {
            PolygonSoup box = box_at({50, 50, 0}, {40, 40, 40});
            if (!is_one_object) return ink(marks_of({box, line_of(points)}), kPixels);
            add_line(box, points);
            return ink(marks_of({box}), kPixels);
        };
        EXPECT_NEAR(drawn({{10, 50.3, 0}, {90, 50.3, 0}}), 2 * stroke_px(20) - M_PI / 4, 1) << "through the box";
        EXPECT_NEAR(drawn({{10, 50.3, 30}, {90, 50.3, 30}}), stroke_px(80), 0.5) << "in front";
        EXPECT_NEAR(drawn({{10, 50.3, -30}, {90, 50.3, -30}}), 2 * stroke_px(20) - M_PI / 4, 1) << "behind";
        EXPECT_NEAR(drawn({{10, 50.3, 60}, {90, 50.3, -20}}), stroke_px(40) + stroke_px(20), 1.5)
            << "in by the front face";
        EXPECT_NEAR(drawn({{40, 50.3, 0}, {60, 50.3, 0}}), 0, 0) << "inside";
        EXPECT_NEAR(drawn({{40, 50.3, -30}, {60, 50.3, -30}}), 0, 0) << "behind all of it";
    }
}

TEST(LooseLines, OnAFaceAreDrawnOnce) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const glm::dvec3 direction = glm::normalize(random.direction() + glm::dvec3(0, 0, 1.2));
        const bool is_one_object = seed % 2 == 0, is_orthographic = seed % 4 < 2;
        const Camera camera =
            is_orthographic ? ortho_camera(5.0 * direction, 2.2) : perspective_camera(5.0 * direction, {0, 0, 0}, 28);
        const glm::dvec3 a(random.real(-0.45, 0.45), random.real(-0.45, 0.45), 0.5),
            b(random.real(-0.45, 0.45), random.real(-0.45, 0.45), 0.5);
        const auto scene_with = [&](double side) {  // on the front face or the back face
            const std::vector<glm::dvec3> points{{a.x, a.y, side}, {b.x, b.y, side}};
            PolygonSoup box = make_box({1, 1, 1});
            if (!is_one_object) return marks_of({box, line_of(points)});
            add_line(box, points);
            return marks_of({box});
        };
        const Scene alone = marks_of({line_of({a, b}), box_at({0, 0, -100}, {1, 1, 1})});
        const double expected = ink(alone, camera);
        EXPECT_NEAR(ink(scene_with(0.5), camera), expected, 1e-3 * expected) << seed;
        if (direction.z > 0.2) {
            EXPECT_EQ(ink(scene_with(-0.5), camera), 0) << seed;
        }
    }
}

// A line over the middles of a face's edges, and one from corner to corner of a polygon that is cut
// the other way.
TEST(LooseLines, FromCornerToCornerOfAFace) {
    PolygonSoup box = make_box({40, 40, 40});
    box = moved(box, {50, 50, 0});
    const auto is_corner = [&](double x, double y) {
        return static_cast<std::uint32_t>(std::find(box.positions.begin(), box.positions.end(), glm::dvec3(x, y, 20)) -
                                          box.positions.begin());
    };
    for (const bool falls : {false, true}) {
        PolygonSoup with_line = box;
        with_line.marked_edges.push_back({is_corner(30, falls ? 70 : 30), is_corner(70, falls ? 30 : 70)});
        EXPECT_NEAR(ink(marks_of({with_line}), kPixels), stroke_px(40 * std::sqrt(2.0)), 0.5) << falls;
    }
}

// A polyline along an edge of a polygon that has no vertex there.
TEST(LooseLines, AlongAnEdgeAreDrawnOnce) {
    PolygonSoup box = box_at({50, 50, 0}, {40, 40, 40});
    add_line(box, {{30, 70, 20}, {43, 70, 20}, {70, 70, 20}});
    Scene scene = marks_of({box});
    scene.lines.classes = LineClass::mark | LineClass::crease | LineClass::silhouette;
    Scene plain = scene_of({box_at({50, 50, 0}, {40, 40, 40})});
    const Drawing drawn = drawing(scene, kPixels), expected = drawing(plain, kPixels);
    EXPECT_NEAR(drawn.sum("lines.A"), expected.sum("lines.A"), 1e-3);
    EXPECT_NEAR(drawn.sum(LineClass::mark), 41, 1);
}

TEST(LooseLines, AreCutAtTheNearPlane) {
    const Camera camera = perspective_camera({0, 0, 0}, {0, 0, -1}, 60);
    // From behind the eye to far away in the middle of the picture, below it.
    const Scene scene = marks_of({line_of({{0, -1, 10}, {0, -1, -1000}}), line_of({{-1, 1, -5}, {1, 1, -5}})});
    const Drawing drawn = drawing(scene, camera);
    EXPECT_EQ(drawn.drawn_share({50, 51}, {50, 100}), 1);
    EXPECT_NEAR(drawing(scene, camera, {0, 50, kPicture, kPicture}).sum("lines.A"), 50, 1);
}

TEST(LooseLines, ThreadsTilesCropsAndCapsChangeNothing) {
    Random random(7);
    PolygonSoup lines,
        sphere = transformed(make_sphere(25, 24, 12), [](glm::dvec3 p) { return p + glm::dvec3(50, 50, 0); });
    for (int i = 0; i < 60; ++i) {
        const glm::dvec3 a = random.in_box(50), b = random.in_box(50);
        add_line(i % 2 == 0 ? lines : sphere, {a + glm::dvec3(50, 50, 0), b + glm::dvec3(50, 50, 0)});
    }
    for (const HiddenStyle hidden : {HiddenStyle::none, HiddenStyle::solid, HiddenStyle::dashed}) {
        Scene scene = marks_of({sphere, lines});
        scene.lines.classes = LineClassSet::all();
        scene.lines.style.hidden.style = hidden;
        const Drawing whole = drawing(scene, kPixels);
        for (const int threads : {1, 3})
            EXPECT_TRUE(same_bits(whole.image(), drawing(scene, kPixels, {0, 0, kPicture, kPicture}, threads).image()));
        const PixelRect crop{23, 31, 77, 68};
        const Drawing part = drawing(scene, kPixels, crop);
        for (int y = crop.y0; y < crop.y1; ++y) {
            for (int x = crop.x0; x < crop.x1; ++x)
                ASSERT_EQ(part.line(x - crop.x0, y - crop.y0), whole.line(x, y)) << x << ' ' << y;
        }
        const Frame frame = make_frame(scene, kPixels, kPicture, kPicture, {0, 0, kPicture, kPicture});
        LayerSet layers;
        const auto image_of = [&](const RunOptions& options) {
            Film film({0, 0, kPicture, kPicture}, frame.crop, layers, frame.criteria.classes);
            render_abuffer(frame, options, film);
            return film.image();
        };
        const Image expected = image_of({2});
        for (const int tile_samples : {16, 32})
            EXPECT_TRUE(same_bits(expected, image_of({2, nullptr, 0, tile_samples})));
        EXPECT_TRUE(same_bits(expected, image_of({2, nullptr, std::uint64_t{64} << 20})));
    }
}

TEST(LooseLines, HiddenOnesCountTheLayersInFront) {
    Scene scene = marks_of({box_at({120, 120, 0}, {100, 100, 100}), line_of({{20, 120.5, -80}, {220, 120.5, -80}})});
    scene.lines.style.hidden.style = HiddenStyle::solid;
    const Layers layers(scene, pixel_camera(test::kSize, test::kSize));
    ASSERT_EQ(layers.pass.lines().size(), 1u);
    EXPECT_NEAR(layers.hidden_px(2), 100, 0.1) << "the front and the back of the box";
    EXPECT_NEAR(layers.all_hidden_px(), 100, 0.1);
    // On the back of the box: only the front is before it. On its front: nothing is.
    for (const auto& [z, count] : {std::pair(-50.0, 1), {50.0, 0}}) {
        scene = marks_of({box_at({120, 120, 0}, {100, 100, 100}), line_of({{80, 120.5, z}, {160, 130, z}})});
        scene.lines.style.hidden.style = HiddenStyle::solid;
        const Layers on_face(scene, pixel_camera(test::kSize, test::kSize));
        EXPECT_NEAR(on_face.all_hidden_px(), count * std::hypot(80, 9.5), 0.1) << z;
        if (count > 0) {
            EXPECT_NEAR(on_face.hidden_px(count), std::hypot(80, 9.5), 0.1) << z;
        }
    }
}

TEST(LooseLines, ShowThroughGlass) {
    PolygonSoup pane = box_at({50, 50, 40}, {40, 40, 0.5});
    pane.materials = {Material{"glass", glm::vec3(0.8f), 0.5f}};
    const double drawn = ink(marks_of({pane, line_of({{20, 50.5, 0}, {80, 50.5, 0}})}), kPixels);
    EXPECT_NEAR(drawn, 20 + 40 * 0.25 + 1, 1) << "two panes in front of 40 pixels";
}

TEST(LooseLines, AreWhereRaysSeeThem) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        Random random(seed);
        PolygonSoup ball = transformed(make_sphere(22, 20, 11), [](glm::dvec3 p) { return p + glm::dvec3(50, 50, 0); });
        PolygonSoup lines;
        for (int i = 0; i < 5; ++i) {
            const glm::dvec3 middle(50, 50, 0);
            add_line(i % 2 == 0 ? ball : lines,
                     {middle + random.in_box(45), middle + random.in_box(45), middle + random.in_box(45)});
        }
        Scene scene = marks_of({ball, box_at({60, 40, 10}, {30, 20, 15}), lines});
        scene.reference.samples = 8;
        const Drawing drawn = drawing(scene, kPixels),
                      truth(scene, kPixels, kPicture, kPicture, {0, 0, kPicture, kPicture}, 2, render_reference);
        EXPECT_GT(truth.sum("lines.A"), 50);
        // A stroke's end where its line passes under an edge along a row of pixels may lie over that edge.
        int differing = 0;
        for (int y = 0; y < kPicture; ++y) {
            for (int x = 0; x < kPicture; ++x) {
                const double difference = std::abs(drawn.line(x, y) - truth.line(x, y));
                EXPECT_LT(difference, 0.4) << seed << ": " << x << ' ' << y;
                differing += difference > 0.06 ? 1 : 0;
            }
        }
        EXPECT_LE(differing, 2) << seed;
        EXPECT_NEAR(drawn.sum("lines.A") / truth.sum("lines.A"), 1, 0.01) << seed;
    }
}

// Dashes run on over the joints of a polyline, as if it were one line.
TEST(LooseLines, DashesRunOnOverJoints) {
    Scene one = marks_of({line_of({{10, 20, 0}, {90, 70, 0}})}),
          many = marks_of({line_of({{10, 20, 0}, {26, 30, 0}, {50, 45, 0}, {90, 70, 0}})});
    for (Scene* scene : {&one, &many}) scene->lines.style.dash_px = {{7, 4}};
    EXPECT_NEAR(ink(one, kPixels), ink(many, kPixels), 0.1);
    const Drawing a = drawing(one, kPixels), b = drawing(many, kPixels);
    for (int y = 0; y < kPicture; ++y) {
        for (int x = 0; x < kPicture; ++x) ASSERT_NEAR(a.line(x, y), b.line(x, y), 0.05) << x << ' ' << y;
    }
    // Where a marked edge of a polygon goes on as a loose line, too.
    PolygonSoup sheet = soup_of({{10, 20, 0}, {50, 45, 0}, {20, 60, 0}, {90, 70, 0}}, {{0, 1, 2}});
    sheet.marked_edges = {{0, 1}, {1, 3}};
    Scene mixed = marks_of({sheet});
    mixed.lines.style.dash_px = {{7, 4}};
    EXPECT_NEAR(ink(mixed, kPixels), ink(one, kPixels), 0.3);
}

/// Whether something is in front of a place, by more than `slack`, along -z.
bool is_behind(const std::vector<PolygonSoup>& objects, glm::dvec3 p, double slack) {
    for (const PolygonSoup& soup : objects) {
        for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
            const auto c = soup.polygon(i);
            const glm::dvec3 a = soup.positions[c[0]], b = soup.positions[c[1]], d = soup.positions[c[2]];
            const auto side = [&](const glm::dvec3& u, const glm::dvec3& v) {
                return (v.x - u.x) * (p.y - u.y) - (v.y - u.y) * (p.x - u.x);
            };
            const double area = (b.x - a.x) * (d.y - a.y) - (b.y - a.y) * (d.x - a.x);
            const double wa = side(b, d) / area, wb = side(d, a) / area, wd = side(a, b) / area;
            if (wa < 0 || wb < 0 || wd < 0) continue;
            if (wa * a.z + wb * b.z + wd * d.z > p.z + slack) return true;
        }
    }
    return false;
}

TEST(LooseLines, AreSeenWhereNothingIsInFront) {
    for (std::uint64_t seed = 0; seed < 25; ++seed) {
        Random random(seed);
        std::vector<PolygonSoup> objects(2);
        for (int i = 0; i < 14; ++i) {
            PolygonSoup& soup = objects[static_cast<std::size_t>(i % 2)];
            std::vector<std::uint32_t> corners;
            const glm::dvec3 middle = random.in_box(40) + glm::dvec3(50, 50, 0);
            const double size = i < 10 ? 30 : 0.4;  // some between samples
            for (int k = 0; k < 3; ++k) {
                corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
                soup.positions.push_back(middle + random.in_box(size));
            }
            soup.add_polygon(corners);
        }
        const glm::dvec3 from = random.in_box(45) + glm::dvec3(50, 50, 0),
                         to = random.in_box(45) + glm::dvec3(50, 50, 0);
        std::vector<PolygonSoup> with_line = objects;
        add_line(with_line[seed % 2], {from, to});
        const Drawing drawn = drawing(marks_of(with_line), kPixels);
        const double length = glm::distance(glm::dvec2(from), glm::dvec2(to));
        const auto is_hidden_at = [&](double px, double slack) {
            return is_behind(objects, glm::mix(from, to, px / length), slack);
        };
        for (double px = 3; px < length - 3; px += 0.25) {
            bool is_all_hidden = true, is_any_hidden = false;
            for (double d = -2; d <= 2; d += 0.125) {
                is_all_hidden = is_all_hidden && is_hidden_at(px + d, 0.05);
                is_any_hidden = is_any_hidden || is_hidden_at(px + d, -0.05);
            }
            const glm::dvec3 p = glm::mix(from, to, px / length);
            const double here = drawn.line(static_cast<int>(p.x), static_cast<int>(kPicture - p.y));
            if (is_all_hidden) {
                ASSERT_EQ(here, 0) << seed << ' ' << px;
            }
            if (!is_any_hidden) {
                ASSERT_GT(here, 0.05) << seed << ' ' << px;
            }
        }
    }
}

// Among very many triangles in one pixel nothing that is in front is lost.
TEST(LooseLines, ThousandsInOnePlace) {
    Random random(1);
    PolygonSoup heap;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        for (int k = 0; k < 3; ++k) heap.positions.push_back(random.in_box(3) + glm::dvec3(50, 50, 0));
        heap.add_polygon(std::vector<std::uint32_t>{3 * i, 3 * i + 1, 3 * i + 2});
    }
    for (int i = 0; i < 1000; ++i)
        add_line(heap, {random.in_box(3) + glm::dvec3(50, 50, i % 2 == 0 ? 20 : 0),
                        random.in_box(3) + glm::dvec3(50, 50, 20)});
    const Drawing drawn = drawing(marks_of({heap}), kPixels);
    EXPECT_GT(drawn.line(50, 50), 0.99);
}

}  // namespace
}  // namespace burin::loose_lines_test
