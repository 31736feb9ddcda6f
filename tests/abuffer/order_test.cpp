// The order of polygons and vertices in a file says nothing about the picture: places found in models that people use,
// where rounding or a sliver decided.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "abuffer/screen/edge_on_screen.h"
#include "methods/abuffer.h"
#include "methods/reference/reference.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::order_test {
namespace {

using namespace test;

constexpr int kWidth = 960, kHeight = 540;

struct Place {
    PolygonSoup model;
    Camera camera;
    PixelRect crop;
    HiddenStyle hidden = HiddenStyle::none;
    StrokeSide side = StrokeSide::both;
    int width = kWidth, height = kHeight;
};

/// With vertices, polygons and the corners at which these begin in another order.
PolygonSoup shuffled(const PolygonSoup& soup, Random& random) {
    const auto order_of = [&](std::size_t count) {
        std::vector<std::uint32_t> order(count);
        std::iota(order.begin(), order.end(), 0u);
        for (std::size_t i = count; i > 1; --i)
            std::swap(order[i - 1], order[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
        return order;
    };
    const auto vertices = order_of(soup.positions.size());
    PolygonSoup other;
    std::vector<std::uint32_t> place(vertices.size());
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        place[vertices[i]] = i;
        other.positions.push_back(soup.positions[vertices[i]]);
    }
    for (const std::uint32_t p : order_of(soup.polygon_count())) {
        std::vector<std::uint32_t> corners;
        for (const std::uint32_t c : soup.polygon(p)) corners.push_back(place[c]);
        std::rotate(corners.begin(), corners.begin() + random.integer(0, static_cast<int>(corners.size()) - 1),
                    corners.end());
        other.add_polygon(corners);
    }
    return other;
}

Drawing draw(const Place& place, const PolygonSoup& soup, RenderFunction render) {
    Scene scene = scene_of({soup});
    scene.lines.style.hidden.style = place.hidden;
    scene.lines.style.side = place.side;
    return {scene, place.camera, place.width, place.height, place.crop, 1, render};
}

void expect_no_order(const Place& place) {
    constexpr std::uint64_t kSeed = 1;
    Random random(kSeed);
    const Drawing first = draw(place, place.model, render_abuffer);
    for (int i = 0; i < 12; ++i) {
        const Drawing other = draw(place, shuffled(place.model, random), render_abuffer);
        ASSERT_TRUE(first.coverage() == other.coverage()) << "seed " << kSeed << ", order " << i;
        if (place.hidden != HiddenStyle::none) {
            ASSERT_NEAR(first.sum("lines_hidden.A"), other.sum("lines_hidden.A"), 1e-9)
                << "seed " << kSeed << ", order " << i;
        }
    }
}

// A fold along a row, in a scan of a bunny: whether it is a contour is asked on its edge, not a rounding error beside
// it.
TEST(Order, OfAFoldAlongARow) {
    const PolygonSoup scan = soup_of({{-0.039692, 0.046080, -0.021311},
                                      {-0.038368, 0.045701, -0.022973},
                                      {-0.040577, 0.044749, -0.022307},
                                      {-0.038676, 0.046287, -0.021458},
                                      {-0.036602, 0.047282, -0.020391},
                                      {-0.037421, 0.046616, -0.021804},
                                      {-0.039968, 0.046140, -0.020328}},
                                     {{0, 1, 2}, {3, 4, 5}, {4, 3, 6}, {6, 3, 0}, {0, 3, 1}, {3, 5, 1}});
    const Camera camera = perspective_camera({-0.20992861778937022, -0.030415977444826187, -0.18356645441120056},
                                             {-0.0168405, 0.110154, -0.001537});
    expect_no_order({scan, camera, {470, 408, 492, 430}});
}

// A sheet ends beside a fold, in the plane of one of its faces and but for rounding: they have no more than a sliver of
// the screen in common, and the sheet hides nothing of the fold, whichever comes first.
TEST(Order, OfASheetThatEndsBesideAFold) {
    const Place place{soup_of({{-7.125843338384551, 13.199302844705768, -138.0},
                               {-7.125843338384551, 13.199302844705768, -117.00005340576172},
                               {-6.652282505164196, 13.444197782817085, -138.0},
                               {-7.159938284826399, 13.180889141758291, -116.52113342285156},
                               {-6.652282505164196, 13.444197782817085, -78.00010681152344},
                               {-4.113013380730036, 9.595997775627605, -138.0},
                               {-4.113013380730036, 9.595997775627605, -117.00005340576172},
                               {-7.162019450364598, 13.182628495379584, -116.52113342285156},
                               {-7.125877615537057, 13.199318936689245, -139.0},
                               {-7.125877615537057, 13.199318936689245, -114.0},
                               {-9.914961607792968, 16.53502676907031, -139.0}},
                              {{0, 1, 2}, {3, 4, 1}, {0, 5, 1}, {1, 6, 7}, {8, 9, 10}}),
                      perspective_camera({-342.126361009658, -666.4425823969442, -714.9608523234266},
                                         {-4.686157572564298e-05, -44.46499796407167, -5.999998380978454}),
                      {410, 140, 460, 180}};
    expect_no_order(place);
    const double ink = draw(place, place.model, render_abuffer).sum("lines.A");
    EXPECT_NEAR(ink, draw(place, place.model, render_reference).sum("lines.A"), 1);  // the fold has 6 of 43
}

// Borders of a teapot's spout within its body, in contact with two neighbours one after the other: no dot between the
// contacts.
TEST(Order, OfContactsThatMeet) {
    const PolygonSoup spout = soup_of({{0.000000, 1.037175, -1.992750},
                                       {0.000000, 1.178400, -1.972000},
                                       {0.323566, 1.178400, -1.946601},
                                       {-1.867631, 0.553725, 0.310439},
                                       {-1.922910, 0.656400, 0.319628},
                                       {-1.948000, 0.656400, 0.000000},
                                       {-1.892000, 0.553725, 0.000000},
                                       {-2.113050, 0.703463, 0.000000},
                                       {-1.900000, 0.600000, 0.000000},
                                       {-1.902800, 0.608400, 0.081000},
                                       {-1.910400, 0.631200, 0.144000},
                                       {-2.115967, 0.731578, 0.144000},
                                       {-2.113835, 0.711032, 0.081000}},
                                      {{0, 1, 2}, {3, 4, 5}, {5, 6, 3}, {7, 8, 9}, {10, 11, 12}, {12, 9, 10}});
    const Camera camera =
        perspective_camera({5.826264236871671, 2.793804647109596, -7.9993638867810315}, {0.217, 1.575, 0.0});
    expect_no_order({spout, camera, {596, 319, 618, 340}, HiddenStyle::solid});
}

// Strokes on one side of a rough ball's contour, at which one triangle is a wall seen nearly edge-on, on the other side
// of the edge than the surface: the surface says which side is which.
TEST(Order, OfAWallBehindAContour) {
    const PolygonSoup ball = soup_of({{1.0784982442855835, 0.4099586606025696, 1.6425725221633911},
                                      {1.0720760822296143, 0.4252711534500122, 1.5732669830322266},
                                      {1.0854066610336304, 0.3835430443286896, 1.5680179595947266},
                                      {1.0990792512893677, 0.3809163272380829, 1.5702377557754517},
                                      {1.0903856754302979, 0.47444990277290344, 1.5142865180969238},
                                      {1.1079907417297363, 0.45247650146484375, 1.583343505859375}},
                                     {{0, 1, 2}, {0, 2, 3}, {4, 3, 2}, {0, 3, 5}});
    const Camera camera =
        perspective_camera({-2.3748178074763104, -0.16716297688561355, -1.7383308488569554}, {1, 1, 1});
    for (const StrokeSide side : {StrokeSide::inside, StrokeSide::outside}) {
        expect_no_order({ball, camera, {0, 0, 64, 48}, HiddenStyle::none, side, 64, 48});
    }
}

// A strip of a scan, narrower than a pixel, whose surface ends at walls that lean back: they are not in front,
// whichever comes first.
TEST(Order, OfWallsThatLeanBack) {
    const PolygonSoup strip = soup_of({{0.008927, 0.159211, -0.0212875},
                                       {0.00927702, 0.159206, -0.0212875},
                                       {0.008927, 0.159388, -0.0209375},
                                       {0.00927702, 0.15938, -0.0209375},
                                       {0.008927, 0.159389, -0.0205875},
                                       {0.00927702, 0.159382, -0.0205875},
                                       {0.008927, 0.15926, -0.0202375},
                                       {0.00927702, 0.159208, -0.0202375}},
                                      {{0, 3, 1}, {0, 2, 3}, {2, 5, 3}, {2, 4, 5}, {4, 7, 5}, {4, 6, 7}});
    const Camera camera = perspective_camera({0.0141211, 0.15495125, 0.4153966}, {-0.0058789, 0.12495125, -0.0046034});
    for (const StrokeSide side : {StrokeSide::inside, StrokeSide::outside}) {
        expect_no_order({strip, camera, {0, 0, 64, 48}, HiddenStyle::none, side, 64, 48});
    }
}

/// Whoever asks; also where the screen does not say it: off the screen, and of an edge that is seen as a point.
TEST(Order, OfAnEdgesEndsIsOneForAll) {
    const PolygonSoup soup = soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 5}, {0, 0, 20}, {1, 0, 20}, {0, 1, 30}},
                                     {{0, 1, 2}, {0, 1, 3}, {4, 5, 6}});
    const Scene scene = scene_of({soup});
    const Frame frame = make_frame(scene, perspective_camera({0, 0, 10}, {0, 0, 0}), 64, 48, {0, 0, 64, 48});
    const ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
    const ScreenVertex* const v = screen.vertices(0);
    ASSERT_TRUE(v[0].x == v[3].x && v[0].y == v[3].y && v[4].x == ScreenVertex::kOffScreen &&
                v[6].x == ScreenVertex::kOffScreen);
    for (std::uint32_t a = 0; a < soup.positions.size(); ++a) {
        for (std::uint32_t b = 0; b < a; ++b) {
            const auto [first, second] = ends_in_order(screen, 0, a, b);
            EXPECT_EQ(ends_in_order(screen, 0, b, a), std::pair(first, second)) << a << ", " << b;
            EXPECT_LE(v[first].x, v[second].x) << a << ", " << b;
        }
    }
}

