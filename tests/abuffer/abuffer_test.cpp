// What must not change a picture of the method `abuffer`, and that its fast ways say what the slow and
// obvious ones say.

#include "methods/abuffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abuffer/samples/fast_decision.h"
#include "abuffer/samples/pixel_fill.h"
#include "abuffer/samples/surface_tile.h"
#include "base/error.h"
#include "base/interrupt.h"
#include "mesh/shapes.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::abuffer_test {
namespace {

using namespace test;

/// Shapes that hide, cut and touch each other, and loose polygons.
Scene heap(std::uint64_t seed, bool in_reverse = false) {
    Random random(seed);
    std::vector<PolygonSoup> objects(1);
    for (int i = 0; i < 20; ++i) {
        const glm::dvec3 center = random.in_box(1);
        for (int k = 0; k < 3; ++k) objects[0].positions.push_back(center + random.direction() * random.real(0.1, 0.8));
    }
    for (std::uint32_t i = 0; i < 20; ++i) {
        const std::uint32_t first = 3 * (in_reverse ? 19 - i : i);
        objects[0].add_polygon(std::vector<std::uint32_t>{first, first + 1, first + 2});
    }
    objects.push_back(make_torus(0.7, 0.25, 48, 24));
    objects.push_back(
        transformed(make_box({0.8, 0.5, 1.1}), [](glm::dvec3 p) { return p + glm::dvec3(0.2, 0.3, -0.1); }));
    Scene scene = scene_of(std::move(objects));
    scene.lines.classes = LineClassSet::all();
    return scene;
}

const glm::dvec3 kEye(2.3, 1.7, 4.1);
constexpr int kWidth = 150, kHeight = 110;

Image draw(const Scene& scene, PixelRect crop = {0, 0, kWidth, kHeight}, int threads = 1) {
    const Camera camera = perspective_camera(kEye, {0, 0, 0});
    const Frame frame = make_frame(scene, camera, kWidth, kHeight, crop);
    Film film({0, 0, kWidth, kHeight}, crop, LayerSet{true, true, true, true, true, true, true},
              frame.criteria.classes);
    RunOptions options;
    options.threads = threads;
    render_abuffer(frame, options, film);
    return film.image();
}

TEST(Abuffer, ThreadsChangeNothing) {
    const Scene scene = heap(1);
    const Image one = draw(scene);
    for (int threads = 2; threads <= 8; ++threads) {
        EXPECT_TRUE(same_bits(one, draw(scene, {0, 0, kWidth, kHeight}, threads))) << threads;
    }
}

TEST(Abuffer, ACropIsThatPartOfTheWhole) {
    for (const int samples : {2, 4, 8}) {
        Scene scene = heap(2);
        scene.abuffer.samples = samples;
        const Image whole = draw(scene);
        for (const PixelRect crop : {PixelRect{37, 21, 101, 80}, PixelRect{50, 40, 51, 41}}) {
            const Image part = draw(scene, crop);
            for (const Channel& c : part.channels()) {
                const Channel* const same = whole.find(c.name);
                ASSERT_NE(same, nullptr);
                for (int y = crop.y0; y < crop.y1; ++y) {
                    for (int x = crop.x0; x < crop.x1; ++x) {
                        ASSERT_EQ(part.value(c, x - crop.x0, y - crop.y0), whole.value(*same, x, y))
                            << c.name << " " << x << "," << y << " samples " << samples;
                    }
                }
            }
        }
    }
}

/// In a very wide view whether two triangles coincide is another question in each corner of a tile.
TEST(Abuffer, ACropOfAVeryWideViewFromWithinIsThatPartOfTheWhole) {
    for (std::uint64_t trial = 0; trial < 40; ++trial) {
        Random random(trial);
        PolygonSoup soup;
        for (std::uint32_t t = 0; t < 60; ++t) {
            const glm::dvec3 center = random.in_box(0.3);
            const double apart = std::pow(10.0, random.real(-7, -5));  // of every other one from the one before
            for (std::uint32_t k = 0; k < 3; ++k) {
                soup.positions.push_back(t % 2 == 0 ? center + random.direction() * random.real(0, 0.6)
                                                    : soup.positions[3 * t - 3 + k] + random.in_box(apart));
            }
            soup.add_polygon(std::vector<std::uint32_t>{3 * t, 3 * t + 1, 3 * t + 2});
        }
        const Scene scene = scene_of({soup});
        const Camera camera = perspective_camera(random.in_box(0.05), random.in_box(1), 178);
        const auto draw = [&](PixelRect crop) {
            const Frame frame = make_frame(scene, camera, kWidth, kHeight, crop);
            Film film({0, 0, kWidth, kHeight}, crop, LayerSet{true, true, true, true, true, true, true, true},
                      frame.criteria.classes);
            render_abuffer(frame, RunOptions{}, film);
            return film.image();
        };
        const int x0 = random.integer(0, kWidth - 20), y0 = random.integer(0, kHeight - 20);
        const PixelRect crop{x0, y0, random.integer(x0 + 10, kWidth), random.integer(y0 + 10, kHeight)};
        const Image whole = draw({0, 0, kWidth, kHeight}), part = draw(crop);
        for (const Channel& channel : part.channels()) {
            const Channel& full = *whole.find(channel.name);
            for (int y = 0; y < part.height(); ++y) {
                for (int x = 0; x < part.width(); ++x) {
                    ASSERT_EQ(part.value(channel, x, y), whole.value(full, x + x0, y + y0))
                        << "trial " << trial << ", " << channel.name << " at " << x + x0 << ',' << y + y0;
                }
            }
        }
    }
}

TEST(Abuffer, TheOrderOfTrianglesChangesOnlyTheirNumbers) {
    const Image one = draw(heap(3)), other = draw(heap(3, true));
    for (const Channel& c : one.channels()) {
        if (c.name == "id.polygon") continue;
        EXPECT_EQ(c.bytes, other.find(c.name)->bytes) << c.name;
    }
}

/// All decisions of a picture, both ways.
struct Comparison {
    int asked = 0, answered = 0, other_class = 0, other_place = 0;
    void operator+=(const Comparison& c) {
        asked += c.asked;
        answered += c.answered;
        other_class += c.other_class;
        other_place += c.other_place;
    }
};

/// Most are ordinary. Those that differ lie within rounding errors of a vertex or a tolerance.
void expect_agreement(const Comparison& sum, double least_answered) {
    testing::Test::RecordProperty("asked", sum.asked);
    testing::Test::RecordProperty("answered", sum.answered);
    EXPECT_GT(sum.answered, least_answered * sum.asked);
    EXPECT_LE(sum.other_class + sum.other_place, 0.002 * sum.answered)
        << sum.other_class << " of other classes, " << sum.other_place << " elsewhere, of " << sum.answered;
}

Comparison compare_decisions(const Scene& scene, int samples) {
    const Frame frame =
        make_frame(scene, perspective_camera(kEye, {0, 0, 0}), kWidth, kHeight, {0, 0, kWidth, kHeight});
    ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
    const TriangleBins bins(screen, frame.crop, samples, best_kernels(), 1);
    SurfaceTile tile(frame, screen, bins, samples, best_kernels());
    FastDecision fast(screen, frame.criteria);
    const std::int32_t pitch = kSubpixelsPerPixel / samples;
    Comparison result;
    const auto compare = [&](int column, int row, bool down) {
        const SampleTile& s = tile.samples();
        const std::size_t a = s.index(column, row), b = s.index(column + (down ? 0 : 1), row + (down ? 1 : 0));
        if (s.ids[a] >> 1 == s.ids[b] >> 1) return;
        ++result.asked;
        const NeighbourSamples pair{
            column * pitch + pitch / 2, row * pitch + pitch / 2, pitch, down, {tile.surface_at(a), tile.surface_at(b)}};
        LineDecision decision;
        double nearness = 0;
        if (!fast.is_smooth(pair) && !fast.decide(pair, decision, nearness)) return;
        ++result.answered;
        const glm::dvec2 trifle(0x1p-14, 0x1p-20);  // LineTile's
        const glm::dvec2 from = (glm::dvec2(column, row) + 0.5) / double(samples) + trifle;
        const glm::dvec2 to = from + (down ? glm::dvec2(0, 1) : glm::dvec2(1, 0)) / double(samples);
        const LineDecision slow =
            decide_line(frame.surfaces, {from, tile.surface_at(a)}, {to, tile.surface_at(b)}, frame.criteria);
        const LineClassSet classes = decision.classes & frame.criteria.classes;
        if (classes != (slow.classes & frame.criteria.classes)) {
            ++result.other_class;
        } else if (!classes.empty() && std::abs(decision.fraction - slow.fraction) > 0.01) {
            ++result.other_place;
        }
    };
    for (std::size_t t = 0; t < bins.tile_count(); ++t) {
        if (bins.is_empty(t)) continue;
        tile.draw(t);
        const SampleTile& s = tile.samples();
        for (int row = s.first_row; row + 1 < s.first_row + s.rows; ++row) {
            for (int column = s.first_column; column + 1 < s.first_column + s.columns; ++column) {
                compare(column, row, false);
                compare(column, row, true);
            }
        }
    }
    return result;
}

/// A drum as CAD programs hand it out: its wall and its ends are patches with steps of their own, not stitched. The
/// ends are fans of triangles.
Scene drum(int wall_steps, int end_steps) {
    PolygonSoup soup = soup_of({}, {});
    const auto on_circle = [](int i, int steps, double z) {
        const double angle = 2 * std::numbers::pi * i / steps;
        return glm::dvec3(std::cos(angle), std::sin(angle), z);
    };
    const auto number = [&] { return static_cast<std::uint32_t>(soup.positions.size()); };
    const std::uint32_t wall = number();
    for (int i = 0; i < wall_steps; ++i) {
        for (const double z : {-0.7, 0.7}) soup.positions.push_back(on_circle(i, wall_steps, z));
    }
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(wall_steps); ++i) {
        const std::uint32_t v = wall + 2 * i, w = wall + 2 * ((i + 1) % static_cast<std::uint32_t>(wall_steps));
        soup.add_polygon(std::vector<std::uint32_t>{v, w, w + 1, v + 1});
    }
    for (const double z : {-0.7, 0.7}) {
        const std::uint32_t middle = number();
        soup.positions.emplace_back(0.0, 0.0, z);
        for (int i = 0; i < end_steps; ++i) soup.positions.push_back(on_circle(i, end_steps, z));
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(end_steps); ++i) {
            const std::uint32_t a = middle + 1 + i, b = middle + 1 + (i + 1) % static_cast<std::uint32_t>(end_steps);
            soup.add_polygon(z < 0 ? std::vector<std::uint32_t>{middle, b, a}
                                   : std::vector<std::uint32_t>{middle, a, b});
        }
    }
    std::vector<PolygonSoup> objects;
    objects.push_back(std::move(soup));
    return scene_of(std::move(objects));
}

