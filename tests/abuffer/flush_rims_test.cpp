// Flush faces of one object that lap over each other by narrow strips, and several bodies in one plane (decision 13).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "tests/support/ink_apart.h"
#include "tests/support/layers.h"
#include "tests/support/random.h"

namespace burin::flush_rims_test {
namespace {

using namespace test;

constexpr int kPx = 300;
constexpr double kRadius = 0.8, kHeight = 0.4;

glm::dvec3 on_circle(double turns, double y) {
    return {kRadius * std::cos(6.283185307179586 * turns), y, kRadius * std::sin(6.283185307179586 * turns)};
}

/// A plate with a hole of `sides` sides.
PolygonSoup plate(int sides) {
    PolygonSoup soup;
    for (int i = 0; i < sides; ++i) {
        const double turns = static_cast<double>(i) / sides;
        const glm::dvec3 rim = on_circle(turns, 0), outer = rim * (2.0 / std::max(std::abs(rim.x), std::abs(rim.z)));
        for (const double y : {kHeight, 0.0}) {
            soup.positions.emplace_back(rim.x, y, rim.z);
            soup.positions.emplace_back(outer.x, y, outer.z);
        }
    }
    const auto corner = [sides](int i, unsigned k) { return static_cast<std::uint32_t>(i % sides) * 4 + k; };
    for (int i = 0; i < sides; ++i) {
        const auto add = [&](unsigned k, unsigned m) {
            soup.add_polygon(std::vector{corner(i, k), corner(i + 1, k), corner(i + 1, m), corner(i, m)});
        };
        add(0, 1);  // top
        add(1, 3);  // outside
        add(3, 2);  // bottom
        add(2, 0);  // hole
    }
    return soup;
}

/// Turned by a part of a side.
PolygonSoup pin(int sides, double turn, double top) {
    PolygonSoup soup;
    std::vector<std::uint32_t> upper, lower;
    for (int i = 0; i < sides; ++i) {
        for (const double y : {top, 0.0}) soup.positions.push_back(on_circle((i + turn) / sides, y));
        upper.push_back(static_cast<std::uint32_t>(2 * i));
        lower.push_back(static_cast<std::uint32_t>(2 * (sides - 1 - i) + 1));
    }
    for (int i = 0; i < sides; ++i) {
        const auto a = static_cast<std::uint32_t>(2 * i), b = static_cast<std::uint32_t>(2 * ((i + 1) % sides));
        soup.add_polygon(std::vector{b, a, a + 1, b + 1});
    }
    soup.add_polygon(upper);
    soup.add_polygon(lower);
    return soup;
}

Camera from_above(double height, double tilt = 0) {
    Camera camera = perspective_camera({10 * std::sin(tilt), 10 * std::cos(tilt), 0.001}, {0, kHeight, 0});
    camera.orthographic = true;
    camera.height = height;
    return camera;
}

Drawing drawn(const PolygonSoup& one, const PolygonSoup& other, const Camera& camera) {
    return Drawing(scene_of({test::joined({one, other})}), camera, kPx, kPx, {0, 0, kPx, kPx}, 2, render_abuffer);
}

// Where the pin's polygon reaches over the hole's, there is a line, as where it stays within and leaves a gap: a whole
// circle, that of the first one, as if that were a little higher.
TEST(FlushRims, OfPinsAreWholeCircles) {
    for (const int sides : {16, 24, 32, 64}) {
        for (const double turn : {0.5, 0.2}) {
            for (const double height : {3.0, 8.0}) {
                for (const double tilt : {0.0, 0.5}) {
                    const Camera camera = from_above(height, tilt);
                    for (const bool is_pin_first : {false, true}) {
                        const PolygonSoup flush = pin(sides, turn, kHeight), base = plate(sides),
                                          off = pin(sides, turn, kHeight + (is_pin_first ? 1 : -1) * 1e-4);
                        const Drawing d = is_pin_first ? drawn(flush, base, camera) : drawn(base, flush, camera);
                        const Drawing expected = is_pin_first ? drawn(off, base, camera) : drawn(base, off, camera);
                        const std::string what = std::to_string(sides) + " sides, turned by " + std::to_string(turn) +
                                                 ", " + std::to_string(height) + ", " + std::to_string(tilt) +
                                                 (is_pin_first ? ", pin first" : ", plate first");
                        const double all = expected.sum("lines.A");  // up to half of it was missing
                        EXPECT_LE(ink_apart(expected, d), 0.02 * all) << what << ": missing lines";
                        EXPECT_LE(ink_apart(d, expected), 0.02 * all) << what << ": false lines";
                        EXPECT_NEAR(d.sum("lines.A"), all, 0.05 * all) << what;
                    }
                }
            }
        }
    }
}

// At any angle, of any number of sides: a body is in the plane of another one of its mesh but for rounding.
TEST(FlushRims, OfPinsAreWholeFromAnywhere) {
    for (int seed = 0; seed < 40; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        constexpr int kSides[] = {16, 20, 24, 32, 48, 64, 96};
        const int sides = kSides[random.integer(0, 6)],
                  sides_of_pin = random.integer(0, 1) == 0 ? sides : kSides[random.integer(0, 6)];
        const double turn = random.real(0, 1);
        const bool is_pin_first = random.integer(0, 1) == 0;
        const glm::dvec3 x = random.direction(), z = glm::normalize(glm::cross(x, random.direction()));
        const glm::dmat3 rotation(x, glm::cross(z, x), z);
        const auto placed = [&](const PolygonSoup& soup) {
            return transformed(soup, [&](glm::dvec3 p) { return glm::round(1e6 * (rotation * p)) / 1e6; });
        };
        const double azimuth = random.real(0, 6.28), height = random.real(0.35, 1.57);
        const glm::dvec3 towards(std::cos(height) * std::cos(azimuth), std::sin(height),
                                 std::cos(height) * std::sin(azimuth));
        const glm::dvec3 middle(0, kHeight, 0);
        const Camera camera =
            perspective_camera(rotation * (middle + 10.0 * towards), rotation * middle, random.real(11, 30));
        const PolygonSoup flush = placed(pin(sides_of_pin, turn, kHeight)), base = placed(plate(sides)),
                          off = placed(pin(sides_of_pin, turn, kHeight + (is_pin_first ? 1 : -1) * 3e-5));
        const Drawing d = is_pin_first ? drawn(flush, base, camera) : drawn(base, flush, camera);
        const Drawing expected = is_pin_first ? drawn(off, base, camera) : drawn(base, off, camera);
        const std::string what = "seed " + std::to_string(seed) + ": " + std::to_string(sides_of_pin) + " in " +
                                 std::to_string(sides) + (is_pin_first ? ", pin first" : ", plate first");
        EXPECT_LE(ink_apart(expected, d), 1) << what << ": missing lines";
        EXPECT_LE(ink_apart(d, expected), 1) << what << ": false lines";
    }
}

PolygonSoup box(glm::dvec3 low, glm::dvec3 high) { return moved(make_box(high - low), 0.5 * (low + high)); }

// Two halves of a wall that share corners are one face where a third body ends in it.
TEST(FlushRims, ABodyThatEndsInTwoHasNoLine) {
    for (int seed = 0; seed < 24; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        // Also where it reaches beyond the joint of the two, or up to it.
        const double end = random.integer(0, 2) == 0 ? 4 : random.real(3.3, 4.7), high = random.real(1, 2.5);
        std::vector<PolygonSoup> apart = {box({3, 0, 4}, {4, 3, 5}), box({3, 0, 3}, {4, 3, 4}),
                                          box({1, 0, 3}, {4, high, end})};
        std::vector<PolygonSoup> whole = {box({3, 0, 3}, {4, 3, 5}), apart[2]};
        std::rotate(apart.begin(), apart.begin() + seed % 3, apart.end());
        if (seed % 2 == 1) std::swap(apart[0], apart[1]);
        const glm::dvec3 x = random.direction(), z = glm::normalize(glm::cross(x, random.direction()));
        const glm::dmat3 rotation = seed % 4 == 0 ? glm::dmat3(1.0) : glm::dmat3(x, glm::cross(z, x), z);
        const auto placed = [&](const PolygonSoup& soup) {
            return transformed(
                soup, [&](glm::dvec3 p) { return glm::round(1e5 * (rotation * (p - glm::dvec3(3, 1.5, 4)))) / 1e5; });
        };
        const Camera camera = perspective_camera(
            rotation * glm::dvec3(random.real(4, 9), random.real(-2, 5), random.real(-5, 5)), glm::dvec3(0.0), 45);
        const auto draw = [&](const std::vector<PolygonSoup>& bodies) {
            return Drawing(scene_of({placed(test::joined(bodies))}), camera, kPx, kPx, {0, 0, kPx, kPx}, 2,
                           render_abuffer);
        };
        const Drawing d = draw(apart), expected = draw(whole);
        EXPECT_LE(ink_apart(d, expected), 1) << seed << ": false lines";
        EXPECT_LE(ink_apart(expected, d), 1) << seed << ": missing lines";
    }
}

}  // namespace
}  // namespace burin::flush_rims_test
