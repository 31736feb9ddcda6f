// A surface and its copy whose coordinates were rounded in another way look like the surface alone (decision 17).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "methods/reference/reference.h"
#include "tests/support/ink_apart.h"
#include "tests/support/layers.h"
#include "tests/support/random.h"

namespace burin::rounded_copies_test {
namespace {

using namespace test;

constexpr int kPx = 200;

PolygonSoup triangulated(const PolygonSoup& soup) {
    PolygonSoup triangles;
    triangles.positions = soup.positions;
    for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
        const auto polygon = soup.polygon(i);
        for (std::size_t k = 2; k < polygon.size(); ++k)
            triangles.add_polygon(std::vector{polygon[0], polygon[k - 1], polygon[k]});
    }
    return triangles;
}

/// A surface, turned at random, of a size of some 100 units.
PolygonSoup any_surface(Random& random, int kind) {
    const int sides = random.integer(8, 24);
    const PolygonSoup soup = kind == 0 ? make_box({100, 30, 3})
                             : kind == 1
                                 ? soup_of({{-60, 0, -40}, {60, 0, -40}, {60, 0, 40}, {-60, 0, 40}}, {{0, 1, 2, 3}})
                             : kind == 2 ? make_cylinder(30, 30, 80, sides)
                             : kind == 3 ? make_box({50, 60, 40})
                                         : make_sphere(40, sides, sides / 2);
    const glm::dvec3 x = random.direction(), z = glm::normalize(glm::cross(x, random.direction()));
    const glm::dmat3 rotation(x, glm::cross(z, x), z);
    return transformed(soup, [&](glm::dvec3 p) { return rotation * p; });
}

PolygonSoup rounded(const PolygonSoup& soup, double unit) {
    return transformed(soup, [unit](glm::dvec3 p) { return glm::round(p / unit) * unit; });
}

struct View {
    Camera camera;
    double pixel;  // a pixel's width at the middle
};

View any_view(Random& random) {
    View view;
    const double fov_deg = random.integer(0, 1) == 0 ? 8 : 30,
                 distance = 170 / (2 * std::tan(glm::radians(0.5 * fov_deg)));
    view.camera = perspective_camera(distance * random.direction(), glm::dvec3(0.0), fov_deg);
    view.pixel = 170.0 / kPx;
    if (random.integer(0, 3) == 0) {
        view.camera.orthographic = true;
        view.camera.height = 170;
    }
    return view;
}

Drawing drawn(const Scene& scene, const Camera& camera, RenderFunction render, int samples = 0) {
    Scene with_samples = scene;
    if (samples != 0) with_samples.abuffer.samples = with_samples.reference.samples = samples;
    return Drawing(with_samples, camera, kPx, kPx, {0, 0, kPx, kPx}, 2, render);
}

/// In one object or in two.
Scene scene_with(const PolygonSoup& one, const PolygonSoup& other, bool in_one) {
    return in_one ? scene_of({test::joined({one, other})}) : scene_of({one, other});
}

TEST(RoundedCopies, LookLikeOneSurface) {
    struct Way {
        const char* name;
        RenderFunction render;
        int samples, trials;
    };
    for (const Way& way : {Way{"abuffer", render_abuffer, 0, 40},
                           {"abuffer, 2 samples", render_abuffer, 2, 20},
                           {"patel", render_patel, 0, 6},
                           {"reference", render_reference, 4, 10}}) {
        for (int seed = 0; seed < way.trials; ++seed) {
            Random random(static_cast<std::uint64_t>(seed));
            const PolygonSoup surface = any_surface(random, seed % 5);
            const View view = any_view(random);
            PolygonSoup copy = rounded(surface, view.pixel / random.integer(10, 16));
            if (random.integer(0, 1) == 0 || seed % 5 == 2 || seed % 5 == 4) copy = triangulated(copy);
            const bool in_one = random.integer(0, 2) == 0, is_copy_first = random.integer(0, 1) == 0;
            const Drawing once = drawn(scene_of({surface}), view.camera, way.render, way.samples);
            const Drawing twice =
                drawn(is_copy_first ? scene_with(copy, surface, in_one) : scene_with(surface, copy, in_one),
                      view.camera, way.render, way.samples);
            const std::string what = std::string(way.name) + ", seed " + std::to_string(seed);
            EXPECT_LE(ink_apart(twice, once), 0.2) << what << ": false lines";
            EXPECT_LE(ink_apart(once, twice), 0.2) << what << ": missing lines";
            EXPECT_EQ(twice.sum(LineClass::intersection), 0) << what;
        }
    }
}

// All of it, but for the rims where the one reaches farther than the other.
TEST(RoundedCopies, ShowOneOfTheTwo) {
    for (int seed = 0; seed < 30; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const PolygonSoup surface = any_surface(random, seed % 5);
        const View view = any_view(random);
        const PolygonSoup copy = triangulated(rounded(surface, view.pixel / 10));
        const Drawing d = drawn(scene_with(surface, copy, false), view.camera, render_abuffer);
        int count[3] = {0, 0, 0};
        for (int y = 0; y < kPx; ++y) {
            for (int x = 0; x < kPx; ++x) ++count[static_cast<std::size_t>(d.at("id.object", x, y))];
        }
        EXPECT_LE(std::min(count[1], count[2]), 0.05 * (count[1] + count[2])) << seed;
    }
}

/// Ink of lines, seen or not, of one picture where the other has none within two pixels.
double all_ink_apart(const Drawing& a, const Drawing& b) {
    const auto ink = [](const Drawing& d, int x, int y) {
        return std::max(d.line(x, y), d.at("lines_hidden.A", x, y));
    };
    double apart = 0;
    for (int y = 2; y + 2 < kPx; ++y) {
        for (int x = 2; x + 2 < kPx; ++x) {
            double near = 0;
            for (int v = y - 2; v <= y + 2; ++v) {
                for (int u = x - 2; u <= x + 2; ++u) near = std::max(near, ink(b, u, v));
            }
            if (near < 0.1) apart += ink(a, x, y);
        }
    }
    return apart;
}

TEST(RoundedCopies, AmongHiddenLines) {
    for (int seed = 0; seed < 20; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const PolygonSoup surface = any_surface(random, seed % 5);
        const View view = any_view(random);
        Scene once = scene_of({surface}),
              twice = scene_with(surface, triangulated(rounded(surface, view.pixel / 12)), false);
        once.lines.style.hidden.style = twice.lines.style.hidden.style = HiddenStyle::solid;
        const Drawing expected = drawn(once, view.camera, render_abuffer),
                      d = drawn(twice, view.camera, render_abuffer);
        EXPECT_LE(all_ink_apart(d, expected), 0.5) << seed << ": false lines";
        EXPECT_LE(all_ink_apart(expected, d), 0.5) << seed << ": missing lines";
    }
}

/// One of two sheets, in `parts` rows and columns, that cross at an angle along a line through the middle of the
/// picture.
PolygonSoup crossing_sheet(double slope, int parts) {
    PolygonSoup sheet;
    for (int j = 0; j <= parts; ++j) {
        for (int i = 0; i <= parts; ++i) {
            const double x = 120.0 * i / parts - 60, y = 120.0 * j / parts - 60;
            sheet.positions.emplace_back(x, y, slope * (x + 0.2 * y));
        }
    }
    for (int j = 0; j < parts; ++j) {
        for (int i = 0; i < parts; ++i) {
            const auto first = static_cast<std::uint32_t>(j * (parts + 1) + i),
                       above = first + static_cast<std::uint32_t>(parts) + 1;
            sheet.add_polygon(std::vector{first, first + 1, above + 1, above});
        }
    }
    return sheet;
}

// They drift apart by 1/16 pixel within a few pixels, or are visibly apart elsewhere.
TEST(RoundedCopies, AreNotSurfacesThatCross) {
    for (const double angle_deg : {0.2, 0.5, 1.0, 5.0}) {
        for (const int parts : {1, 9, 40}) {
            if (angle_deg < 0.5 && parts == 40) continue;
            Camera camera = perspective_camera({0, 0, 400}, glm::dvec3(0.0), 20);
            const Scene scene = scene_of({crossing_sheet(0, parts), crossing_sheet(std::tan(glm::radians(angle_deg)),
                                                                                   parts == 1 ? 1 : parts + 2)});
            for (const RenderFunction render : {render_abuffer, render_reference}) {
                const Drawing d = drawn(scene, camera, render, render == render_reference ? 4 : 0);
                const double length_px = 120 * std::sqrt(1.04) * kPx / (800 * std::tan(glm::radians(10.0)));
                EXPECT_NEAR(d.sum(LineClass::intersection), length_px, 0.06 * length_px)
                    << angle_deg << ' ' << parts << (render == render_abuffer ? "" : " reference");
            }
        }
    }
}

}  // namespace
}  // namespace burin::rounded_copies_test