TEST(Abuffer, FastDecisionsFollowSeams) {
    Comparison sum;
    for (const auto& [wall_steps, end_steps] : {std::pair{40, 61}, {97, 64}, {50, 400}}) {
        for (const int samples : {2, 4}) {
            sum += compare_decisions(drum(wall_steps, end_steps), samples);
        }
    }
    expect_agreement(sum, 0.95);
}

TEST(Abuffer, SliversAreKnownToBeThin) {
    const Scene scene = drum(50, 20000);
    const Frame frame =
        make_frame(scene, perspective_camera(kEye, {0, 0, 0}), kWidth, kHeight, {0, 0, kWidth, kHeight});
    const Mesh& mesh = scene.meshes.at(0);
    const std::vector<std::uint8_t> table = find_sharp_edges(mesh, frame.criteria);
    EXPECT_EQ(find_sharp_edges(mesh, frame.criteria, 3), table);
    int slivers = 0, thin = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        thin += (table[t] & kThinTriangle) != 0;
        if (!is_sliver(frame.surfaces, {0, t})) continue;
        ++slivers;
        EXPECT_NE(table[t] & kThinTriangle, 0) << t;
    }
    EXPECT_GT(slivers, 1000);
    EXPECT_LE(thin, 40000);  // not the wall
}

