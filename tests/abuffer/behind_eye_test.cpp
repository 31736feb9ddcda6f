// What goes on behind the eye is drawn like what ends in front of it, beside the picture.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/abuffer.h"
#include "methods/reference/reference.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::behind_eye_test {
namespace {

using namespace test;

constexpr int kColumns = 240, kRows = 180;

/// From the eye to the far end, and on behind the eye if it is to pass it. It is nowhere near the axis of view, so that
/// what is nearer than kCut lies beside the picture.
struct Beam {
    static constexpr double kCut = 0.1, kFar = 40, kBehind = 10;
    glm::dvec2 near, far;  ///< its middle, kCut and kFar ahead
    glm::dvec2 half;       ///< widths
    bool is_flat;

    PolygonSoup soup(bool passes_eye) const {
        const double begin = passes_eye ? -kBehind : kCut;
        const auto at = [&](double ahead, double x, double y) {
            const glm::dvec2 middle = glm::mix(near, far, (ahead - kCut) / (kFar - kCut));
            return glm::dvec3(middle.x + x * half.x, middle.y + y * half.y, -ahead);
        };
        std::vector<glm::dvec3> positions;
        for (const double ahead : {begin, kFar}) {
            for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
                positions.push_back(at(ahead, x, is_flat ? -1 : y));
        }
        if (is_flat) return soup_of(positions, {{0, 1, 5, 4}});
        return soup_of(positions, {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {3, 2, 1, 0}, {4, 5, 6, 7}});
    }
};

Beam random_beam(Random& random) {
    Beam beam;
    const double angle = random.real(0, 6.28);
    beam.near = glm::dvec2(std::cos(angle), std::sin(angle)) * random.real(0.5, 1.5);
    beam.far = {random.real(-8, 8), random.real(-8, 8)};
    beam.is_flat = random.integer(0, 1) == 0;
    // One that is not flat hides its own edges: it is thick enough for that to be certain.
    const double half = std::pow(10.0, random.real(beam.is_flat ? -3 : -2, -1));
    beam.half = {half, half * random.real(0.2, 1)};
    return beam;
}

Scene scene_with(const Beam& beam, bool passes_eye) {
    // Near enough for no beam to pass through it.
    const PolygonSoup panel =
        soup_of({{-0.1, -0.08, -0.3}, {0.1, -0.08, -0.3}, {0.1, 0.08, -0.3}, {-0.1, 0.08, -0.3}}, {{0, 1, 2, 3}});
    Scene scene = scene_of({beam.soup(passes_eye), panel});
    scene.lines.style.hidden.style = HiddenStyle::solid;
    return scene;
}

Drawing draw(const Scene& scene, RenderFunction render) {
    return Drawing(scene, perspective_camera({0, 0, 0}, {0, 0, -1}, 60), kColumns, kRows, {0, 0, kColumns, kRows}, 1,
                   render);
}

double largest_difference(const Drawing& a, const Drawing& b, const std::string& channel) {
    double largest = 0;
    for (int y = 0; y < kRows; ++y) {
        for (int x = 0; x < kColumns; ++x)
            largest = std::max(largest, std::abs(a.at(channel, x, y) - b.at(channel, x, y)));
    }
    return largest;
}

TEST(BehindTheEye, ThinBeamsAreDrawn) {
    double visible = 0, hidden = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const Beam beam = random_beam(random);
        const Drawing passing = draw(scene_with(beam, true), render_abuffer);
        const Drawing ending = draw(scene_with(beam, false), render_abuffer);
        visible += ending.sum("lines.A");
        hidden += ending.sum("lines_hidden.A");
        // Corners are snapped in the one and cut off far from the picture in the other: up to 1/256 pixel.
        EXPECT_LT(largest_difference(passing, ending, "lines.A"), 0.05) << "seed " << seed;
        EXPECT_LT(largest_difference(passing, ending, "lines_hidden.A"), 0.05) << "seed " << seed;
    }
    EXPECT_GT(visible, 60 * 100);
    EXPECT_GT(hidden, 60 * 5);
}

