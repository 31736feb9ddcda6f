#include "view/coincidence.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

Projection projection(bool orthographic) {
    Projection p;
    p.orthographic = orthographic;
    p.focal_px = orthographic ? 100 : 500;
    p.center_px = {320, 240};
    p.near_distance = 0.01;
    return p;
}

/// Two triangles of one plane that have more than a few pixels in common, and that plane.
struct Pair {
    glm::dvec3 a[3], b[3], normal, origin, along;
    bool is_useful = false;

    explicit Pair(Random& random) {
        origin = random.in_box(1) - glm::dvec3(0, 0, 6);
        along = random.direction();
        normal = glm::normalize(glm::cross(along, random.direction()));
        const glm::dvec3 across = glm::cross(normal, along);
        if (std::abs(normal.z) < 0.3 || std::abs(glm::dot(normal, glm::normalize(origin))) < 0.3) return;
        const double turn = random.real(0, 6.28);
        for (int k = 0; k < 3; ++k) {  // around the origin
            const auto corner = [&](double angle) {
                return origin + random.real(0.4, 1) * (std::cos(angle) * along + std::sin(angle) * across);
            };
            a[k] = corner(turn + 2.0944 * k);
            b[k] = corner(2.0944 * k);
        }
        is_useful = true;
    }
};

bool coincide(const Projection& p, const glm::dvec3 (&a)[3], const glm::dvec3 (&b)[3], double coordinate_error) {
    return compare_surfaces(p, a, b, coordinate_error).of_one_plane.are_coincident();
}

void move(glm::dvec3 (&corners)[3], const glm::dvec3& by) {
    for (glm::dvec3& c : corners) c += by;
}

TEST(Coincidence, IsThatOfPlanesThatPassThroughEachOtherUnseen) {
    Random random(5);
    int count = 0;
    for (const bool orthographic : {false, true}) {
        const Projection p = projection(orthographic);
        for (int trial = 0; trial < 2000; ++trial) {
            Pair pair(random);
            if (!pair.is_useful) continue;
            ++count;
            ASSERT_TRUE(coincide(p, pair.a, pair.b, 1e-7)) << trial;
            ASSERT_TRUE(coincide(p, pair.b, pair.a, 1e-7)) << trial;
            // Pixels are 0.008 to 0.016 units large there.
            for (const double angle : {3e-5, 1e-2}) {
                Pair turned = pair;
                for (glm::dvec3& c : turned.b) c += angle * glm::dot(c - pair.origin, pair.along) * pair.normal;
                ASSERT_EQ(coincide(p, turned.a, turned.b, 1e-7), angle == 3e-5) << trial;
                ASSERT_EQ(coincide(p, turned.b, turned.a, 1e-7), angle == 3e-5) << trial;
                ASSERT_TRUE(coincide(p, turned.a, turned.b, 1e-1)) << "larger errors of coordinates";
            }
        }
    }
    EXPECT_GT(count, 2000);
}

/// A label is seen on what it lies on, from anywhere and however little it is in front.
TEST(Coincidence, IsNotThatOfASurfaceInFrontOfAnother) {
    Random random(8);
    for (const bool orthographic : {false, true}) {
        const Projection p = projection(orthographic);
        for (int trial = 0; trial < 2000; ++trial) {
            Pair pair(random);
            if (!pair.is_useful) continue;
            const glm::dvec3 towards_eye =
                pair.normal *
                (glm::dot(pair.normal, orthographic ? glm::dvec3(0, 0, 1) : -pair.origin) > 0 ? 1.0 : -1.0);
            for (const double by : {1e-6, 1e-5, 1e-4, 1e-2}) {
                Pair moved = pair;
                move(moved.b, by * towards_eye);
                const SurfaceOrder order = compare_surfaces(p, moved.b, moved.a, 1e-7).of_one_plane,
                                   reversed = compare_surfaces(p, moved.a, moved.b, 1e-7).of_one_plane;
                ASSERT_FALSE(order.are_coincident() || reversed.are_coincident()) << trial << ' ' << by;
                ASSERT_TRUE(order.is_in_front() && !order.is_behind()) << trial << ' ' << by;
                ASSERT_TRUE(reversed.is_behind() && !reversed.is_in_front()) << trial << ' ' << by;
                ASSERT_TRUE(coincide(p, moved.a, moved.b, 1e-1)) << trial << ' ' << by;
            }
        }
    }
}

