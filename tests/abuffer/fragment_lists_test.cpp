#include "abuffer/masks/fragment_lists.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace burin::fragment_lists_test {
namespace {

using test::Random;

ScreenPolygon random_triangle(Random& random, int size_px) {
    ScreenPolygon p;
    p.count = 3;
    for (std::size_t k = 0; k < 3; ++k) {
        p.corners[k] = {random.integer(-512, 256 * size_px), random.integer(-512, 256 * size_px)};
    }
    return p;
}

/// Every mask must be the window of the global grid of samples that its pixel sees.
template <typename Mask>
void check_windows(int apron) {
    constexpr int kSize = 9;
    const ExtendedGrid grid{mask_side<Mask>, apron};
    for (int trial = 0; trial < 60; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const ScreenPolygon polygon = random_triangle(random, kSize);
        const ScanConverter scan(polygon, grid.samples_per_pixel());
        const auto covered = [&](int row, int column) {
            if (row < scan.first_row() || row >= scan.end_row()) return false;
            const SampleSpan span = scan.span(row);
            return column >= span.begin && column < span.end;
        };
        FragmentLists<Mask> lists;
        lists.reset(grid, 1, 2, kSize, kSize);
        lists.add(scan, 42);
        lists.finish();
        for (int y = 2; y < kSize; ++y) {
            for (int x = 1; x < kSize; ++x) {
                Mask expected{};
                for (int row = 0; row < mask_side<Mask>; ++row) {
                    for (int column = 0; column < mask_side<Mask>; ++column) {
                        if (covered(grid.first_sample(y) + row, grid.first_sample(x) + column)) {
                            MaskGrid<Mask>::set_row(expected, row, 1u << column);
                        }
                    }
                }
                const auto fragments = lists.at(x, y);
                if (expected == Mask{}) {
                    ASSERT_TRUE(fragments.empty()) << trial << ": " << x << "," << y;
                } else {
                    ASSERT_EQ(fragments.size(), 1u) << trial << ": " << x << "," << y;
                    ASSERT_EQ(fragments[0].mask, expected);
                    ASSERT_EQ(fragments[0].surface, 42u);
                }
            }
        }
    }
}

TEST(FragmentLists, MasksAreWindowsOfTheGlobalGridAndTheirAprons) {
    check_windows<std::uint16_t>(1);
    check_windows<std::uint64_t>(1);
    check_windows<std::uint64_t>(2);
    check_windows<std::uint64_t>(3);
    check_windows<Mask256>(2);
    check_windows<Mask256>(4);
    check_windows<Mask256>(7);
}

TEST(FragmentLists, KeepTheOrderOfTheSurfaces) {
    ScreenPolygon big;
    big.count = 3;
    big.corners = {{{-5000, -5000}, {9000, -5000}, {-5000, 9000}}};
    const ExtendedGrid grid{8, 2};
    FragmentLists<std::uint64_t> lists;
    lists.reset(grid, 0, 0, 4, 4);
    for (std::uint32_t i = 0; i < 5; ++i) lists.add(ScanConverter(big, 4), i);
    lists.finish();
    const auto list = lists.at(0, 0);
    ASSERT_EQ(list.size(), 5u);
    for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(list[i].surface, i);
}

TEST(ExtendedGrid, WidthsFollowTheTableOfMaskSizes) {
    EXPECT_DOUBLE_EQ(grid_for_width(4, 1).stroke_width_px(), 1);
    EXPECT_DOUBLE_EQ(grid_for_width(8, 1).stroke_width_px(), 1);
    EXPECT_DOUBLE_EQ(grid_for_width(16, 1).stroke_width_px(), 1);
    EXPECT_DOUBLE_EQ(grid_for_width(8, 0.3).stroke_width_px(), 1.0 / 3);
    EXPECT_DOUBLE_EQ(grid_for_width(16, 0.1).stroke_width_px(), 1.0 / 7);
    EXPECT_DOUBLE_EQ(grid_for_width(8, 100).stroke_width_px(), 3);
    EXPECT_EQ(grid_for_width(16, 1).samples_per_pixel(), 8);
}

}  // namespace
}  // namespace burin::fragment_lists_test