// Borders of two patches, hidden by a third one's: rounding must not depend on which of an edge's vertices
// has the smaller number.
TEST(Order, OfHiddenBorders) {
    const PolygonSoup patches = soup_of({{1.321973204612732, 1.1658313274383545, 1.6500877141952515},
                                         {1.6924697160720825, 0.9115604162216187, 1.4119840860366821},
                                         {1.5049262046813965, 0.9115604162216187, 1.249476671218872},
                                         {1.7623833417892456, 0.9115604162216187, 1.6500877141952515},
                                         {0.4513537883758545, 0.5466731190681458, 0.046009037643671036},
                                         {0.09732676297426224, 0.7327530980110168, -0.12920567393302917},
                                         {0.17388755083084106, 0.7945302724838257, -0.3327030539512634},
                                         {0.5279145836830139, 0.6084502935409546, -0.15748834609985352},
                                         {0.2504483163356781, 0.8563073873519897, -0.5362004041671753}},
                                        {{0, 1, 2}, {0, 3, 1}, {4, 5, 6}, {7, 6, 8}});
    const Camera camera = perspective_camera({3.4985394023802256, 1.7956707902104592, 4.657076543956843}, {1, 1, 1});
    expect_no_order({patches, camera, {0, 0, 64, 48}, HiddenStyle::solid, StrokeSide::both, 64, 48});
}

