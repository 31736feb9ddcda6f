#include "abuffer/coverage_mask.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <vector>

#include "abuffer/masks/mask_grid.h"
#include "tests/support/random.h"

namespace burin::coverage_mask_test {
namespace {

using test::Random;

static_assert(halo(0x0660) == 0x6996, "plain numbers are 16-bit masks");
static_assert(edge_between(0x3333, 0xCCCC) == 0x6666);
static_assert(halo(std::uint64_t{1}) == 0x0102);

/// A mask as what it means: a square of truths.
struct Square {
    int side;
    std::vector<bool> set;
    bool at(int row, int column) const {
        return row >= 0 && column >= 0 && row < side && column < side &&
               set[static_cast<std::size_t>(row * side + column)];
    }
};

template <typename Mask>
Square square_of(const Mask& mask) {
    Square s{mask_side<Mask>, {}};
    for (int row = 0; row < s.side; ++row) {
        for (int column = 0; column < s.side; ++column) {
            s.set.push_back(MaskGrid<Mask>::get(mask, row, column));
        }
    }
    return s;
}

/// The definition: not set, but a set sample within `steps` steps to the sides.
Square halo_by_definition(const Square& s, int steps) {
    Square result{s.side, {}};
    for (int row = 0; row < s.side; ++row) {
        for (int column = 0; column < s.side; ++column) {
            bool near = false;
            for (int dy = -steps; dy <= steps; ++dy) {
                const int reach = steps - std::abs(dy);
                for (int dx = -reach; dx <= reach; ++dx) near = near || s.at(row + dy, column + dx);
            }
            result.set.push_back(near && !s.at(row, column));
        }
    }
    return result;
}

Square edge_by_definition(const Square& front, const Square& back, int steps) {
    Square visible_back = back;
    for (std::size_t i = 0; i < back.set.size(); ++i) visible_back.set[i] = back.set[i] && !front.set[i];
    const Square from_front = halo_by_definition(front, steps);
    const Square from_back = halo_by_definition(visible_back, steps);
    Square result = front;
    for (std::size_t i = 0; i < back.set.size(); ++i) {
        result.set[i] = (from_front.set[i] && visible_back.set[i]) || (from_back.set[i] && front.set[i]);
    }
    return result;
}

template <typename Mask>
Mask random_mask(Random& random) {
    // Densities from nearly empty to nearly full, so that every kind of neighbourhood occurs.
    const int density = random.integer(1, 15);
    Mask mask{};
    for (int row = 0; row < mask_side<Mask>; ++row) {
        unsigned bits = 0;
        for (int column = 0; column < mask_side<Mask>; ++column) {
            bits |= static_cast<unsigned>(random.integer(0, 15) < density) << column;
        }
        MaskGrid<Mask>::set_row(mask, row, bits);
    }
    return mask;
}

template <typename Mask>
class MaskOfAnySize : public testing::Test {};
using MaskTypes = testing::Types<std::uint16_t, std::uint64_t, Mask256>;
TYPED_TEST_SUITE(MaskOfAnySize, MaskTypes);

TYPED_TEST(MaskOfAnySize, HaloAndEdgeFollowTheirDefinitionForAllSteps) {
    for (int trial = 0; trial < 400; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const auto front = random_mask<TypeParam>(random), back = random_mask<TypeParam>(random);
        for (int steps = 1; steps <= mask_side<TypeParam> / 2; ++steps) {
            ASSERT_EQ(square_of(halo(front, steps)).set, halo_by_definition(square_of(front), steps).set)
                << "trial " << trial << ", steps " << steps << "\n"
                << mask_picture(front);
            ASSERT_EQ(square_of(edge_between(front, back, steps)).set,
                      edge_by_definition(square_of(front), square_of(back), steps).set)
                << "trial " << trial << ", steps " << steps << "\n"
                << mask_picture(front) << mask_picture(back);
        }
    }
}

TYPED_TEST(MaskOfAnySize, HaloOfNothingAndOfAllIsEmpty) {
    EXPECT_EQ(halo(TypeParam{}, 3), TypeParam{});
    EXPECT_EQ(halo(full_mask<TypeParam>(), 3), TypeParam{});
}

TEST(Mask16, HaloFollowsItsDefinitionForAllMasks) {
    for (unsigned m = 0; m < 65536; ++m) {
        const auto mask = static_cast<std::uint16_t>(m);
        ASSERT_EQ(square_of(halo(mask)).set, halo_by_definition(square_of(mask), 1).set) << mask_picture(mask);
    }
}

TEST(Mask16, HalosHaveTheKnownSumHistogramAndChecksum) {
    const std::array<int, 13> expected = {2, 16, 128, 648, 2516, 6976, 13968, 18840, 15356, 6040, 1004, 40, 2};
    std::array<int, 13> histogram{};
    int sum = 0;
    // The published checksum starts from this number; FNV's own offset basis has one digit more.
    std::uint64_t fnv1a = 1469598103934665603u;
    for (unsigned m = 0; m < 65536; ++m) {
        const std::uint16_t h = halo(static_cast<std::uint16_t>(m));
        sum += std::popcount(h);
        ++histogram[static_cast<std::size_t>(std::popcount(h))];
        fnv1a = (fnv1a ^ (h & 0xFFu)) * 0x100000001B3u;
        fnv1a = (fnv1a ^ static_cast<unsigned>(h >> 8)) * 0x100000001B3u;
    }
    EXPECT_EQ(sum, 450560);
    EXPECT_EQ(histogram, expected);
    EXPECT_EQ(fnv1a, 0xB015F23D41F6AEA3u);
}

TEST(Mask16, HaloIsDisjointAndEmptyOnlyForNothingAndAll) {
    for (unsigned m = 0; m < 65536; ++m) {
        const std::uint16_t h = halo(static_cast<std::uint16_t>(m));
        ASSERT_EQ(h & m, 0u);
        ASSERT_EQ(h == 0, m == 0 || m == 0xFFFF) << m;
    }
}

TEST(Mask16, CornersNeverReachTheInnerSamples) {
    constexpr unsigned kInner = 0x0660, kCorners = 0x9009;
    for (unsigned m = 0; m < 65536; ++m) {
        const auto mask = static_cast<std::uint16_t>(m);
        const auto without = static_cast<std::uint16_t>(m & ~kCorners);
        ASSERT_EQ(halo(mask) & kInner, halo(without) & kInner);
    }
    EXPECT_EQ(inner_samples<std::uint16_t>(1), kInner);
}

TEST(Mask16, PublishedFixtures) {
    EXPECT_EQ(edge_between(0x1111, 0xEEEE), 0x3333);
    EXPECT_EQ(edge_between(0x7777, 0x8888), 0xCCCC);
    EXPECT_EQ(edge_between(0x00FF, 0xFF00), 0x0FF0);
    EXPECT_EQ(edge_between(0x137F, 0xFFFF), 0x36C8);
    EXPECT_EQ(edge_between(0x0137, 0xFFFF), 0x136C);
    EXPECT_EQ(edge_between(0x0020, 0xFFFF), 0x0272);
    EXPECT_EQ(edge_between(0x0001, 0x0020), 0) << "diagonal contact";
    EXPECT_EQ(edge_between(0x0001, 0x0003), 0x0003);
    EXPECT_EQ(edge_between(0x0003, 0x0001), 0);
    EXPECT_EQ(halo(0x0001), 0x0012);
    EXPECT_EQ(halo(0x0008), 0x0084);
    EXPECT_EQ(halo(0x5A5A), 0xA5A5);
}

TEST(Mask16, EdgeOfDisjointMasksIsSymmetric) {
    // All 3^16 pairs: every sample belongs to the one, the other, or neither.
    std::uint64_t pairs = 0;
    for (unsigned both = 0; both < 65536; ++both) {
        for (unsigned a = both;; a = (a - 1) & both) {
            const auto f = static_cast<std::uint16_t>(a), b = static_cast<std::uint16_t>(both & ~a);
            if (edge_between(f, b) != edge_between(b, f)) FAIL() << f << " " << b;
            ++pairs;
            if (a == 0) break;
        }
    }
    EXPECT_EQ(pairs, 43046721u);
}

TEST(Mask16, EdgeOfAnEdgeIsItself) {
    Random random(1);
    for (int trial = 0; trial < 200000; ++trial) {
        const auto f = static_cast<std::uint16_t>(random.bits()), b = static_cast<std::uint16_t>(random.bits());
        const std::uint16_t e = edge_between(f, b);
        const auto front = static_cast<std::uint16_t>(e & f), back = static_cast<std::uint16_t>(e & b & ~f);
        ASSERT_EQ(edge_between(front, back), e) << f << " " << b;
        // Monotone in the back mask.
        const auto more = static_cast<std::uint16_t>(b | random.bits());
        ASSERT_EQ(e & ~edge_between(f, more), 0) << f << " " << b << " " << more;
    }
}

/// Samples of one global grid, and pixels' masks as windows of it.
template <typename Mask>
void check_seams(int apron) {
    constexpr int kSide = mask_side<Mask>;
    const int own = kSide - 2 * apron;
    constexpr int kSize = 64;
    for (int trial = 0; trial < 40; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const int density = random.integer(1, 15);
        Square front{kSize, {}}, back{kSize, {}};
        for (int i = 0; i < kSize * kSize; ++i) {
            front.set.push_back(random.integer(0, 15) < density);
            back.set.push_back(random.integer(0, 15) < 8);
        }
        const Square edge = edge_by_definition(front, back, apron);
        const auto window = [](const Square& s, int row0, int column0) {
            Mask mask{};
            for (int row = 0; row < kSide; ++row) {
                unsigned bits = 0;
                for (int c = 0; c < kSide; ++c) {
                    bits |= static_cast<unsigned>(s.at(row0 + row, column0 + c)) << c;
                }
                MaskGrid<Mask>::set_row(mask, row, bits);
            }
            return mask;
        };
        const Mask inner = inner_samples<Mask>(apron);
        for (int y = 0; y + own <= kSize; y += own) {
            for (int x = 0; x + own <= kSize; x += own) {
                const Mask e =
                    edge_between(window(front, y - apron, x - apron), window(back, y - apron, x - apron), apron);
                ASSERT_EQ(static_cast<Mask>(e & inner), static_cast<Mask>(window(edge, y - apron, x - apron) & inner))
                    << "apron " << apron << ", trial " << trial << ", pixel " << x / own << "," << y / own;
            }
        }
    }
}

TEST(SeamTheorem, OwnSamplesOfWindowsTileTheGlobalEdge) {
    check_seams<std::uint16_t>(1);
    check_seams<std::uint64_t>(1);
    check_seams<std::uint64_t>(2);
    check_seams<std::uint64_t>(3);
    check_seams<Mask256>(1);
    check_seams<Mask256>(4);
    check_seams<Mask256>(7);
}

TEST(Mask16, StrokeWidthFollowsTheLargerDirectionCosine) {
    // 2 n max(|cos|, |sin|) samples across, averaged along a straight border.
    const auto width_at = [](double angle_deg) {
        const double a = angle_deg * 3.14159265358979 / 180;
        double drawn = 0;
        int lines = 0;
        constexpr int kSize = 400;
        const auto inside = [&](int x, int y) {
            return (x + 0.5 - kSize / 2.0) * std::sin(a) - (y + 0.5 - kSize / 2.0) * std::cos(a) > 0.123;
        };
        for (int y = 100; y < 300; ++y) {
            for (int x = 100; x < 300; ++x) {
                const bool here = inside(x, y);
                drawn += here != inside(x + 1, y) || here != inside(x - 1, y) || here != inside(x, y + 1) ||
                         here != inside(x, y - 1);
            }
        }
        // Length of the border inside of the 200 x 200 square around the centre.
        const double length = 200 / std::max(std::abs(std::cos(a)), std::abs(std::sin(a)));
        ++lines;
        return drawn / length;
    };
    const std::pair<double, double> known[] = {{0, 2.0},    {10, 1.970}, {22.5, 1.848},
                                               {30, 1.732}, {45, 1.410}, {60, 1.732}};
    for (const auto& [angle, width] : known) EXPECT_NEAR(width_at(angle), width, 0.02) << angle;
}

}  // namespace
}  // namespace burin::coverage_mask_test
