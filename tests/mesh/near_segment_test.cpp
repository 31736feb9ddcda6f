// Boxes near segments and places, four at once.

#include "mesh/near_segment.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

/// An end of a segment; ends often share coordinates, or lie on a side of a box.
glm::dvec3 end_near(Random& random, const glm::dvec3& other) {
    glm::dvec3 end = random.in_box(2);
    for (int axis = 0; axis < 3; ++axis) {
        if (random.integer(0, 3) == 0) end[axis] = other[axis];
        if (random.integer(0, 9) == 0) end[axis] = other[axis] + 1e-310;
    }
    return end;
}

FourBoxes::Box box_near(Random& random, const glm::dvec3& on) {
    const glm::vec3 low(random.in_box(2));
    FourBoxes::Box box{low, low + glm::abs(glm::vec3(random.in_box(random.integer(0, 1))))};
    if (random.integer(0, 3) == 0) box.low = box.high = glm::vec3(on);
    return box;
}

double distance_to(const FourBoxes::Box& box, const glm::dvec3& place) {
    return glm::length(glm::max(glm::max(glm::dvec3(box.low) - place, place - glm::dvec3(box.high)), glm::dvec3(0.0)));
}

TEST(NearSegment, FindsAllBoxesThatAreNear) {
    int near = 0, far = 0;
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        Random random(seed);
        const glm::dvec3 a = random.in_box(2), b = end_near(random, a);
        const double margin = random.integer(0, 1) == 0 ? 1e-6 : random.real(0, 0.5);
        FourBoxes boxes;
        std::array<FourBoxes::Box, FourBoxes::kCount> all;
        for (std::size_t k = 0; k < all.size(); ++k) {
            all[k] = box_near(random, glm::mix(a, b, random.real(0, 1)));
            boxes.set(k, all[k]);
        }
        const NearSegment may_be_near(a, b, margin);
        const FourBoxes::AreNear found = may_be_near(boxes);
        for (std::size_t k = 0; k < all.size(); ++k) {
            double least = 1e300;
            for (int step = 0; step <= 64; ++step)
                least = std::min(least, distance_to(all[k], glm::mix(a, b, step / 64.0)));
            const bool alone = may_be_near(glm::dvec3(all[k].low), glm::dvec3(all[k].high));
            EXPECT_EQ(found[k], alone) << "seed " << seed;
            EXPECT_TRUE(found[k] || least > margin) << "seed " << seed;
            ++(found[k] ? near : far);
            // Only at the corners of a box may what is found be farther than the margin, and by how far one step goes.
            EXPECT_TRUE(!found[k] || least <= 1.74 * margin + glm::distance(a, b) / 64 + 1e-6) << "seed " << seed;
        }
    }
    EXPECT_GT(near, 5000);
    EXPECT_GT(far, 5000);
}

TEST(NearSegment, DistancesAreThoseOfEachBox) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        const glm::dvec3 place = random.in_box(2);
        FourBoxes boxes;
        std::array<FourBoxes::Box, FourBoxes::kCount> all;
        for (std::size_t k = 0; k < all.size(); ++k) {
            all[k] = box_near(random, place);
            boxes.set(k, all[k]);
        }
        const auto squares = DistanceToBoxes(place).squares(boxes);
        for (std::size_t k = 0; k < all.size(); ++k) {
            const double distance = distance_to(all[k], place);
            EXPECT_NEAR(squares[k], distance * distance, 1e-12) << "seed " << seed;
        }
    }
}

TEST(NearSegment, WhatWasNotSetIsFarFromAllPlaces) {
    for (const double square : DistanceToBoxes({1, 2, 3}).squares(FourBoxes())) EXPECT_GT(square, 1e300);
}

}  // namespace
}  // namespace burin