/// Lanes marked on a road on which the eye stands. The borders of one marking are no seam with those of the next.
TEST(BehindTheEye, MarkingsOfARoad) {
    const auto road = [](double begin) {
        PolygonSoup soup = soup_of({{-30, 0, begin}, {30, 0, begin}, {30, 0, -60}, {-30, 0, -60}}, {{0, 1, 2, 3}});
        for (int lane = -4; lane <= 4; ++lane) {
            const auto first = static_cast<std::uint32_t>(soup.positions.size());
            for (const auto& [x, z] : {std::pair(-0.01, begin), {0.01, begin}, {0.01, -60.0}, {-0.01, -60.0}}) {
                soup.positions.emplace_back(0.4 * lane + x, 0.001, z);
            }
            soup.add_polygon(std::vector<std::uint32_t>{first, first + 1, first + 2, first + 3});
        }
        return scene_of({soup});
    };
    const Camera camera = perspective_camera({0.3, 0.05, 0}, {0, 0, -8}, 35);
    for (const RenderFunction render : {render_abuffer, render_reference}) {
        const auto drawn = [&](double begin) {
            return Drawing(road(begin), camera, 160, 120, {0, 0, 160, 120}, 1, render);
        };
        const Drawing passing = drawn(10), ending = drawn(-0.03);
        EXPECT_NEAR(passing.sum(LineClass::border), ending.sum(LineClass::border), 2);
        EXPECT_GT(ending.sum(LineClass::border), 700);
    }
}

/// A floor of two patches that are not stitched, one long edge along several short ones.
TEST(BehindTheEye, SeamsOfAFloorAreNoBorders) {
    const auto floor_with = [](int pieces) {
        PolygonSoup soup = soup_of({{-20, 0, 10}, {0, 0, 10}, {0, 0, -20}, {-20, 0, -20}}, {{0, 1, 2, 3}});
        for (int i = 0; i < pieces; ++i) {
            const double begin = 10 - 30.0 * i / pieces, end = 10 - 30.0 * (i + 1) / pieces;
            const auto first = static_cast<std::uint32_t>(soup.positions.size());
            for (const auto& [x, z] : {std::pair(0.0, begin), {20.0, begin}, {20.0, end}, {0.0, end}})
                soup.positions.emplace_back(x, 0, z);
            soup.add_polygon(std::vector<std::uint32_t>{first, first + 1, first + 2, first + 3});
        }
        Scene scene = scene_of({soup});
        scene.lines.style.hidden.style = HiddenStyle::solid;
        return scene;
    };
    const Scene whole = scene_of({soup_of({{-20, 0, 10}, {20, 0, 10}, {20, 0, -20}, {-20, 0, -20}}, {{0, 1, 2, 3}})});
    for (const glm::dvec3 target : {glm::dvec3(0.1, 0, -2), {-0.3, 0.2, -2}, {0.5, 0, -4}}) {
        const Camera camera = perspective_camera({0.47, 0.44, 1.1}, target, 60);
        const auto ink = [&](const Scene& scene) {
            const Drawing d(scene, camera, 160, 120, {0, 0, 160, 120}, 1, render_abuffer);
            return d.sum("lines.A");
        };
        for (const int pieces : {1, 2, 5, 7, 8}) EXPECT_NEAR(ink(floor_with(pieces)), ink(whole), 0.5) << pieces;
        EXPECT_GT(ink(whole), 100);
    }
}

/// Towards the horizon distances grow without bounds, and so do their errors.
TEST(BehindTheEye, GroundsInOnePlaneAreOneUpToTheHorizon) {
    const auto ground = [](double left, double right, double begin) {
        return soup_of({{left, 0, begin}, {right, 0, begin}, {right, 0, -400}, {left, 0, -400}}, {{0, 1, 2, 3}});
    };
    const Scene scene = scene_of({ground(-400, 400, 5), ground(-2, 3, -3)});
    const Camera camera = perspective_camera({0.1, 0.05, 0}, {0.15, 0, -20}, 40);
    for (const RenderFunction render : {render_abuffer, render_reference}) {
        const Drawing d(scene, camera, 160, 120, {0, 0, 160, 120}, 1, render);
        EXPECT_EQ(d.sum(LineClass::intersection), 0);
        EXPECT_GT(d.sum(LineClass::border), 100);
    }
}

/// Near the eye, coordinates far away are not exact in pixels: where two walls pass through each other is a line all
/// the same.
TEST(BehindTheEye, WallsPassThroughEachOtherNearTheEye) {
    for (const RenderFunction render : {render_abuffer, render_reference}) {
        const auto wall = [](glm::dvec3 a, glm::dvec3 b) {
            const glm::dvec3 up(0, 40, 0);
            return soup_of({a - up, b - up, b + up, a + up}, {{0, 1, 2, 3}});
        };
        // They meet at x = 0.013, 0.13 ahead.
        const Scene scene =
            scene_of({wall({-50, 0, -0.143}, {50, 0, -0.117}), wall({-49.987, 0, -25.13}, {50.013, 0, 24.87})});
        const Drawing d = draw(scene, render);
        const double x = kColumns / 2 + 0.5 * kRows / std::tan(glm::radians(30.0)) * 0.013 / 0.13;
        EXPECT_NEAR(d.sum(LineClass::intersection), kRows, 1);
        EXPECT_GT(d.drawn_share({x, 0}, {x, kRows}), 0.99);
    }
}

}  // namespace
}  // namespace burin::behind_eye_test
