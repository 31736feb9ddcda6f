// Dashes on visible lines: their lengths, where they begin, and what must not change them.

#include "lines/dashes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::dashes_test {
namespace {

using namespace test;

constexpr PixelRect kPicture{0, 0, 200, 200};

std::vector<LinePiece> polyline(const std::vector<glm::dvec2>& points) {
    std::vector<LinePiece> pieces;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        LinePiece s;
        s.from = points[i];
        s.to = points[i + 1];
        s.line = LineId{i};
        pieces.push_back(s);
    }
    return pieces;
}

std::vector<glm::dvec2> circle(double radius_px, int count) {
    std::vector<glm::dvec2> points;
    for (int i = 0; i < count; ++i) {
        const double a = 2 * std::numbers::pi * i / count;
        points.push_back(glm::dvec2(100.3, 100.7) + radius_px * glm::dvec2(std::cos(a), std::sin(a)));
    }
    points.push_back(points.front());
    return points;
}

using Ends = std::tuple<double, double, double, double>;
std::vector<Ends> sorted_ends(const std::vector<std::vector<LinePiece>>& lists) {
    std::vector<Ends> ends;
    for (const auto& list : lists) {
        for (const LinePiece& s : list) {
            const auto a = std::tuple(s.from.x, s.from.y), b = std::tuple(s.to.x, s.to.y);
            ends.push_back(std::tuple_cat(std::min(a, b), std::max(a, b)));
        }
    }
    std::sort(ends.begin(), ends.end());
    return ends;
}

/// Lengths of the connected parts, one after the other from the start of the chain.
std::vector<double> dash_lengths(const std::vector<LinePiece>& parts) {
    std::vector<double> lengths;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const double length = glm::distance(parts[i].from, parts[i].to);
        const bool goes_on = i > 0 && (glm::distance(parts[i].from, parts[i - 1].to) < 1e-9 ||
                                       glm::distance(parts[i].to, parts[i - 1].from) < 1e-9);
        if (goes_on)
            lengths.back() += length;
        else
            lengths.push_back(length);
    }
    return lengths;
}

TEST(VisibleDashes, OnACircleAreEqualWithoutASeam) {
    const auto parts = dashed({polyline(circle(40, 97))}, {8, 5}, 1, kPicture, {}, {});
    const std::vector<double> lengths = dash_lengths(parts[0]);
    EXPECT_EQ(lengths.size(), 19u);  // 251 / 13, rounded
    for (const double length : lengths) EXPECT_NEAR(length, lengths.front(), 1e-9);
    EXPECT_NEAR(lengths.front() + 1, 8, 0.2);  // with its round ends
}

TEST(VisibleDashes, OfAnOpenChainBeginAtItsHigherEnd) {
    const auto parts = dashed({polyline({{10, 50}, {10, 20}, {60, 20}, {60, 10}})}, {6, 4}, 2, kPicture, {}, {});
    ASSERT_FALSE(parts[0].empty());
    const LinePiece& first = parts[0].front();
    EXPECT_EQ(std::min(first.from.y, first.to.y), 11);  // half a pen's width from the end
    EXPECT_EQ(std::max(first.from.y, first.to.y), 15);
    const std::vector<double> lengths = dash_lengths(parts[0]);
    ASSERT_EQ(lengths.size(), 9u);                                     // 90 pixels
    for (const double length : lengths) EXPECT_NEAR(length, 4, 1e-9);  // also around the corners
}

TEST(VisibleDashes, TheOrderOfPiecesChangesNothing) {
    std::vector<LinePiece> pieces = polyline(circle(40, 97));
    for (const LinePiece& s : polyline({{100.3 + 40, 100.7}, {170, 120}, {180, 80}, {150, 20}})) pieces.push_back(s);
    const auto expected = sorted_ends(dashed({pieces}, {7, 3}, 1, kPicture, {}, {}));
    for (std::uint64_t trial = 0; trial < 20; ++trial) {
        Random random(trial);
        std::vector<std::vector<LinePiece>> lists(3);
        std::vector<LinePiece> rest = pieces;
        while (!rest.empty()) {
            const auto i = static_cast<std::size_t>(random.real(0, 1) * static_cast<double>(rest.size())) % rest.size();
            lists[rest.size() % 3].push_back(rest[i]);
            rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
        }
        EXPECT_EQ(sorted_ends(dashed(lists, {7, 3}, 1, kPicture, {}, {})), expected) << trial;
    }
}

TEST(VisibleDashes, HooksDoNotDotTheGaps) {
    std::vector<LinePiece> pieces = polyline({{10, 10}, {50, 10}});
    const auto expected = sorted_ends(dashed({pieces}, {6, 4}, 2, kPicture, {}, {}));
    for (const LinePiece& s : polyline({{19, 10}, {20, 10.5}})) pieces.push_back(s);
    EXPECT_EQ(sorted_ends(dashed({pieces}, {6, 4}, 2, kPicture, {}, {})), expected);
}

