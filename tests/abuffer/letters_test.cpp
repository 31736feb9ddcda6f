// Letters whose faces lie in one plane with the plate they are on, in one object: concave, with holes, in any order.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/shapes.h"
#include "methods/reference/reference.h"
#include "tests/support/ink_apart.h"
#include "tests/support/layers.h"
#include "tests/support/random.h"

namespace burin::letters_test {
namespace {

using namespace test;

using Outline = std::vector<glm::dvec2>;  // counterclockwise; a hole is joined by a bridge, to and fro

const Outline kL{{0, 0}, {0.6, 0}, {0.6, 0.2}, {0.2, 0.2}, {0.2, 1}, {0, 1}};
const Outline kE{{0, 0},     {0.6, 0},   {0.6, 0.2},  {0.2, 0.2},  {0.2, 0.45}, {0.5, 0.45},
                 {0.5, 0.6}, {0.2, 0.6}, {0.2, 0.85}, {0.6, 0.85}, {0.6, 1},    {0, 1}};
const Outline kA{{0, 0},       {0.25, 0},    {0.35, 0.25}, {0.42, 0.4}, {0.5, 0.7}, {0.58, 0.4}, {0.42, 0.4},
                 {0.35, 0.25}, {0.65, 0.25}, {0.75, 0},    {1, 0},      {0.6, 1},   {0.4, 1}};
const Outline kFrame{{0, 0},     {0.3, 0.3}, {0.3, 0.7}, {0.7, 0.7}, {0.7, 0.3},
                     {0.3, 0.3}, {0, 0},     {1, 0},     {1, 1},     {0, 1}};

/// Its front is at `z`.
PolygonSoup sheet(const Outline& outline, double z = 0) {
    PolygonSoup soup;
    std::vector<std::uint32_t> corners;
    for (const glm::dvec2 p : outline) {
        corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
        soup.positions.emplace_back(p, z);
    }
    soup.add_polygon(corners);
    return soup;
}

PolygonSoup body(const Outline& outline, double z = 0) {
    PolygonSoup soup = joined({sheet(outline, z), turned(sheet(outline, z - 0.2))});
    const auto n = static_cast<std::uint32_t>(outline.size());
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t next = i + 1 == n ? 0 : i + 1;
        const auto is_bridge = [&] {
            for (std::uint32_t k = 0; k < n; ++k) {
                if (outline[k] == outline[next] && outline[k + 1 == n ? 0 : k + 1] == outline[i]) return true;
            }
            return false;
        };
        if (!is_bridge()) soup.add_polygon(std::vector{i, n + i, n + next, next});
    }
    return soup;
}

/// A plate whose front, at z = 0, is cut into `parts` rows and columns.
PolygonSoup plate(int parts) {
    const glm::dvec3 low(-0.2, -0.2, -0.3), high(1.4, 1.2, 0);
    const PolygonSoup whole = moved(make_box(high - low), 0.5 * (low + high));
    if (parts == 1) return whole;
    PolygonSoup soup;
    soup.positions = whole.positions;
    for (std::size_t i = 0; i < whole.polygon_count(); ++i) {
        const auto corners = whole.polygon(i);
        const bool is_front =
            std::all_of(corners.begin(), corners.end(), [&](std::uint32_t c) { return whole.positions[c].z == 0; });
        if (!is_front) soup.add_polygon(std::vector<std::uint32_t>(corners.begin(), corners.end()));
    }
    const auto first = static_cast<std::uint32_t>(soup.positions.size()), along = static_cast<std::uint32_t>(parts + 1);
    for (int y = 0; y <= parts; ++y) {
        for (int x = 0; x <= parts; ++x)
            soup.positions.emplace_back(glm::mix(low.x, high.x, double(x) / parts),
                                        glm::mix(low.y, high.y, double(y) / parts), 0);
    }
    for (std::uint32_t y = 0; y + 1 < along; ++y) {
        for (std::uint32_t x = 0; x + 1 < along; ++x) {
            const std::uint32_t corner = first + y * along + x;
            soup.add_polygon(std::vector{corner, corner + 1, corner + along + 1, corner + along});
        }
    }
    return soup;
}

Camera camera_before(Random& random, bool orthographic) {
    const glm::dvec3 middle(0.6, 0.5, -0.15),
        to_eye = glm::normalize(glm::dvec3(random.real(-1, 1), random.real(-0.6, 0.9), random.real(0.4, 1)));
    Camera camera = perspective_camera(middle + 4.0 * to_eye, middle, 35);
    camera.orthographic = orthographic;
    camera.height = 2.2;
    return camera;
}

constexpr int kPx = 240;

Drawing drawn(const PolygonSoup& soup, const Camera& camera, int samples, LineClassSet more = {}) {
    Scene scene = scene_of({soup});
    scene.lines.classes |= more;
    if (samples != 0) scene.abuffer.samples = samples;
    return Drawing(scene, camera, kPx, kPx, {0, 0, kPx, kPx}, 2, render_abuffer);
}

double largest_difference(const Drawing& a, const Drawing& b) {
    double largest = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) largest = std::max(largest, std::abs(a.line(x, y) - b.line(x, y)));
    }
    return largest;
}

