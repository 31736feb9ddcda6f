#include "view/polygon_sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/polygon_rect.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

/// Corners of a convex polygon in order, of either winding: some points of a circle or an ellipse, snapped.
ScreenPolygon random_polygon(Random& random, int reach) {
    ScreenPolygon polygon;
    polygon.count = random.integer(3, ScreenPolygon::kMaxCorners);
    std::vector<double> angles;
    for (int i = 0; i < polygon.count; ++i) angles.push_back(random.real(0, 6.283185307179586));
    std::sort(angles.begin(), angles.end());
    if (random.integer(0, 1) != 0) std::reverse(angles.begin(), angles.end());
    const double width = random.real(1, reach), height = random.real(1, reach), x = random.real(-reach, reach),
                 y = random.real(-reach, reach);
    for (int i = 0; i < polygon.count; ++i) {
        const double angle = angles[static_cast<std::size_t>(i)];
        polygon.corners[static_cast<std::size_t>(i)] = {static_cast<int>(x + width * std::cos(angle)),
                                                        static_cast<int>(y + height * std::sin(angle))};
    }
    return polygon;
}

TEST(PolygonSides, NeverLeaveOutWhatThePolygonTouches) {
    int left_out = 0, beside = 0;
    for (int trial = 0; trial < 100000; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const int reach = trial % 4 == 0 ? 12 : trial % 4 == 1 ? 16000000 : 6000;
        const ScreenPolygon polygon = random_polygon(random, reach);
        const int x = random.integer(-reach, reach), y = random.integer(-reach, reach);
        const int right = x + random.integer(0, reach / 2), bottom = y + random.integer(0, reach / 2);
        const bool is_out = PolygonSides(polygon).leave_out(x, y, right, bottom);
        const bool is_touched = test::touches(polygon, {x, y}, {right, bottom});
        ASSERT_FALSE(is_out && is_touched) << "trial " << trial;
        left_out += is_out ? 1 : 0;
        beside += is_touched ? 0 : 1;
    }
    EXPECT_GT(left_out, beside / 2);  // the rest lies beside the box
}

TEST(PolygonSides, LeaveOutWhatLiesBesideALongTriangle) {
    ScreenPolygon sliver;
    sliver.count = 3;
    sliver.corners[0] = {0, 0};
    sliver.corners[1] = {25600, 25500};
    sliver.corners[2] = {25500, 25600};
    const PolygonSides sides(sliver);
    for (int row = 0; row < 25; ++row) {
        for (int column = 0; column < 25; ++column) {
            const bool is_out = sides.leave_out(1024 * column, 1024 * row, 1024 * (column + 1), 1024 * (row + 1));
            EXPECT_EQ(is_out, std::abs(row - column) > 1) << row << ", " << column;
        }
    }
}

}  // namespace
}  // namespace burin