TEST(VisibleDashes, DotsAreRoundAndKeepTheirDirection) {
    const auto parts = dashed({polyline({{10, 10}, {50, 10}})}, {1, 4}, 3, kPicture, {}, {});
    ASSERT_EQ(parts[0].size(), 8u);
    for (const LinePiece& s : parts[0]) {
        EXPECT_NEAR(s.to.x - s.from.x, 1.0 / 256, 1e-9);
        EXPECT_EQ(s.to.y, s.from.y);
    }
}

constexpr int kSize = 200;

Scene dashed_scene(PolygonSoup soup) {
    Scene scene = scene_of({std::move(soup)});
    scene.lines.style.width_px = 2;
    scene.lines.style.dash_px = {8, 5};
    return scene;
}

Drawing drawing_of(const Scene& scene, glm::dvec3 eye, PixelRect crop = {0, 0, kSize, kSize}, int threads = 1) {
    return Drawing(scene, perspective_camera(eye, {0, 0, 0}), kSize, kSize, crop, threads, render_abuffer);
}

/// Along a circle around the picture's middle, in steps of 1/8 pixel: how much line there is across.
std::vector<double> ink_along(const Drawing& drawing, double radius_px) {
    std::vector<double> ink;
    const int steps = static_cast<int>(2 * std::numbers::pi * radius_px * 8);
    for (int i = 0; i < steps; ++i) {
        const double a = 2 * std::numbers::pi * i / steps;
        double sum = 0;
        for (double r = radius_px - 4; r < radius_px + 4; r += 0.25) {
            const glm::dvec2 p = glm::dvec2(kSize * 0.5) + r * glm::dvec2(std::cos(a), std::sin(a));
            sum += 0.25 * drawing.line(static_cast<int>(p.x), static_cast<int>(p.y));
        }
        ink.push_back(sum);
    }
    return ink;
}

TEST(VisibleDashes, OnTheContourOfASphereAreEqual) {
    const Drawing drawing = drawing_of(dashed_scene(make_sphere(0.5, 64, 32)), {0, 0, 2});
    const double sine = 0.25, focal_px = 0.5 * kSize / std::tan(17.5 * std::numbers::pi / 180);
    const double radius_px = focal_px * sine / std::sqrt(1 - sine * sine);
    std::vector<double> ink = ink_along(drawing, radius_px);
    const auto is_on = [&](std::size_t i) { return ink[i % ink.size()] > 1; };
    std::vector<double> dashes;
    std::size_t start = 0;
    while (is_on(start)) ++start;
    for (std::size_t i = start; i < start + ink.size();) {
        std::size_t end = i;
        while (is_on(end) && end < start + ink.size()) ++end;
        if (end > i) dashes.push_back(static_cast<double>(end - i) / 8);
        i = std::max(end, i + 1);
    }
    const double length = 2 * std::numbers::pi * radius_px;
    EXPECT_EQ(dashes.size(), static_cast<std::size_t>(std::round(length / 13)));
    std::size_t odd = 0;
    for (const double dash : dashes) odd += std::abs(dash - 8) > 1.2 ? 1 : 0;
    EXPECT_EQ(odd, 0u);
}

TEST(VisibleDashes, DotsHaveTwoSides) {
    Scene scene = dashed_scene(make_sphere(0.5, 64, 32));
    scene.lines.style.width_px = 6;
    scene.lines.style.dash_px = {3, 9};
    const auto ink = [&](StrokeSide side) {
        scene.lines.style.side = side;
        return drawing_of(scene, {0, 0, 2}).sum("lines.A");
    };
    const double whole = ink(StrokeSide::both);
    EXPECT_GT(whole, 900);
    EXPECT_NEAR(ink(StrokeSide::inside), 0.5 * whole, 0.05 * whole);
    EXPECT_NEAR(ink(StrokeSide::outside), 0.5 * whole, 0.05 * whole);
}

TEST(VisibleDashes, OfACubeBeginAtItsHigherCorners) {
    const Scene scene = dashed_scene(make_box({1, 1, 1}));
    const Drawing dashes = drawing_of(scene, {1.7, 1.3, 2.5});
    Scene plain = scene;
    plain.lines.style.dash_px.reset();
    const Drawing solid = drawing_of(plain, {1.7, 1.3, 2.5});
    const double share = dashes.sum("lines.A") / solid.sum("lines.A");
    EXPECT_NEAR(share, 8.0 / 13, 0.05);  // round ends take some, cut dashes add
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) ASSERT_LE(dashes.line(x, y), solid.line(x, y) + 1e-3);
    }
}

