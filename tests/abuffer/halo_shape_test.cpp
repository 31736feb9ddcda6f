#include "abuffer/masks/halo_shape.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace burin::halo_shape_test {
namespace {

TEST(HaloShape, FourIsPatelsHalo) {
    test::Random random(7);
    for (int trial = 0; trial < 10000; ++trial) {
        const std::uint64_t a = random.bits64(), b = random.bits64();
        EXPECT_EQ(shaped_halo(a, 2, HaloShape::four), halo(a, 2));
        EXPECT_EQ(shaped_edge_between(a, b, 2, HaloShape::four), edge_between(a, b, 2));
    }
}

TEST(HaloShape, OneSampleGrowsToADiamondASquareAndAnOctagon) {
    const auto point = sample_bit<std::uint64_t>(3, 3);
    EXPECT_EQ(mask_picture(shaped_halo(point, 2, HaloShape::four)),
              "........\n...#....\n..###...\n.##.##..\n..###...\n...#....\n........\n........\n");
    EXPECT_EQ(mask_picture(shaped_halo(point, 2, HaloShape::eight)),
              "........\n.#####..\n.#####..\n.##.##..\n.#####..\n.#####..\n........\n........\n");
    EXPECT_EQ(mask_picture(shaped_halo(point, 2, HaloShape::octagon)),
              "........\n..###...\n.#####..\n.##.##..\n.#####..\n..###...\n........\n........\n");
}

TEST(HaloShape, EightStaysInTheWindow) {
    EXPECT_EQ(dilate_eight(sample_bit<std::uint16_t>(0, 0)), 0x0033);
    EXPECT_EQ(dilate_eight(sample_bit<std::uint16_t>(3, 3)), 0xCC00);
    Mask256 corner = sample_bit<Mask256>(15, 0);
    EXPECT_EQ(MaskGrid<Mask256>::count(dilate_eight(corner)), 4);
}

}  // namespace
}  // namespace burin::halo_shape_test