TEST(Abuffer, FastDecisionsAreThoseOfTheSlowWay) {
    Comparison sum;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        Scene scene = heap(seed);
        if (seed % 2 == 0) scene.lines.classes = kDefaultLineClasses;
        sum += compare_decisions(scene, 2 << seed % 2);
    }
    expect_agreement(sum, 0.7);
}

/// A floor that goes on behind the eye ends where its borders are, not where samples are.
TEST(Abuffer, BordersThatPassTheEyeAreWhereTheyAre) {
    constexpr int kColumns = 240, kRows = 180;
    const Scene scene =
        scene_of({soup_of({{-250, 0, -250}, {250, 0, -250}, {250, 0, 250}, {-250, 0, 250}}, {{0, 1, 2, 3}})});
    const Camera camera = perspective_camera({0, 1, 2}, {0, 1, -10}, 90);
    const Drawing d(scene, camera, kColumns, kRows, {0, 0, kColumns, kRows}, 1, render_abuffer);
    EXPECT_EQ(d.sum(LineClass::silhouette), 0) << "it is open";
    const double focal_px = 0.5 * kRows;
    for (int x = 2; x < kColumns - 2; ++x) {
        double ink = 0, moment = 0;
        for (int y = 0; y < kRows; ++y) {
            ink += d.line(LineClass::border, x, y);
            moment += d.line(LineClass::border, x, y) * (y + 0.5);
        }
        const double beside = std::abs(x + 0.5 - 0.5 * kColumns);  // the far border, and those at the sides
        const double depth = std::min(252.0, 250 * focal_px / beside);
        ASSERT_NEAR(ink, 1, 0.02) << x;
        constexpr double kHalfARow = 1.0 / 32;  // of a stroke's mask
        ASSERT_NEAR(moment / ink, 0.5 * kRows + focal_px / depth, 1.1 * kHalfARow) << x;
    }
}

