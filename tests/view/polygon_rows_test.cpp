#include "view/polygon_rows.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/polygon_rect.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

TEST(PolygonRows, TellWhatAPolygonTouchesOfARow) {
    int touched = 0, beside = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const int reach = trial % 2 == 0 ? 40 : 100000;
        ScreenPolygon polygon;
        std::array<PolygonRows::Corner, 3> corners;
        polygon.count = 3;
        for (std::size_t k = 0; k < 3; ++k) {
            polygon.corners[k] = {random.integer(-reach, reach), random.integer(-reach, reach)};
            corners[k] = {static_cast<double>(polygon.corners[k].x), static_cast<double>(polygon.corners[k].y)};
        }
        const int top = random.integer(-reach, reach), bottom = top + random.integer(0, reach / 4);
        const PolygonRows::Range range = PolygonRows(corners).between(top, bottom);
        // Where it is cut into columns, these are touched that the range reaches.
        for (int i = 0; i < 20; ++i) {
            const int left = random.integer(-reach, reach), right = left + random.integer(0, reach / 8);
            const bool is_touched = test::touches(polygon, {left, top}, {right, bottom});
            const bool is_in_range = !range.is_empty() && range.low <= right + 1e-6 && range.high >= left - 1e-6;
            ASSERT_FALSE(is_touched && !is_in_range) << "trial " << trial;
            // Convex: it has no gaps, so nothing more is in the range.
            const bool has_area = left < right && top < bottom;  // else the other test may round it away
            const bool is_surely_in_range =
                has_area && !range.is_empty() && range.low <= right - 1e-6 && range.high >= left + 1e-6;
            if (is_surely_in_range) {
                ASSERT_TRUE(is_touched) << "trial " << trial;
            }
            ++(is_touched ? touched : beside);
        }
    }
    EXPECT_GT(touched, 10000);
    EXPECT_GT(beside, 10000);
}

TEST(PolygonRows, RowsBesideAreEmpty) {
    const std::array<PolygonRows::Corner, 2> line{{{0, 0}, {100, 50}}};
    const PolygonRows rows(line);
    EXPECT_TRUE(rows.between(51, 60).is_empty());
    EXPECT_TRUE(rows.between(-9, -1).is_empty());
    EXPECT_EQ(rows.between(10, 20).low, 20);
    EXPECT_EQ(rows.between(10, 20).high, 40);
    EXPECT_EQ(rows.between(-1e9, 1e9).high, 100);
    const std::array<PolygonRows::Corner, 2> level{{{7, 3}, {-4, 3}}};
    EXPECT_EQ(PolygonRows(level).between(3, 3).low, -4);
    EXPECT_EQ(PolygonRows(level).between(0, 3).high, 7);
}

}  // namespace
}  // namespace burin