// A camera that moves by 1/32 pixel a frame moves dashes by as much, whichever samples see a corner.
TEST(VisibleDashes, AlongFeaturesStandStillInAnAnimation) {
    Scene scene = dashed_scene(make_cylinder(0.5, 0.5, 1, 8));
    Scene plain = scene;
    plain.lines.style.dash_px.reset();
    const auto change = [](const Drawing& a, const Drawing& b) {
        double sum = 0;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) sum += std::abs(a.line(x, y) - b.line(x, y));
        }
        return sum;
    };
    const auto frame = [](const Scene& s, int number) {
        const glm::dvec3 move = glm::dvec3(0.8, 0.5, -0.2) * (number * 0.0004);
        return Drawing(s, perspective_camera(glm::dvec3(1.2, 1.1, 2.3) + move, move), kSize, kSize,
                       {0, 0, kSize, kSize}, 1, render_abuffer);
    };
    for (int number = 0; number < 12; ++number) {
        const double of_dashes = change(frame(scene, number), frame(scene, number + 1));
        EXPECT_GT(of_dashes, 1) << number;
        EXPECT_LE(of_dashes, change(frame(plain, number), frame(plain, number + 1))) << number;
    }
}

// What passes in front takes nothing but what it covers.
TEST(VisibleDashes, AlongFeaturesGoOnBehindWhatIsInFront) {
    const PolygonSoup sheet = soup_of({{20, 100, 0}, {180, 100, 0}, {180, 160, 0}, {20, 160, 0}}, {{0, 1, 2, 3}});
    const PolygonSoup post = soup_of({{93, 90, 50}, {100, 90, 50}, {100, 110, 50}, {93, 110, 50}}, {{0, 1, 2, 3}});
    Scene alone = dashed_scene(sheet), covered = scene_of({sheet, post});
    covered.lines = alone.lines;
    const auto draw = [](const Scene& scene) {
        return Drawing(scene, pixel_camera(kSize, kSize), kSize, kSize, {0, 0, kSize, kSize}, 1, render_abuffer);
    };
    const Drawing a = draw(alone), b = draw(covered);
    for (int x = 10; x < 190; ++x) {
        if (x > 88 && x < 105) continue;
        for (int y = 98; y < 102; ++y) ASSERT_NEAR(a.line(x, y), b.line(x, y), 0.01) << x << ' ' << y;
    }
}

// A chain that ends in the vertex where it began runs the same way whichever triangle comes first.
TEST(VisibleDashes, OfALoopThatBranchesHangOnNoOrder) {
    const auto drawn = [](bool is_reversed) {
        PolygonSoup soup;  // two triangles with a corner in common, so that four borders meet there
        soup.positions = {{100, 100, 0}, {30, 40, 0}, {40, 160, 0}, {170, 150, 0}, {160, 30, 0}};
        std::vector<std::vector<std::uint32_t>> polygons{{0, 1, 2}, {0, 3, 4}};
        if (is_reversed) polygons = {{4, 0, 3}, {2, 0, 1}};
        for (const auto& polygon : polygons) soup.add_polygon(polygon);
        return Drawing(dashed_scene(soup), pixel_camera(kSize, kSize), kSize, kSize, {0, 0, kSize, kSize}, 1,
                       render_abuffer)
            .coverage();
    };
    EXPECT_EQ(drawn(false), drawn(true));
}

TEST(VisibleDashes, DependOnThePictureOnly) {
    Scene scene = dashed_scene(make_torus(0.6, 0.25, 40, 20));
    const glm::dvec3 eye(0.4, 1.6, 2.1);
    const Drawing whole = drawing_of(scene, eye);
    EXPECT_TRUE(same_bits(whole.image(), drawing_of(scene, eye, {0, 0, kSize, kSize}, 5).image()));
    const PixelRect crop{71, 60, 133, 122};
    const Drawing part = drawing_of(scene, eye, crop);
    for (int y = crop.y0; y < crop.y1; ++y) {
        for (int x = crop.x0; x < crop.x1; ++x) ASSERT_EQ(part.line(x - crop.x0, y - crop.y0), whole.line(x, y));
    }
    PolygonSoup soup = make_torus(0.6, 0.25, 40, 20), turned;
    turned.positions = soup.positions;
    for (std::size_t p = soup.polygon_count(); p-- > 0;) turned.add_polygon(soup.polygon(p));
    turned.object_names = soup.object_names;
    const Drawing other = drawing_of(dashed_scene(turned), eye);
    EXPECT_EQ(whole.coverage(), other.coverage());
}

}  // namespace
}  // namespace burin::dashes_test