// However steep they are: between two samples both may be far from what is seen at either.
TEST(Abuffer, SheetsThatMeetInAValleyHaveTheirLine) {
    constexpr int kPx = 160;
    struct Sheet {
        int pieces;
        double beyond_px;  // the picture
    };
    for (const double slope : {1.0, 4.0, 8.0, 30.0}) {  // pixels' widths per pixel
        // One piece, small ones, and large ones without an end in the picture.
        for (const Sheet sheet : {Sheet{1, -20}, {20, -20}, {3, 120}}) {
            const int pieces = sheet.pieces;
            const double size = kPx + 2 * sheet.beyond_px;
            PolygonSoup soup;
            // Slightly turned, so that the line passes samples at any distance. Nearer to the eye on either side.
            const auto add_sheet = [&](double up) {
                const auto place = [&](int u, int v) {
                    const double x = size * u / pieces - sheet.beyond_px, y = size * v / pieces - sheet.beyond_px;
                    return glm::dvec3(x, y, up * slope * (x - 80.3 - 0.03 * y));
                };
                for (int u = 0; u < pieces; ++u) {
                    for (int v = 0; v < pieces; ++v) {
                        const auto first = static_cast<std::uint32_t>(soup.positions.size());
                        for (const glm::dvec3 p : {place(u, v), place(u + 1, v), place(u + 1, v + 1), place(u, v + 1)})
                            soup.positions.push_back(p);
                        soup.add_polygon(std::vector{first, first + 1, first + 2, first + 3});
                    }
                }
            };
            add_sheet(1);
            add_sheet(-1);
            Scene scene = scene_of({soup});
            scene.lines.classes = LineClass::intersection;
            const Camera camera = pixel_camera(kPx, kPx, 10000);
            const Drawing drawn(scene, camera, kPx, kPx, {0, 0, kPx, kPx}, 1, render_abuffer);
            EXPECT_NEAR(drawn.sum(LineClass::intersection), std::min<double>(size, kPx), 2) << slope << ", " << pieces;
        }
    }
}

/// The corners in the middle of a fan are often equal but for rounding. Triangles between them face any way.
TEST(Abuffer, AFlatFanHasNoContours) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        const int spokes = random.integer(5, 40);
        const double inner = std::pow(10.0, random.real(-9, -4));
        PolygonSoup soup;
        for (int i = 0; i < spokes; ++i) {
            const double angle = 2 * std::numbers::pi * i / spokes;
            const glm::dvec3 out(std::cos(angle), 0, std::sin(angle));
            soup.positions.insert(soup.positions.end(), {inner * out, 0.65 * out});
            const auto near = static_cast<std::uint32_t>(2 * i),
                       next = static_cast<std::uint32_t>(2 * ((i + 1) % spokes));
            soup.corners.insert(soup.corners.end(), {near, near + 1, next + 1, next});
            soup.polygon_ends.push_back(static_cast<std::uint32_t>(soup.corners.size()));
        }
        soup.object_names = {"fan"};
        const glm::dvec3 eye = 3.0 * random.direction();
        const Drawing d(scene_of({soup}), perspective_camera({eye.x, 0.5 + std::abs(eye.y), eye.z}, {0, 0, 0}), 180,
                        160, {0, 0, 180, 160}, 1, render_abuffer);
        EXPECT_LT(d.sum(LineClass::silhouette), 0.05) << "seed " << seed;  // a trace of a dot in the middle
        EXPECT_GT(d.sum(LineClass::border), 100) << "seed " << seed;
    }
}

/// A profile drawn out along x, in some pieces.
PolygonSoup drawn_out(const std::vector<glm::dvec2>& profile, double half_length, std::uint32_t pieces) {
    PolygonSoup soup;
    const auto rows = static_cast<std::uint32_t>(profile.size());
    for (std::uint32_t i = 0; i <= pieces; ++i) {
        for (const glm::dvec2 p : profile) soup.positions.emplace_back(half_length * (2.0 * i / pieces - 1), p.x, p.y);
    }
    for (std::uint32_t i = 0; i < pieces; ++i) {
        for (std::uint32_t k = i * rows; k + 1 < (i + 1) * rows; ++k) {
            soup.add_polygon(std::vector<std::uint32_t>{k, k + 1, k + 1 + rows, k + rows});
        }
    }
    soup.object_names = {"profile"};
    return soup;
}