struct Letter {
    const char* name;
    PolygonSoup soup;
};

std::vector<Letter> letters() {
    return {{"L", body(kL)},
            {"E", body(kE)},
            {"A", body(kA)},
            {"frame", body(kFrame)},
            {"E, turned", turned(body(kE))},
            {"A, sunk", body(kA, -1e-6)},
            {"L, a sheet", sheet(kL)},
            {"frame, a sheet", turned(sheet(kFrame))},
            {"two side by side", joined({body(kL), moved(body(kL), {0.603, 0, 0})})}};
}

// Two samples on a letter may have its notch between them, which the plate fills.
TEST(Letters, InAPlateAreNotSeen) {
    for (const Letter& letter : letters()) {
        for (int seed = 0; seed < 24; ++seed) {
            Random random(static_cast<std::uint64_t>(seed));
            const Camera camera = camera_before(random, seed % 4 == 3);
            const int samples = seed % 3 == 2 ? 2 : 0;
            const Drawing expected = drawn(plate(1), camera, samples);
            EXPECT_EQ(largest_difference(drawn(joined({letter.soup, plate(1)}), camera, samples), expected), 0)
                << letter.name << ", seed " << seed;
            if (seed >= 8) continue;
            EXPECT_EQ(largest_difference(drawn(joined({plate(1), letter.soup}), camera, samples), expected), 0)
                << letter.name << ", last, seed " << seed;
        }
    }
}

// Beneath a letter and in its notch there may be several faces.
TEST(Letters, InAPlateOfSeveralFacesAreNotSeen) {
    for (const Letter& letter : {Letter{"frame", body(kFrame)}, {"L", body(kL)}}) {
        for (int seed = 0; seed < 20; ++seed) {
            Random random(static_cast<std::uint64_t>(seed));
            const Camera camera = camera_before(random, seed % 4 == 3);
            const Drawing expected = drawn(plate(3), camera, 0);
            EXPECT_EQ(largest_difference(drawn(joined({letter.soup, plate(3)}), camera, 0), expected), 0)
                << letter.name << ", seed " << seed;
        }
    }
}

// The floor is cut behind the eye: what is left of a triangle, and of its neighbours, is more than one triangle.
TEST(Letters, InAFloorThatReachesBehindTheEyeAreNotSeen) {
    Outline ring;
    for (int i = 0; i <= 24; ++i)
        ring.push_back(glm::dvec2(0.5) +
                       0.5 * glm::dvec2(std::cos(glm::radians(15.0 * i)), std::sin(glm::radians(15.0 * i))));
    for (int i = 24; i >= 0; --i)
        ring.push_back(glm::dvec2(0.5) +
                       0.3 * glm::dvec2(std::cos(glm::radians(15.0 * i)), std::sin(glm::radians(15.0 * i))));
    ring[24] = ring[0];
    ring[25] = ring.back();
    const PolygonSoup floor = moved(make_box({6, 3, 0.3}), {1, 0.5, -0.15});
    const PolygonSoup text = joined({moved(body(kL), {-1, 0, 0}), moved(body(kA), {0.1, 0, 0}),
                                     moved(body(ring), {1.2, 0, 0}), moved(body(kE), {2.3, 0, 0})});
    for (int seed = 0; seed < 60; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const glm::dvec3 target(random.real(-1, 2), random.real(0, 1), 0);
        const double reach = seed % 2 == 0 ? 3 : 0.6;
        const Camera camera = perspective_camera(
            target + glm::dvec3(random.real(-reach, reach), random.real(-reach, reach), random.real(0.03, 0.25)),
            target, 60);
        const Drawing d = drawn(joined({text, floor}), camera, 0), expected = drawn(floor, camera, 0);
        // Not to the bit: a letter that ends less than a sample before the floor's own outline may make that wider.
        EXPECT_EQ(ink_apart(d, expected), 0) << seed;
        EXPECT_EQ(ink_apart(expected, d), 0) << seed;
    }
}

