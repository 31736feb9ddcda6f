// Strokes with looks of their own, drawn over a film.

#include "strokes/ink_printer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/strokes/ink_picture.h"
#include "tests/support/random.h"

namespace burin::ink_printer_test {
namespace {

using namespace test;

constexpr double kPi = 3.14159265358979;
/// Half precision has 11 bits.
constexpr double kHalf = 1.0 / 2048;

/// A stroke that becomes nothing has the area of the cone, and what is thinner than masks show is as much lighter.
TEST(InkPrinter, TapersKeepTheirMassAtEveryDegree) {
    for (const float width : {0.5f, 1.0f, 2.0f, 3.5f, 8.0f}) {
        for (int degree = 0; degree < 360; degree += 1) {
            const double angle = glm::radians(static_cast<double>(degree)), length = 60,
                         r = 0.5 * static_cast<double>(width);
            const glm::dvec2 u(std::cos(angle), std::sin(angle)), from = glm::dvec2(72.37, 72.81) - 0.5 * length * u;
            InkPicture picture(144, 144);
            picture.only_lines = true;
            picture.add({InkPicture::point(from, width), InkPicture::point(from + length * u, 0)});
            const double theta = std::asin(r / length);
            const double mass = r * length * std::cos(theta) + r * r * (kPi / 2 + theta);
            ASSERT_NEAR(sum(picture.draw(), "lines.A"), mass, 0.005 * mass) << width << " px at " << degree << " deg";
        }
    }
}

/// In many pieces, as values that change make them.
TEST(InkPrinter, TapersOfManyPiecesKeepTheirMass) {
    for (int degree = 0; degree < 360; degree += 15) {
        const double angle = glm::radians(static_cast<double>(degree)), length = 60, r = 1.5;
        const glm::dvec2 u(std::cos(angle), std::sin(angle)), from = glm::dvec2(72.37, 72.81) - 0.5 * length * u;
        InkPicture picture(144, 144);
        std::vector<InkPoint> points;
        for (int i = 0; i <= 40; ++i)
            points.push_back(
                InkPicture::point(from + u * (length * i / 40), static_cast<float>(2 * r * (40 - i) / 40)));
        picture.add(points);
        const double theta = std::asin(r / length);
        const double mass = r * length * std::cos(theta) + r * r * (kPi / 2 + theta);
        EXPECT_NEAR(sum(picture.draw(), "lines.A"), mass, 0.005 * mass) << degree;
    }
}

TEST(InkPrinter, GradientsRunEvenlyAlongTheStroke) {
    for (const double degree : {0.0, 17.0, 45.0, 90.0, 133.0}) {
        for (const int pieces : {1, 25, 50}) {
            const double angle = glm::radians(degree), length = 200;
            const glm::dvec2 u(std::cos(angle), std::sin(angle)), from = glm::dvec2(130.3, 130.6) - 0.5 * length * u;
            InkPicture picture(260, 260);
            std::vector<InkPoint> points;
            for (int i = 0; i <= pieces; ++i) {
                const double s = length * i / pieces;
                points.push_back(
                    InkPicture::point(from + u * s, 6, 1, glm::vec3(static_cast<float>(s / length), 0, 0)));
            }
            picture.add(points);
            const Image image = picture.draw();
            int count = 0;
            for (int y = 0; y < 260; ++y) {
                for (int x = 0; x < 260; ++x) {
                    const double alpha = at(image, "lines.A", x, y),
                                 s = glm::dot(glm::dvec2(x + 0.5, y + 0.5) - from, u);
                    if (alpha < 0.05 || s < 1 || s > length - 1) continue;
                    ++count;
                    ASSERT_NEAR(at(image, "lines.R", x, y) / alpha, s / length, 1.0 / 512 + kHalf / 2)
                        << degree << " deg, " << pieces << " pieces";
                }
            }
            EXPECT_GT(count, 1000);
        }
    }
}

TEST(InkPrinter, TwoStrokesLetLightThroughEachAndOneDoesOnlyOnce) {
    for (const bool is_one : {false, true}) {
        InkPicture picture(64, 64);
        const float half = 0.5f;
        if (is_one) {
            picture.add({InkPicture::point({8, 8}, 9, half), InkPicture::point({56, 56}, 9, half),
                         InkPicture::point({56, 8}, 9, half), InkPicture::point({8, 56}, 9, half)});
        } else {
            picture.add({8, 8}, {56, 56}, 9, half);
            picture.add({56, 8}, {8, 56}, 9, half);
        }
        const Image image = picture.draw();
        EXPECT_NEAR(at(image, "lines.A", 32, 32), is_one ? 0.5 : 0.75, kHalf);
        EXPECT_NEAR(at(image, "lines.A", 32, 31), is_one ? 0.5 : 0.75, kHalf);
        EXPECT_NEAR(at(image, "R", 32, 32), is_one ? 0.5 : 0.25, kHalf);
        EXPECT_NEAR(at(image, "lines.A", 16, 16), 0.5, kHalf);
    }
}

TEST(InkPrinter, StrokesOfOneChainCountOnce) {
    InkPicture picture(64, 64);
    picture.add({8, 32}, {40, 32}, 9, 0.5f);
    picture.add({24, 32}, {56, 32}, 9, 0.25f).chain = 0;
    const Image image = picture.draw();
    EXPECT_NEAR(at(image, "lines.A", 32, 32), 0.5, kHalf);
    EXPECT_NEAR(at(image, "lines.A", 50, 32), 0.25, kHalf);
}

TEST(InkPrinter, OrderIsPriorityThenSeenThenSetThenClassThenNearnessThenChain) {
    const glm::vec3 red(1, 0, 0), green(0, 1, 0);
    const auto top_is_red = [&](const auto& change) {
        InkPicture picture(32, 32);
        // The second one lies below unless something changes that.
        picture.add({4, 4}, {28, 28}, 6, 1, green);
        picture.add({28, 4}, {4, 28}, 6, 1, red);
        change(picture.lines);
        const Image image = picture.draw();
        return at(image, "R", 16, 16) == 1 && at(image, "G", 16, 16) == 0;
    };
    const auto far = [](InkedLines& lines, std::size_t stroke) {
        for (std::size_t i = 0; i < 2; ++i) lines.points[lines.strokes[stroke].first_point + i].nearness = -200;
    };
    EXPECT_FALSE(top_is_red([](InkedLines&) {}));
    EXPECT_TRUE(top_is_red([](InkedLines& l) { l.strokes[0].chain = InkStroke::chain_of(5, 0); }));
    EXPECT_TRUE(top_is_red([&](InkedLines& l) { far(l, 0); }));
    EXPECT_FALSE(top_is_red([&](InkedLines& l) { far(l, 0), l.strokes[1].order.drawn_as = LineClass::crease; }));
    EXPECT_TRUE(top_is_red([&](InkedLines& l) { far(l, 1), l.strokes[0].order.drawn_as = LineClass::crease; }));
    EXPECT_TRUE(top_is_red(
        [&](InkedLines& l) { l.strokes[1].order.drawn_as = LineClass::crease, l.strokes[0].order.set = 1; }));
    EXPECT_TRUE(top_is_red([&](InkedLines& l) { l.strokes[1].order.set = 1, l.strokes[0].order.is_hidden = true; }));
    EXPECT_TRUE(top_is_red([&](InkedLines& l) { l.strokes[1].order.is_hidden = true, l.strokes[1].order.below = -1; }));
}

TEST(InkPrinter, MultipliedInkAddsNothing) {
    InkPicture picture(32, 32);
    picture.paper = {0.5f, 0.25f, 1.0f, 1.0f};
    picture.add({4, 4}, {28, 28}, 8, 1, {0, 1, 0});
    InkStroke& above = picture.add({28, 4}, {4, 28}, 8, 0.5f, {1, 0.5f, 0});
    above.blend = InkBlend::multiply;
    above.order.below = -1;
    const Image image = picture.draw();
    const auto expect = [&](int x, int y, glm::vec3 color) {
        EXPECT_NEAR(at(image, "R", x, y), color.r, kHalf);
        EXPECT_NEAR(at(image, "G", x, y), color.g, kHalf);
        EXPECT_NEAR(at(image, "B", x, y), color.b, kHalf);
        EXPECT_NEAR(at(image, "A", x, y), 1, kHalf);
    };
    expect(8, 24, {0.5f, 0.25f * 0.75f, 0.5f});  // over the surface
    expect(16, 16, {0, 0.75f, 0});               // over the other stroke
    expect(8, 8, {0, 1, 0});
    // On nothing it shows itself: the same on white paper, whichever way that is put below.
    picture.paper = glm::vec4(0.0f);
    const Image bare = picture.draw();
    picture.paper = glm::vec4(1.0f);
    const Image white = picture.draw();
    for (const char* c : {"R", "G", "B"}) {
        EXPECT_NEAR(at(bare, c, 8, 24) + 1 - at(bare, "A", 8, 24), at(white, c, 8, 24), kHalf);
        EXPECT_NEAR(at(bare, c, 16, 16) + 1 - at(bare, "A", 16, 16), at(white, c, 16, 16), kHalf);
    }
}

TEST(InkPrinter, SetsWithALayerHaveTheirStrokesAlone) {
    InkPicture picture(32, 32);
    picture.lines.layers = {"", "fine"};
    picture.add({4, 16}, {28, 16}, 6, 1, {1, 0, 0});
    picture.add({16, 4}, {16, 28}, 6, 1, {0, 1, 0}).order.set = 1;
    const Image image = picture.draw();
    EXPECT_EQ(at(image, "lines_fine.G", 16, 16), 1);
    EXPECT_EQ(at(image, "lines_fine.A", 16, 16), 1);
    EXPECT_EQ(at(image, "lines_fine.A", 8, 16), 0);
    EXPECT_EQ(at(image, "lines.R", 16, 16), 1);
    EXPECT_EQ(at(image, "lines.G", 16, 16), 0);
}

TEST(InkPrinter, HiddenStrokesLieBelowVisibleOnesAndAreAloneInTheirLayer) {
    InkPicture picture(32, 32);
    picture.add({4, 16}, {28, 16}, 6, 0.5f, {1, 0, 0});
    picture.add({16, 4}, {16, 28}, 6, 1, {0, 1, 0}).order.is_hidden = true;
    const Image image = picture.draw();
    EXPECT_NEAR(at(image, "lines.R", 16, 16), 0.5, kHalf);
    EXPECT_NEAR(at(image, "lines.G", 16, 16), 0, 0);
    EXPECT_NEAR(at(image, "lines.A", 16, 16), 0.5, kHalf);
    EXPECT_NEAR(at(image, "lines_hidden.G", 16, 16), 1, 0);
    EXPECT_NEAR(at(image, "R", 16, 16), 0.5, kHalf);
    EXPECT_NEAR(at(image, "G", 16, 16), 0.5, kHalf);
    EXPECT_NEAR(at(image, "B", 16, 16), 0, kHalf);
    EXPECT_NEAR(at(image, "coverage.silhouette", 16, 16), 0.5, kHalf);
}

TEST(InkPrinter, ButtCapsEndAtThePoint) {
    for (const int pieces : {1, 40}) {
        for (int degree = 0; degree < 180; degree += 20) {
            const double angle = glm::radians(static_cast<double>(degree)), length = 20;
            const glm::dvec2 u(std::cos(angle), std::sin(angle)), from = glm::dvec2(32.3, 32.8) - 0.5 * length * u;
            InkPicture picture(64, 64);
            std::vector<InkPoint> points;
            for (int i = 0; i <= pieces; ++i) points.push_back(InkPicture::point(from + u * (length * i / pieces), 6));
            picture.add(points).caps = StrokeCaps::butt;
            EXPECT_NEAR(sum(picture.draw(), "lines.A"), 6 * length, 0.3) << pieces << " pieces, " << degree << " deg";
        }
    }
}

/// How wide the gap is in a bar behind another one, which is farther by some pixels' widths.
double gap_px(double farther_px, double degree, bool perspective) {
    InkPicture picture(96, 96);
    picture.perspective = perspective;
    const double angle = glm::radians(degree), focal_px = picture.projection_focal_px(), depth = 100;
    const double farther = depth + farther_px * (perspective ? depth : 1) / focal_px;
    const auto add_bar = [&](glm::dvec2 along, float width_px, double at) -> InkStroke& {
        const glm::dvec2 middle(48.3, 47.9);
        InkPoint a = InkPicture::point(middle - 30.0 * along, width_px), b = a;
        b.place = middle + 30.0 * along;
        a.nearness = b.nearness = static_cast<float>(perspective ? 1 / at : -at);
        return picture.add({a, b});
    };
    const glm::dvec2 u(std::cos(angle), std::sin(angle));
    InkStroke& front = add_bar(u, 4, depth);
    front.halo_px = 3;
    front.halo_depth_px = {2, 50};
    front.order.drawn_as = LineClass::border;  // so that what is seen of the other one is known
    add_bar({-u.y, u.x}, 6, farther);
    return (60 * 6 + kPi * 9 - sum(picture.draw(), "coverage.silhouette")) / 6;
}

TEST(InkPrinter, HalosEraseWhatIsFartherAsWideAsTheyAre) {
    for (const bool perspective : {false, true}) {
        for (const double degree : {0.0, 30.0, 45.0, 77.0, 90.0}) {
            for (const double farther : {0.0, 1.0, 10.0, 26.0, 40.0, 60.0, 500.0}) {
                const double share = std::clamp((farther - 2) / 48, 0.0, 1.0);
                EXPECT_NEAR(gap_px(farther, degree, perspective), 4 + 2 * 3 * share, 1.0 / 16)
                    << farther << " px farther, " << degree << " deg" << (perspective ? ", perspective" : "");
            }
        }
    }
}

/// A line that two sets draw, one over the other, is not behind itself, whatever rounding says of its depth.
TEST(InkPrinter, HalosSpareOtherStrokesOfTheLine) {
    for (const bool is_one_line : {true, false}) {
        InkPicture picture(96, 96);
        InkStroke& casing = picture.add({18, 48}, {78, 48}, 6);
        casing.halo_px = 3;
        casing.halo_depth_px = {0, 10};
        casing.order.below = 1;
        const std::uint64_t chain = casing.chain;
        InkPoint a = InkPicture::point({18, 48}, 3), b = InkPicture::point({78, 48}, 3);
        a.nearness = b.nearness = -100.01f;
        InkStroke& fill = picture.add({a, b});
        fill.order.set = 1;
        fill.order.drawn_as = LineClass::border;
        if (is_one_line) fill.chain = chain;
        EXPECT_NEAR(sum(picture.draw(), "coverage.border"), is_one_line ? 60 * 3 + kPi * 2.25 : 0.0, 0.5);
    }
}

/// Each of several strokes that lie over each other loses as much as its own distance says, in whatever order they
/// come.
TEST(InkPrinter, HalosEraseEachStrokeBehindByItsOwnDistance) {
    struct Bar {
        std::uint32_t set;
        LineClass drawn_as;
        double farther_px;
    };
    std::vector<Bar> bars{{1, LineClass::border, 200}, {2, LineClass::crease, 26}, {3, LineClass::object, 1}};
    for (int turn = 0; turn < 3; ++turn) {
        std::rotate(bars.begin(), bars.begin() + 1, bars.end());
        InkPicture picture(96, 96);
        const double focal_px = picture.projection_focal_px();
        const auto add_bar = [&](glm::dvec2 along, float width_px, double farther_px) -> InkStroke& {
            const glm::dvec2 middle(48, 48);
            InkPoint a = InkPicture::point(middle - 30.0 * along, width_px), b = a;
            b.place = middle + 30.0 * along;
            a.nearness = b.nearness = static_cast<float>(-(100 + farther_px / focal_px));
            return picture.add({a, b});
        };
        for (const Bar& bar : bars) {
            InkStroke& stroke = add_bar({0, 1}, 6, bar.farther_px);
            stroke.order.set = bar.set;
            stroke.order.drawn_as = bar.drawn_as;
        }
        InkStroke& front = add_bar({1, 0}, 4, 0);
        front.halo_px = 8;
        front.halo_depth_px = {2, 50};
        const Image image = picture.draw();
        EXPECT_NEAR(60 * 6 + kPi * 9 - sum(image, "coverage.border"), 6 * (4 + 2 * 8), 0.25) << turn;
        EXPECT_NEAR(sum(image, "coverage.crease"), 6 * 2 * (8 - 4), 0.25) << turn;  // where the first one is erased
        EXPECT_NEAR(sum(image, "coverage.object"), 6 * 2 * 4, 0.25) << turn;        // where both are
    }
}

}  // namespace
}  // namespace burin::ink_printer_test
