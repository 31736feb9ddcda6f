// Paths of strokes: what is averaged, cut and made longer.

#include "shading/ink/stroke_path.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace burin {
namespace {

PathPoint point(double at, float width) {
    PathPoint p;
    p.at_px = at;
    p.ink.place = {at, 0};
    p.ink.width_px = width;
    return p;
}

double length_of(const StrokePath& path) { return path.back().at_px - path.front().at_px; }

/// A mean lies within what it is of, also where pieces overlap a little and a path goes back by rounding.
TEST(StrokePath, AveragesStayWithinWhatIsAveraged) {
    for (std::uint64_t trial = 0; trial < 500; ++trial) {
        test::Random random(trial);
        StrokePath path;
        double at = 0;
        float least = 100, most = 0;
        for (int i = random.integer(2, 30); i > 0; --i) {
            path.push_back(point(at, static_cast<float>(random.real(0.5, 4))));
            least = std::min(least, path.back().ink.width_px);
            most = std::max(most, path.back().ink.width_px);
            at += random.integer(0, 2) == 0 ? random.real(-0.3, 1e-12) : random.real(0, 9);
        }
        smooth_ink(path, random.real(0.1, 30), random.integer(0, 1) == 0);
        for (const PathPoint& p : path) {
            ASSERT_GE(p.ink.width_px, least) << trial;
            ASSERT_LE(p.ink.width_px, most) << trial;
        }
    }
}

/// A last part of a hair's length may run anywhere: the line goes on as its last pixels do.
TEST(StrokePath, GrowsInTheDirectionOfItsLastPixels) {
    for (const bool is_first : {false, true}) {
        StrokePath path = {point(0, 1), point(50, 1), point(50.05, 1)};
        path.back().ink.place = {50, 0.05};
        if (is_first) {
            std::swap(path.front().ink.place, path.back().ink.place);
            path[1].at_px = 0.05;
        }
        lengthen_end(path, is_first, 10);
        const InkPoint& end = is_first ? path.front().ink : path.back().ink;
        EXPECT_NEAR(end.place.x, 60, 0.1);
        EXPECT_NEAR(end.place.y, 0.05, 0.2);
    }
}

TEST(StrokePath, AveragesOfAStepAreARamp) {
    StrokePath path = {point(0, 1), point(50, 1), point(50, 3), point(100, 3)};
    smooth_ink(path, 10, false);
    for (const PathPoint& p : path) {
        const double wanted = 1 + 2 * std::clamp((p.at_px - 40) / 20, 0.0, 1.0);
        EXPECT_NEAR(static_cast<double>(p.ink.width_px), wanted, 1e-4) << p.at_px;
    }
}

TEST(StrokePath, DashesHaveTheLengthsOfThePattern) {
    const StrokePath path = {point(0, 2), point(100, 2)};
    std::vector<StrokePath> dashes;
    const auto keep = [&](const StrokePath& dash) { dashes.push_back(dash); };
    for_dashes(path, {{8, 4, 2, 6}, 0, false}, 0, keep);
    ASSERT_EQ(dashes.size(), 10u);
    for (std::size_t i = 0; i < dashes.size(); ++i) {
        EXPECT_NEAR(dashes[i].front().at_px, static_cast<double>(i / 2) * 20 + (i % 2 == 0 ? 0 : 12), 1e-9);
        EXPECT_NEAR(length_of(dashes[i]), i % 2 == 0 ? 8 : 2, 1e-9);
    }
    dashes.clear();
    for_dashes(path, {{8, 4}, 0, true}, 0, keep);
    EXPECT_NEAR(length_of(dashes[1]), 6, 1e-9) << "with the round ends of a pen of 2 px, 8";
    EXPECT_NEAR((DashPattern{{8, 4, 2, 6}, 0, true}.share()), 0.5, 1e-12);
}

TEST(StrokePath, EndsBecomeLongerAndShorter) {
    StrokePath path = {point(0, 1), point(10, 1)};
    lengthen_end(path, true, 3);
    lengthen_end(path, false, -4);
    EXPECT_NEAR(path.front().ink.place.x, -3, 1e-9);
    EXPECT_NEAR(path.back().ink.place.x, 6, 1e-9);
    lengthen_end(path, true, -20);
    EXPECT_TRUE(path.empty());
}

}  // namespace
}  // namespace burin