/// A rounding narrower than a sample has no crease, though its strips are so low that each alone says nothing, and it
/// is no contour where both sides are seen.
TEST(Abuffer, FinelyRoundedEdgesHaveNoLine) {
    constexpr double kPixel = 3.0 / 120;
    for (const int strips : {60, 100, 150}) {
        for (const double radius_px : {0.3, 1.0}) {
            for (const double elevation : {2.0, 45.0, 80.0}) {
                const double r = radius_px * kPixel;
                std::vector<glm::dvec2> profile = {{0, -1}};
                for (int i = 0; i <= strips; ++i) {
                    const double a = 0.5 * std::numbers::pi * i / strips;
                    profile.emplace_back(r * std::cos(a) - r, r * std::sin(a) - r);
                }
                profile.emplace_back(-1, 0);
                const double e = glm::radians(elevation);
                const glm::dvec3 target(0, -0.2, -0.3),
                    eye = target + 10.0 * glm::dvec3(0.3 * std::cos(e), std::sin(e), std::cos(e));
                const Drawing d(scene_of({drawn_out(profile, 1.5, 1)}), perspective_camera(eye, target, 17), 160, 120,
                                {0, 0, 160, 120}, 1, render_abuffer);
                EXPECT_LT(d.sum("lines.A") - d.sum(LineClass::border), 0.5)
                    << strips << " " << radius_px << " " << elevation;
                EXPECT_GT(d.sum(LineClass::border), 100);
            }
        }
    }
}

/// Half of its facets lie between two samples.
TEST(Abuffer, RodsOfManyFacetsAreAsThickAsTheyAre) {
    constexpr double kPixel = 3.0 / 120;
    for (const int facets : {100, 400, 800}) {
        for (const double radius_px : {0.32, 0.8}) {
            const PolygonSoup rod = make_cylinder(radius_px * kPixel, radius_px * kPixel, 2, facets);
            const Drawing d(scene_of({rod}), perspective_camera({6.6, 2.4, 7.1}, {0, 0, 0}, 17), 160, 120,
                            {0, 0, 160, 120}, 1, render_abuffer);
            for (int y = 40; y < 80; ++y) {
                double ink = 0;
                for (int x = 0; x < 160; ++x) ink += d.line(x, y);
                ASSERT_NEAR(ink, std::min(2 * radius_px + 1, 2.0), 0.03) << facets << " " << radius_px << " row " << y;
            }
        }
    }
}

/// Whether a triangle is thin depends on where it is seen best, not on its first corner.
TEST(Abuffer, ALongStepIsDrawnLikeOneInPieces) {
    constexpr double kLength = 266;
    const std::vector<glm::dvec2> step = {{0, -kLength}, {0, 0}, {0.03, 0}, {0.03, kLength}};
    for (const double x : {-8.0, 8.0, 2.0}) {
        for (const double eye_x : {0.0, 150.0, -150.0}) {
            const auto draw_in = [&](std::uint32_t pieces) {
                const Camera camera = perspective_camera({eye_x, 0.8, -3}, {eye_x + x, 0, 0}, 60);
                return Drawing(scene_of({drawn_out(step, kLength, pieces)}), camera, 160, 120, {0, 0, 160, 120}, 1,
                               render_abuffer);
            };
            const Drawing one = draw_in(1), many = draw_in(20);
            double missed = 0;
            for (int y = 0; y < 120; ++y) {
                for (int k = 0; k < 160; ++k) missed += std::abs(one.line(k, y) - many.line(k, y));
            }
            EXPECT_LT(missed, 0.02 * many.sum("lines.A")) << x << " " << eye_x;
            EXPECT_GT(many.sum("lines.A"), 200);
        }
    }
}

// All empty tiles of a row are one piece of work, which may be megabytes.
TEST(Abuffer, BackgroundIsPutUntilThePictureIsStopped) {
    const Scene scene = heap(1);
    const Frame frame =
        make_frame(scene, perspective_camera(kEye, {0, 0, 0}), kWidth, kHeight, {0, 0, kWidth, kHeight});
    const ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
    const PixelFiller filler(frame, screen, best_kernels(), nullptr);
    Film film(frame.crop, frame.crop, {}, frame.criteria.classes);
    filler.clear(frame.crop, film);
    const StopFlag flag{true};
    const StopScope scope(flag);
    EXPECT_THROW(filler.clear(frame.crop, film), Interrupted);
}

}  // namespace
}  // namespace burin::abuffer_test