// What is behind a curtain with one layer in front is what is seen without it. (A letter's back is in the plate:
// sheets.)
TEST(Letters, InAPlateAreNotAmongHiddenLines) {
    for (const Outline& outline : {kL, kE, kFrame}) {
        for (int seed = 0; seed < 20; ++seed) {
            Random random(static_cast<std::uint64_t>(seed));
            const Camera camera = camera_before(random, false);
            const glm::dmat4 to_world = glm::inverse(camera.to_view());
            PolygonSoup curtain;
            for (const glm::dvec2 p : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
                curtain.positions.emplace_back(to_world * glm::dvec4(p, -1, 1));
            curtain.add_polygon(std::vector<std::uint32_t>{0, 1, 2, 3});
            const auto hidden_px = [&](const PolygonSoup& soup) {
                Scene scene = scene_of({soup, curtain});
                scene.lines.style.hidden.style = HiddenStyle::solid;
                return Layers(scene, camera).hidden_px(1);
            };
            EXPECT_NEAR(hidden_px(joined({sheet(outline), plate(1)})), hidden_px(plate(1)), 0.5) << seed;
        }
    }
}

// Nothing fills the notch of a letter on its own, or before a plate: then it is a line, also where it is narrower than
// samples are apart.
TEST(Letters, OnTheirOwnKeepTheirOutline) {
    for (int seed = 0; seed < 4; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const Camera camera = camera_before(random, seed % 4 == 3);
        const PolygonSoup back = moved(plate(1), {0, 0, -1});
        for (const Outline& outline : {kL, kA}) {
            Scene scene = scene_of({joined({body(outline), back})});
            const Drawing d(scene, camera, kPx, kPx, {0, 0, kPx, kPx}, 2, render_abuffer),
                truth(scene, camera, kPx, kPx, {0, 0, kPx, kPx}, 2, render_reference);
            EXPECT_LE(ink_apart(truth, d), 0.5) << seed;
        }
    }
}

// What stands on a plane between two samples, in front of it, is seen whatever lies beneath.
TEST(Letters, DoNotHideAFinThatIsNarrowerThanSamplesAreApart) {
    for (int seed = 0; seed < 12; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const double left = random.real(-0.4, 0), right = random.real(0.1, 0.5), width = 0.002,
                     height = random.real(0.01, 0.03);
        PolygonSoup flange;
        for (const double y : {-1.0, 1.0}) {
            const double x = y < 0 ? left : right;
            for (const glm::dvec2 p :
                 {glm::dvec2(-1, 0), {x, 0}, {x, height}, {x + width, height}, {x + width, 0}, {1.2, 0}})
                flange.positions.emplace_back(p.x, y, p.y);
        }
        for (std::uint32_t i = 0; i < 5; ++i) flange.add_polygon(std::vector<std::uint32_t>{i, i + 1, i + 7, i + 6});
        PolygonSoup beneath;
        for (const glm::dvec2 p : {glm::dvec2(-1.3, -1.3), {1.7, -1.3}, {1.7, 1.7}, {-1.3, 1.7}})
            beneath.positions.emplace_back(p, 0);
        beneath.add_polygon(std::vector<std::uint32_t>{0, 1, 2, 3});
        const Camera camera = perspective_camera({0.2 * (seed % 3), 0.15 * (seed % 3), 6}, {0, 0, 0}, 35);
        for (const int samples : {0, 2}) {
            const Drawing flush = drawn(joined({flange, beneath}), camera, samples);
            double ink = 0;  // beside the outlines
            for (int y = kPx / 2 - 40; y < kPx / 2 + 40; ++y) {
                for (int x = kPx / 2 - 60; x < kPx / 2 + 60; ++x) ink += flush.line(x, y);
            }
            EXPECT_GT(ink, 75) << seed << ", samples " << samples;
        }
    }
}

// Marks of a face that is seen, and the edges of polygons where they are asked for, are lines all the same.
TEST(Letters, InAPlateKeepWhatIsAskedFor) {
    Random random(1);
    const Camera camera = camera_before(random, false);
    const Drawing plain = drawn(plate(1), camera, 0),
                  polygons = drawn(joined({body(kL), plate(1)}), camera, 0, LineClass::polygon);
    EXPECT_GT(polygons.sum("lines.A"), plain.sum("lines.A") + 100);
    PolygonSoup marked = joined({body(kL), plate(1)});
    marked.marked_edges.push_back({2, 3});  // along the notch
    const Drawing marks = drawn(marked, camera, 0, LineClass::mark);
    EXPECT_GT(marks.sum(LineClass::mark), 20);
}

}  // namespace
}  // namespace burin::letters_test