/// Where single precision loses more, it is the rounding of the two triangles' own corners that counts.
TEST(Coincidence, TakesTheErrorsOfTheTwoTriangles) {
    Random random(9);
    const Projection p = projection(false);
    for (int trial = 0; trial < 2000; ++trial) {
        Pair pair(random);
        if (!pair.is_useful) continue;
        const glm::dvec3 towards_eye = pair.normal * (glm::dot(pair.normal, pair.origin) < 0 ? 1.0 : -1.0);
        // A pixel is 0.008 to 0.016 units large there, and by less than 1/2048 of that nothing is in front.
        for (const double by : {1e-6, 1e-4}) {
            Pair moved = pair;
            move(moved.b, by * towards_eye);
            ASSERT_EQ(compare_surfaces(p, moved.b, moved.a, {1e-3, 1e-8, 1e-8}).of_one_plane.is_in_front(), by > 1e-5)
                << trial;
            ASSERT_FALSE(compare_surfaces(p, moved.b, moved.a, {1e-3, 1e-3, 1e-8}).of_one_plane.is_in_front()) << trial;
        }
    }
}

TEST(Coincidence, IsNotThatOfPlanesThatMeetAtAnAngle) {
    Random random(6);
    for (const bool orthographic : {false, true}) {
        const Projection p = projection(orthographic);
        for (int trial = 0; trial < 2000; ++trial) {
            Pair pair(random);
            if (!pair.is_useful) continue;
            for (glm::dvec3& c : pair.b) c += 0.02 * glm::dot(c - pair.origin, pair.along) * pair.normal;
            ASSERT_FALSE(coincide(p, pair.a, pair.b, 1e-7)) << trial;
            // Nor if they are too small to drift apart: what they are part of does.
            for (auto* corners : {&pair.a, &pair.b}) {
                for (glm::dvec3& c : *corners) c = pair.origin + 0.01 * (c - pair.origin);
            }
            ASSERT_FALSE(coincide(p, pair.a, pair.b, 1e-7)) << trial;
        }
    }
}

/// The two sides of a thin sheet are two surfaces.
TEST(Coincidence, IsExactWhereTheyMayNotBeOnePlane) {
    Random random(7);
    const Projection p = projection(false);
    for (int trial = 0; trial < 2000; ++trial) {
        Pair pair(random);
        if (!pair.is_useful) continue;
        for (glm::dvec3& c : pair.b) c += 1e-4 * glm::dot(c - pair.origin, pair.along) * pair.normal;
        ASSERT_TRUE(coincide(p, pair.a, pair.b, 1e-7)) << trial;
        ASSERT_FALSE(compare_surfaces(p, pair.a, pair.b, 1e-7).of_two_planes.are_coincident()) << trial;
        ASSERT_TRUE(compare_surfaces(p, pair.a, pair.b, 1e-3).of_two_planes.are_coincident()) << trial;
        std::swap(pair.b[0], pair.b[1]);
        ASSERT_TRUE(coincide(p, pair.a, pair.b, 1e-7)) << "either way it is wound";
        ASSERT_NE(faces_eye(p, pair.a), faces_eye(p, pair.b));
    }
}

TEST(Coincidence, AsksOnlyWhereBothAreInThePicture) {
    const Projection p = projection(false);
    // Long strips towards the eye: in the picture they pass through each other by less than can be seen, near the eye,
    // below the picture, by more.
    const glm::dvec3 one[3] = {{-1, -1, -20}, {1, -1, -20}, {0, -1, -0.1}},
                     other[3] = {{-1, -1.00001, -20}, {1, -0.99999, -20}, {0, -1.00002, -0.1}};
    EXPECT_TRUE(coincide(p, one, other, 1e-9));
    const glm::dvec3 beside[3] = {{5, 5, -6}, {6, 5, -6}, {5, 6, -6}};
    EXPECT_FALSE(compare_surfaces(p, one, beside, 1e-9).of_one_plane.have_common_place);
    EXPECT_FALSE(coincide(p, one, beside, 1e-9));
}

TEST(Coincidence, IsFalseForWhatHasNoPlane) {
    const glm::dvec3 edge_on[3] = {{0, 0, -1}, {0, 0, -2}, {0, 1, -2}}, none[3] = {{0, 0, -3}, {0, 0, -3}, {0, 0, -3}};
    const glm::dvec3 behind[3] = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, usual[3] = {{-1, -1, -3}, {1, -1, -3}, {0, 1, -3}};
    for (const bool orthographic : {false, true}) {
        const Projection p = projection(orthographic);
        for (const auto* other : {&edge_on, &none, &behind}) {
            EXPECT_FALSE(coincide(p, usual, *other, 1e-7));
            EXPECT_FALSE(coincide(p, *other, usual, 1e-7));
        }
    }
}

}  // namespace
}  // namespace burin