// Dashes of a hidden loop of intersections of two open boxes: its direction is told from where it leads, not from a
// rounding error at its beginning.
TEST(Order, OfDashesOnALoopOfIntersections) {
    const PolygonSoup boxes = soup_of({{0.9633804559707642, 0.5461980700492859, 1.0211864709854126},
                                       {1.5170626640319824, 0.5461980700492859, 1.0211864709854126},
                                       {1.5170626640319824, 0.8148892521858215, 1.0211864709854126},
                                       {0.9633804559707642, 0.8148892521858215, 1.0211864709854126},
                                       {0.9633804559707642, 0.8148892521858215, 0.12538374960422516},
                                       {1.5170626640319824, 0.8148892521858215, 0.12538374960422516},
                                       {1.5170626640319824, 0.5461980700492859, 0.12538374960422516},
                                       {1.0247840881347656, 0.6580300331115723, 0.9475802779197693},
                                       {1.0247840881347656, 0.9174270629882812, 0.9475802779197693},
                                       {1.9899392127990723, 0.9174270629882812, 0.9475802779197693},
                                       {1.9899392127990723, 0.6580300331115723, 0.9475802779197693},
                                       {1.9899392127990723, 0.6580300331115723, 1.293300986289978},
                                       {1.0247840881347656, 0.6580300331115723, 1.293300986289978},
                                       {1.0247840881347656, 0.9174270629882812, 1.293300986289978}},
                                      {{0, 1, 2},
                                       {0, 2, 3},
                                       {4, 3, 2},
                                       {4, 2, 5},
                                       {6, 5, 2},
                                       {6, 2, 1},
                                       {7, 8, 9},
                                       {7, 9, 10},
                                       {7, 10, 11},
                                       {7, 11, 12},
                                       {7, 12, 13},
                                       {7, 13, 8}});
    const Camera camera = perspective_camera({4.984774384940026, 2.0710398788598177, -0.7956744356975693}, {1, 1, 1});
    expect_no_order({boxes, camera, {0, 0, 64, 48}, HiddenStyle::dashed, StrokeSide::both, 64, 48});
}

}  // namespace
}  // namespace burin::order_test
