// Features that samples miss: thinner than a sample, or several to a sample.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "mesh/build_meshes.h"
#include "mesh/shapes.h"
#include "methods/abuffer/abuffer.h"
#include "methods/reference.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

Drawing draw(const Scene& scene, const Camera& camera, int size, RenderFunction render = render_abuffer) {
    return Drawing(scene, camera, size, size, {0, 0, size, size}, 2, render);
}

Drawing truth(Scene scene, const Camera& camera, int size, int samples = 16) {
    scene.reference.samples = samples;
    return draw(scene, camera, size, render_reference);
}

double largest_error(const Drawing& a, const Drawing& b) {
    double largest = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x)
            largest = std::max(largest, std::abs(a.line(x, y) - b.line(x, y)));
    }
    return largest;
}

/// Lines where none is within a pixel.
int count_false(const Drawing& drawn, const Drawing& truth) {
    int count = 0;
    for (int y = 0; y < drawn.height(); ++y) {
        for (int x = 0; x < drawn.width(); ++x) {
            double near = 0;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, drawn.height() - 1); ++v) {
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, drawn.width() - 1); ++u) {
                    near = std::max(near, truth.line(u, v));
                }
            }
            if (drawn.line(x, y) > 0.25 && near == 0) ++count;
        }
    }
    return count;
}

/// In a picture of kSize pixels whose units are pixels: turned around the middle, and moved a little.
constexpr int kSize = 44;
PolygonSoup placed(PolygonSoup soup, double angle_deg, double depth = 0) {
    const double a = glm::radians(angle_deg);
    return transformed(std::move(soup), [=](glm::dvec3 p) {
        return glm::dvec3(22.13 + std::cos(a) * p.x - std::sin(a) * p.y,
                          21.86 + std::sin(a) * p.x + std::cos(a) * p.y, p.z + depth);
    });
}

PolygonSoup wall() {
    return placed(make_box({100, 100, 1}), 0, -30);
}

/// A prism along x whose cross section is a closed polygon (y, z), counterclockwise from +x.
PolygonSoup prism(const std::vector<glm::dvec2>& section, double half_length) {
    PolygonSoup soup;
    const auto n = static_cast<std::uint32_t>(section.size());
    for (const double x : {-half_length, half_length}) {
        for (const glm::dvec2& p : section) soup.positions.push_back({x, p.x, p.y});
    }
    std::vector<std::uint32_t> front, back;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        soup.add_polygon(std::vector<std::uint32_t>{i, j, n + j, n + i});
        front.push_back(n + i);
        back.push_back(n - 1 - i);
    }
    soup.add_polygon(front);
    soup.add_polygon(back);
    return soup;
}

const double kAngles_deg[] = {0, 3, 17, 45, 62, 90};

TEST(FineLines, ARodThinnerThanASampleHasNoDropouts) {
    for (const double angle : kAngles_deg) {
        for (const double width : {0.2, 0.1}) {
            const Scene scene = scene_of({placed(make_box({30, width, width}), angle), wall()});
            const Camera camera = pixel_camera(kSize, kSize);
            const Drawing drawn = draw(scene, camera, kSize);
            EXPECT_LT(largest_error(drawn, truth(scene, camera, kSize)), 0.15)
                << angle << " deg, " << width << " px";
            const double a = glm::radians(angle);
            const glm::dvec2 middle(22.13, kSize - 21.86), along(std::cos(a), -std::sin(a));
            EXPECT_EQ(drawn.drawn_share(middle - 14.0 * along, middle + 14.0 * along, 0), 1.0) << angle;
        }
    }
}

// Facets beside a contour are narrower than the grid of corners: rounding turns them over.
TEST(FineLines, ARoundWireThinnerThanASampleHasNoDropouts) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const double radius = random.real(0.05, 0.2), turn = random.real(0, 6), angle = random.real(0, 180);
        const int sides = random.integer(6, 48);
        std::vector<glm::dvec2> section;
        for (int i = 0; i < sides; ++i) {
            const double a = turn + 2 * M_PI * i / sides;
            section.emplace_back(radius * std::cos(a), radius * std::sin(a));
        }
        const Scene scene = scene_of({placed(prism(section, 15), angle), wall()});
        const Drawing drawn = draw(scene, pixel_camera(kSize, kSize), kSize);
        const double a = glm::radians(angle);
        const glm::dvec2 middle(22.13, kSize - 21.86), along(std::cos(a), -std::sin(a));
        EXPECT_EQ(drawn.drawn_share(middle - 14.0 * along, middle + 14.0 * along, 0), 1.0)
            << "seed " << seed << ": " << radius << " px, " << sides << " sides, " << angle << " deg";
    }
}

TEST(FineLines, BothEdgesOfANarrowChamferAreDrawn) {
    for (const double angle : kAngles_deg) {
        const double c = 0.1;
        const Scene scene = scene_of(
            {placed(prism({{-10, -6}, {10, -6}, {10, -5.5}, {0, 5}, {-c, 5}, {-c - 10, -5.5}}, 14), angle)});
        const Camera camera = pixel_camera(kSize, kSize);
        const Drawing drawn = draw(scene, camera, kSize), expected = truth(scene, camera, kSize);
        EXPECT_LT(largest_error(drawn, expected), 0.15) << angle;
        EXPECT_NEAR(drawn.sum("lines.A") / expected.sum("lines.A"), 1, 0.01) << angle;
    }
}

// One of them is the box's contour, the other one a crease that samples see in places.
TEST(FineLines, BothEdgesOfANarrowRimAreDrawn) {
    for (const double rim_px : {0.14, 0.2, 0.26}) {
        for (const double angle : {11.0, 40.0, 75.0}) {
            const double tilt = std::asin(rim_px / 3);
            const PolygonSoup box = transformed(make_box({26, 24, 3}), [=](glm::dvec3 p) {
                return glm::dvec3(std::cos(tilt) * p.x + std::sin(tilt) * p.z, p.y, std::cos(tilt) * p.z - std::sin(tilt) * p.x);
            });
            Scene scene = scene_of({placed(box, angle)});
            scene.lines.style.width_px = 0.3;
            const Camera camera = pixel_camera(kSize, kSize);
            const Drawing drawn = draw(scene, camera, kSize), expected = truth(scene, camera, kSize, 32);
            EXPECT_LT(largest_error(drawn, expected), 0.1) << rim_px << " px, " << angle << " deg";
            EXPECT_NEAR(drawn.sum("lines.A") / expected.sum("lines.A"), 1, 0.01) << rim_px << " px, " << angle << " deg";
        }
    }
}

// Surfaces have two sides: it does not matter which way the faces beside an edge are wound.
TEST(FineLines, BothEdgesOfANarrowChamferAreDrawnHoweverItIsWound) {
    const auto chamfer = [](bool is_turned) {
        const std::vector<std::uint32_t> wide = is_turned ? std::vector<std::uint32_t>{2, 1, 0} : std::vector<std::uint32_t>{0, 1, 2};
        return soup_of({{-0.1016, -1.2852, -0.3555}, {0.6328, -1.2852, 1.2695}, {-0.1016, -1.2852, 1.2695}, {-0.1172, -1.2695, -0.3555}}, {wide, {3, 0, 2}});
    };
    for (int k = 0; k < 8; ++k) {
        // Seen nearly from beside: the chamfer is half a pixel high.
        const Camera camera = perspective_camera({-3.5156, -1.3125 - 0.004 * k, -6.2969}, {0.2344, -0.3594, 0.3281}, 22.1875);
        const auto drawn = [&](bool is_turned) { return Drawing(scene_of({chamfer(is_turned)}), camera, 320, 240, {0, 0, 320, 240}, 2, render_abuffer); };
        EXPECT_LT(largest_error(drawn(false), drawn(true)), 0.01) << k;
    }
}

TEST(FineLines, AStepLowerThanASampleIsDrawn) {
    for (const double angle : kAngles_deg) {
        // Half of the plate behind the box reaches beyond it by 0.15 pixels, in front of a wall.
        const auto moved = [](glm::dvec3 size, glm::dvec3 by) {
            return transformed(make_box(size), [=](glm::dvec3 p) { return p + by; });
        };
        const Scene scene = scene_of(
            {placed(make_box({28, 16, 5}), angle), placed(moved({14, 16, 5}, {0, 0.15, -5}), angle), wall()});
        const Camera camera = pixel_camera(kSize, kSize);
        EXPECT_LT(largest_error(draw(scene, camera, kSize), truth(scene, camera, kSize)), 0.15) << angle;
    }
}

// At the vertex where it ends, rounding says which triangle is beside it.
TEST(FineLines, AContourEndsWhereItsFoldDoes) {
    Scene scene = scene_of({soup_of({{0.8173828125, 0.7860107421875, 2.028564453125},
                                     {0.8369140625, 0.7899169921875, 1.950439453125},
                                     {0.8251953125, 0.7703857421875, 1.946533203125},
                                     {0.8837890625, 0.6258544921875, 2.016845703125},
                                     {0.8876953125, 0.6453857421875, 1.958251953125},
                                     {0.8486328125, 0.7274169921875, 1.946533203125},
                                     {0.8017578125, 0.7469482421875, 1.919189453125}},
                                    {{5, 6, 2}, {5, 1, 0}, {3, 4, 5}, {3, 5, 0}})});
    scene.lines.classes = LineClass::silhouette;
    const Camera camera = perspective_camera({-0.71484375, 2.74609375, 4.2578125}, {1.29296875, 0.73828125, 2.25}, 22.125);
    const auto ink_beyond = [&](RenderFunction render) {
        const Drawing drawn(scene, camera, 320, 240, {0, 0, 320, 240}, 2, render);
        double ink = 0;
        for (int y = 131; y < 134; ++y) {
            for (int x = 63; x < 68; ++x) ink += drawn.line(x, y);
        }
        return ink;
    };
    EXPECT_NEAR(ink_beyond(render_reference), 0, 0.1);
    EXPECT_NEAR(ink_beyond(render_abuffer), 0, 0.1);
}

// As isosurfaces have where they pass by a corner of their grid. Rounding turns some of the triangles over.
TEST(FineLines, TrianglesSmallerThanTheGridOfCornersHaveNoContours) {
    constexpr double kRadius_px = 12;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        const int sides = random.integer(5, 9);
        PolygonSoup dome;
        dome.positions.push_back({0, 0, 0});
        const auto n = static_cast<std::uint32_t>(sides);
        const auto add = [&](std::vector<std::uint32_t> corners) {
            if (random.integer(0, 1) == 0) std::reverse(corners.begin(), corners.end());
            dome.add_polygon(corners);
        };
        for (const double radius : {random.real(0.002, 0.01), random.real(0.01, 0.03), 1.0, kRadius_px}) {
            const auto first = static_cast<std::uint32_t>(dome.positions.size());
            for (int i = 0; i < sides; ++i) {
                const double a = 2 * M_PI * (i + random.real(0, 0.2)) / sides;
                dome.positions.push_back({radius * std::cos(a), radius * std::sin(a), -0.01 * radius * radius});
            }
            for (std::uint32_t i = 0; i < n; ++i) {
                const std::uint32_t j = (i + 1) % n, a = first + i, b = first + j;
                if (first == 1) {
                    add({0, a, b});
                } else {
                    add({a - n, a, b});
                    add({a - n, b, b - n});
                }
            }
        }
        const double x = random.real(-1, 1), y = random.real(-1, 1);
        for (glm::dvec3& p : dome.positions) p += glm::dvec3(x, y, 0);
        for (const bool is_hidden : {false, true}) {
            std::vector<PolygonSoup> objects{placed(dome, 0)};
            if (is_hidden) objects.push_back(placed(make_box({100, 100, 1}), 0, 30));
            Scene scene = scene_of(objects);
            scene.lines.classes = LineClass::silhouette;
            scene.lines.style.hidden.style = HiddenStyle::solid;
            const Drawing drawn = draw(scene, pixel_camera(kSize, kSize), kSize);
            double ink = 0;
            for (int v = 19; v < 25; ++v) {
                for (int u = 19; u < 25; ++u) ink += drawn.at(is_hidden ? "lines_hidden.A" : "lines.A", u, v);
            }
            EXPECT_EQ(ink, 0) << "seed " << seed << (is_hidden ? ", hidden" : "");
        }
    }
}

// What is left where vertices were merged, or a vertex lies in the middle of another triangle's edge.
TEST(FineLines, NeedlesOnAnEdgeMakeNoLines) {
    constexpr double kDots = 2;  // where a sample falls on a needle
    for (const int needles : {1, 2}) {
        for (std::uint64_t seed = 0; seed < 40; ++seed) {
            Random random(seed);
            // Two halves of a square that are level, and needles on the edge between them.
            PolygonSoup square = soup_of({{-12, -12, 0}, {12, -12, 0}, {12, 12, 0}, {-12, 12, 0}}, {{0, 1, 2}, {0, 2, 3}});
            for (int i = 0; i < needles; ++i) {
                const double along = random.real(-8, 8);
                const auto middle = static_cast<std::uint32_t>(square.positions.size());
                square.positions.push_back(glm::dvec3(along, along, 0) + 1e-5 * random.direction());
                square.add_polygon(std::vector<std::uint32_t>{0, 2, middle});
            }
            const glm::dvec3 axis = random.direction();
            const double tilt = random.real(-0.5, 0.5);
            const PolygonSoup turned = transformed(square, [&](glm::dvec3 p) {
                return glm::dvec3(glm::rotate(glm::dmat4(1.0), tilt, axis) * glm::dvec4(p, 1));
            });
            std::vector<PolygonSoup> objects{placed(turned, random.real(0, 360))};
            for (const char* const layer : {"lines.A", "lines_hidden.A"}) {
                Scene scene = scene_of(objects);
                scene.lines.style.hidden.style = HiddenStyle::solid;
                const Drawing drawn = draw(scene, pixel_camera(kSize, kSize), kSize);
                double ink = 0;
                for (int y = 17; y < 27; ++y) {
                    for (int x = 17; x < 27; ++x) ink += drawn.at(layer, x, y);
                }
                EXPECT_LT(ink, kDots) << needles << ", " << layer << ", seed " << seed;
                objects.push_back(placed(make_box({100, 100, 1}), 0, 30));
            }
        }
    }
}

// The patch behind a needle at its border is what meets the other patch.
TEST(FineLines, ACreaseBetweenPatchesGoesOnBesideANeedle) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        const double along = random.real(-8, 8);
        const glm::dvec3 beside = glm::dvec3(along, 0, 0) + 1e-5 * random.direction();
        // A floor with a needle at its border, and a wall that is not stitched to it.
        const PolygonSoup corner = soup_of({{-12, 0, 0}, {12, 0, 0}, {12, 12, 0}, {-12, 12, 0}, beside, {-12.5, 0, 0}, {12.5, 0, 0}, {12.5, 0, 12}, {-12.5, 0, 12}},
                                           {{0, 1, 2, 3}, {0, 4, 1}, {5, 6, 7, 8}});
        const PolygonSoup turned = transformed(corner, [&](glm::dvec3 p) {
            return glm::dvec3(glm::rotate(glm::dmat4(1.0), -0.8, glm::dvec3(1, 0, 0)) * glm::dvec4(p, 1));
        });
        const double angle = random.real(0, 360), a = glm::radians(angle);
        const Drawing drawn = draw(scene_of({placed(turned, angle)}), pixel_camera(kSize, kSize), kSize);
        const glm::dvec2 middle(22.13, kSize - 21.86), way(std::cos(a), -std::sin(a));
        EXPECT_EQ(drawn.drawn_share(middle - 11.0 * way, middle + 11.0 * way, 0), 1.0) << "seed " << seed;
    }
}

// A needle at one border of a strip narrower than a sample: the strip's other border is no patch that goes on there.
TEST(FineLines, ANarrowStripKeepsItsBorderBesideANeedle) {
    for (const double distance : {2.0, 3.0, 6.0, 12.0}) {
        const auto ink = [&](bool has_needle) {
            const double third = 1.0 / 3, low = 0.05, high = 0.0532;
            PolygonSoup strip = soup_of({{-1, -low, 0}, {-1, -0.0468, 1e-4}, {-third, -third * low, 0}, {-third, 0.0032 - third * low, 1e-4},
                                         {third, third * low, 0}, {third, 0.0032 + third * low, 1e-4}, {1, low, 0}, {1, high, 1e-4}, {0.05, 0.0025, 2e-7}},
                                        {{0, 2, 3}, {0, 3, 1}, {2, 8, 3}, {8, 4, 5}, {8, 5, 3}, {4, 6, 7}, {4, 7, 5}});
            if (has_needle) strip.add_polygon(std::vector<std::uint32_t>{2, 4, 8});
            const Drawing drawn(scene_of({strip}), perspective_camera({0.3, 0.2, distance}, {0, 0, 0}), 160, 120, {0, 0, 160, 120}, 2, render_abuffer);
            double sum = 0;
            for (int y = 0; y < 120; ++y) {
                for (int x = 0; x < 160; ++x) sum += drawn.line(x, y);
            }
            return sum;
        };
        EXPECT_GT(ink(true) / ink(false), 0.98) << distance;
    }
}

TEST(FineLines, AcuteTipsAreNotCutShort) {
    for (const double angle : kAngles_deg) {
        PolygonSoup needle = soup_of({{-10, -2, 0}, {10, 0, 0}, {-10, 2, 0}, {-10, 0, -2}},
                                     {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}});
        const Scene tip = scene_of({placed(needle, angle), wall()});
        const Camera camera = pixel_camera(kSize, kSize);
        EXPECT_LT(largest_error(draw(tip, camera, kSize), truth(tip, camera, kSize, 32)), 0.15) << angle;
    }
}

TEST(FineLines, BothSidesOfANarrowGapAreDrawn) {
    for (const double angle : kAngles_deg) {
        const auto half = [&](double side) {
            return placed(transformed(make_box({28, 12, 5}),
                                      [=](glm::dvec3 p) { return p + glm::dvec3(0, side * 6.075, 0); }),
                          angle);
        };
        const Scene scene = scene_of({half(1), half(-1), wall()});
        const Camera camera = pixel_camera(kSize, kSize);
        EXPECT_LT(largest_error(draw(scene, camera, kSize), truth(scene, camera, kSize)), 0.06) << angle;
    }
}

// The surface beyond the gap is as near as the one that ends at it.
TEST(FineLines, BothSidesOfNarrowGapsBetweenPlanksAreDrawn) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        const bool is_solid = random.integer(0, 1) == 0;
        const double angle = random.integer(0, 1) == 0 ? 90.0 * random.integer(0, 3) : random.real(0, 180);
        std::vector<PolygonSoup> planks{wall()};
        double y = -15;
        if (seed % 4 == 0) y = -15.25;  // edges along rows of samples
        while (y < 12) {
            const double height = seed % 4 == 0 ? random.integer(1, 4) : random.real(1, 6);
            const auto rise = [=](glm::dvec3 p) { return p + glm::dvec3(0, y + 0.5 * height, 0); };
            const PolygonSoup sheet = soup_of({{-11, -0.5 * height, 0}, {11, -0.5 * height, 0}, {11, 0.5 * height, 0}, {-11, 0.5 * height, 0}},
                                              {{0, 1, 2, 3}});
            planks.push_back(placed(transformed(is_solid ? make_box({22, height, 4}) : sheet, rise), angle));
            y += height + (seed % 4 == 0 ? 0.125 * random.integer(1, 3) : random.real(0.05, 0.45));
        }
        Scene scene = scene_of(planks);
        scene.lines.style.width_px = random.integer(0, 1) == 0 ? 0.3 : 1;
        const Camera camera = pixel_camera(kSize, kSize);
        EXPECT_LT(largest_error(draw(scene, camera, kSize), truth(scene, camera, kSize, 32)), 0.12) << "seed " << seed;
    }
}

// In its middle nothing runs along it.
TEST(FineLines, ABorderThatIsASeamInPartIsNoneThere) {
    for (const double share : {0.3, 0.45, 0.7}) {
        PolygonSoup floor = soup_of({{-5, 0, 0}, {5, 0, 0}, {5, 0, 3}, {-5, 0, 3}}, {{0, 1, 2, 3}});
        constexpr int kPatches = 4;
        for (int i = 0; i < kPatches; ++i) {
            const double from = -5 + 10 * share * i / kPatches, to = -5 + 10 * share * (i + 1) / kPatches;
            const auto first = static_cast<std::uint32_t>(floor.positions.size());
            for (const auto& [x, z] : {std::pair(from, -3 + 0.2 * (i % 2)), {to, -3 + 0.2 * (i % 2)}, {to, 0.0}, {from, 0.0}}) floor.positions.emplace_back(x, 0, z);
            floor.add_polygon(std::vector<std::uint32_t>{first, first + 1, first + 2, first + 3});
        }
        for (const double height : {4.0, 10.0}) {
            const Camera camera = perspective_camera({4.48288, height, 16.7303}, {0, 0, 0}, 35);
            const auto ink = [&](RenderFunction render) {
                return Drawing(scene_of({floor}), camera, 120, 120, {0, 0, 120, 120}, 2, render).sum("lines.A");
            };
            EXPECT_NEAR(ink(render_abuffer) / ink(render_reference), 1, 0.01) << share << ", " << height;
        }
    }
}

TEST(FineLines, ACrackBesideAPartOfABorderIsNoLine) {
    for (const double crack : {0.004, 0.02, 0.1, 0.2, 0.4}) {
        for (const double share : {0.3, 0.45, 0.7}) {
            for (const double y : {0.0, 0.13, 0.25}) {
                const double end = -12 + 24 * share;
                const PolygonSoup patches = soup_of({{-12, y, 0}, {12, y, 0}, {12, 9, 0}, {-12, 9, 0}, {-12, -9, 0}, {end, -9, 0}, {end, y - crack, 0}, {-12, y - crack, 0}},
                                                    {{0, 1, 2, 3}, {4, 5, 6, 7}});
                const Scene scene = scene_of({placed(patches, 0), wall()});
                const Camera camera = pixel_camera(kSize, kSize);
                EXPECT_LT(largest_error(draw(scene, camera, kSize), truth(scene, camera, kSize)), 0.4)
                    << "crack " << crack << ", share " << share << ", y " << y;
            }
        }
    }
}

/// Closer than 1/64 pixel with no sample between them: wherever blocks of pixels, their cells and tiles end.
TEST(FineLines, PlatesInContactHaveNoBorders) {
    constexpr int kWide = 96;
    for (const double end : {16.25, 20.25, 33.1, 48.25, 56.25, 64.25}) {
        for (const double gap : {1 / 256.0, 2 / 256.0, 3 / 256.0}) {
            for (const bool is_level : {false, true}) {
                const auto plate = [&](double from, double to) {
                    PolygonSoup soup = soup_of({{from, 5, 0}, {to, 5, 0}, {to, 91, 0}, {from, 91, 0}}, {{0, 1, 2, 3}});
                    return is_level ? transformed(soup, [](glm::dvec3 p) { return glm::dvec3(p.y, kWide - p.x, p.z); }) : soup;
                };
                Scene scene = scene_of({plate(5.3, end - gap), plate(end, 90.3)});
                scene.lines.classes = LineClass::border;
                const Drawing drawn = draw(scene, pixel_camera(kWide, kWide), kWide);
                double ink = 0;
                for (int along = 8; along < 88; ++along) {
                    for (int across = 8; across < 88; ++across) ink += is_level ? drawn.line(along, across) : drawn.line(across, along);
                }
                EXPECT_EQ(ink, 0) << end << ", gap " << gap << (is_level ? ", level" : "");
            }
        }
    }
}

/// Bars between two rows of samples, one after the other, whose ends are in contact: wherever tiles end, as they do elsewhere in a crop.
TEST(FineLines, ContactsDoNotHangOnTiles) {
    constexpr int kWide = 96;
    const PixelRect crop{40, 0, 80, kWide};
    for (const int gap : {1, 2, 3}) {
        PolygonSoup bars[2];
        for (const double end : {48.25, 56.25, 64.25, 72.25}) {
            for (int before = 1; before < 3; ++before) {
                for (PolygonSoup& soup : bars) {
                    const bool is_left = &soup == bars;
                    const double edge = end + (is_left ? -before : gap - before) / 256.0, other = edge + (is_left ? -3 : 3);
                    const double y = 3 * before + std::floor(end / 2) + 0.3;
                    const auto first = static_cast<std::uint32_t>(soup.positions.size());
                    for (const auto& [px, py] : {std::pair(edge, y), {other, y}, {other, y + 0.4}, {edge, y + 0.4}}) soup.positions.emplace_back(px, py, 0);
                    soup.add_polygon(std::vector<std::uint32_t>{first, first + 1, first + 2, first + 3});
                }
            }
        }
        for (PolygonSoup& soup : bars) soup.object_names = {"bars"};
        Scene scene = scene_of({bars[0], bars[1]});
        scene.lines.classes = LineClass::border;
        scene.lines.style.width_px = 0.25;
        const Camera camera = pixel_camera(kWide, kWide);
        const Drawing whole = draw(scene, camera, kWide), part(scene, camera, kWide, kWide, crop, 2, render_abuffer);
        for (int y = crop.y0; y < crop.y1; ++y) {
            for (int x = crop.x0; x < crop.x1; ++x) ASSERT_EQ(part.line(x - crop.x0, y - crop.y0), whole.line(x, y)) << x << ", " << y << ", gap " << gap;
        }
    }
}

/// Where two edges cross at a small angle the gap between them gets narrower than any sample.
TEST(FineLines, BothLinesOfASlenderCornerAreDrawn) {
    for (const double depth : {-1.5, -6.0}) {
        for (const double angle : {3.0, 21.0, 48.0}) {
            for (const double between : {7.0, 12.0}) {
                const Scene scene = scene_of({placed(make_box({36, 2.7, 1}), angle),
                                              placed(make_box({36, 2.7, 1}), angle + between, depth), wall()});
                const Camera camera = pixel_camera(kSize, kSize);
                EXPECT_LT(largest_error(draw(scene, camera, kSize), truth(scene, camera, kSize, 32)), 0.08)
                    << angle << " and " << angle + between << " deg, " << depth << " px";
            }
        }
    }
}

TEST(FineLines, SheetsThatPassThroughEachOtherEndWhereTheyMeet) {
    for (int i = 0; i < 12; ++i) {
        const auto sheet = [&](double turn_deg, double tilt) {
            return placed(transformed(make_plane(26, 26, 1, 1), [=](glm::dvec3 p) { return glm::dvec3(p.x, p.z, tilt * p.x); }),
                          turn_deg + 29.3 * i);
        };
        const Scene scene = scene_of({sheet(0, 0.7), sheet(74, 0.9)});
        const Camera camera = pixel_camera(kSize, kSize);
        EXPECT_LT(largest_error(draw(scene, camera, kSize), truth(scene, camera, kSize, 32)), 0.08) << i;
    }
}

/// A rough ball with several triangles to a pixel, slivers around it, and rods thinner than a sample.
Scene rough_scene(std::uint64_t seed, int segments) {
    Random random(seed);
    PolygonSoup ball = make_torus(0.8, 0.45, segments, segments / 2);
    for (glm::dvec3& p : ball.positions) p += 0.012 * random.direction();
    PolygonSoup slivers;
    for (std::uint32_t i = 0; i < 60; ++i) {
        const glm::dvec3 center = random.in_box(1.2), along = random.direction() * 0.5;
        slivers.positions.push_back(center - along);
        slivers.positions.push_back(center + along);
        slivers.positions.push_back(center + along + 0.03 * random.direction());
        slivers.add_polygon(std::vector<std::uint32_t>{3 * i, 3 * i + 1, 3 * i + 2});
    }
    std::vector<PolygonSoup> objects{ball, slivers};
    for (int i = 0; i < 6; ++i) {
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), random.real(0, 3), random.direction());
        const glm::dvec3 at = random.in_box(0.8);
        objects.push_back(transformed(make_box({1.4, 0.008, 0.008}), [=](glm::dvec3 p) {
            return glm::dvec3(turn * glm::dvec4(p, 1.0)) + at;
        }));
    }
    return scene_of(std::move(objects));
}

const glm::dvec3 kEye(2.3, 1.7, 4.1);

TEST(FineLines, NothingHiddenAppears) {
    constexpr int kPicture = 60;
    for (std::uint64_t seed = 0; seed < 2; ++seed) {
        const Scene scene = rough_scene(seed, 60 + 40 * static_cast<int>(seed));
        const Camera camera = perspective_camera(kEye, {0, 0, 0});
        const Drawing drawn = draw(scene, camera, kPicture), expected = truth(scene, camera, kPicture, 32);
        EXPECT_EQ(count_false(drawn, expected), 0) << "seed " << seed;
        EXPECT_LE(count_false(expected, drawn), 1) << "seed " << seed;
        // The tips of slivers are thinner than the truth's samples, too.
        EXPECT_NEAR(drawn.sum("lines.A") / expected.sum("lines.A"), 1, 0.03) << "seed " << seed;
    }
}

/// A prism within a box ends exactly in the box's face, which is seen there as the first of the two; of one on top
/// of the box, the foot is seen.
TEST(FineLines, OfFlushFacesTheFirstIsSeen) {
    const auto prism = [](double middle) {
        PolygonSoup soup = make_cylinder(0.3, 0.3, 0.6, 6);
        return transformed(std::move(soup), [=](glm::dvec3 p) { return p + glm::dvec3(0.05, middle, 0.02); });
    };
    const auto as_one_mesh = [](PolygonSoup a, const PolygonSoup& b) {
        const auto first_vertex = static_cast<std::uint32_t>(a.positions.size());
        const auto first_corner = static_cast<std::uint32_t>(a.corners.size());
        a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
        for (const std::uint32_t c : b.corners) a.corners.push_back(first_vertex + c);
        for (const std::uint32_t end : b.polygon_ends) a.polygon_ends.push_back(first_corner + end);
        return a;
    };
    const Camera camera = perspective_camera({1.3, 2.6, 2.1}, {0, 0.4, 0});
    for (const double middle : {0.2, 0.8}) {
        const PolygonSoup box = make_box({1, 1, 1});
        for (const Scene& scene : {scene_of({box, prism(middle)}), scene_of({as_one_mesh(box, prism(middle))})}) {
            const Drawing drawn = draw(scene, camera, kSize), expected = truth(scene, camera, kSize);
            EXPECT_EQ(count_false(drawn, expected), 0) << middle << ' ' << scene.objects.size();
            EXPECT_EQ(count_false(expected, drawn), 0) << middle << ' ' << scene.objects.size();
        }
    }
    // At exactly one depth all over.
    const auto in_the_middle = [](glm::dvec3 size) {
        return transformed(make_box(size), [](glm::dvec3 p) { return p + glm::dvec3(kSize / 2.0 + 0.13, kSize / 2.0 + 0.27, 30); });
    };
    const Scene scene = scene_of({in_the_middle({40, 40, 20}), in_the_middle({17, 11, 20})});
    const Drawing drawn = draw(scene, pixel_camera(kSize, kSize), kSize);
    EXPECT_GT(drawn.sum("lines.A"), 100);
    EXPECT_EQ(count_false(drawn, truth(scene, pixel_camera(kSize, kSize), kSize)), 0);
}

// A folded quad, and its two triangles once more as objects of their own, each of which ends along the fold.
// Of what meets at an edge the ones in front count, be a corner of the others welded to it or not.
TEST(FineLines, AFinThatTouchesFromBehindIsNotSeen) {
    const Camera camera = perspective_camera({1.5, 0.9, 3}, {0.5, 0, 0});
    const auto sheet_with_fin_at = [](double z) {
        return soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.1}, {1, -1, -0.1}, {0, 0, z}, {0.5, 0.3, -1}}, {{0, 1, 3}, {1, 0, 4}, {5, 1, 6}});
    };
    const Drawing welded = draw(scene_of({sheet_with_fin_at(0)}), camera, 160);
    for (const double z : {-1e-6, -1e-5, -1e-4, -1e-3, -3e-3}) {
        EXPECT_LE(largest_error(draw(scene_of({sheet_with_fin_at(z)}), camera, 160), welded), 0.3) << z;
    }
}

TEST(FineLines, WhatLiesInAFoldedPolygonHasNoOutline) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const std::vector<glm::dvec3> corners{{0.8, 0.3, 0.02}, {0, 0, 0}, {-0.05, -0.12, 0.001 * random.real(-1, 1)}, {0.75, 0.1, 0}};
        const PolygonSoup quad = soup_of(corners, {{3, 2, 1, 0}});
        std::vector<PolygonSoup> objects{quad};
        const Mesh mesh = build_meshes(quad, {}).front();
        for (const auto& t : mesh.triangles) {
            objects.push_back(soup_of({glm::dvec3(mesh.positions[t[0]]), glm::dvec3(mesh.positions[t[1]]), glm::dvec3(mesh.positions[t[2]])}, {{0, 1, 2}}));
        }
        const glm::dvec3 middle(0.38, 0.08, 0);
        const Camera camera = perspective_camera(middle + 1.6 * random.direction(), middle);
        const Drawing alone = draw(scene_of({quad}), camera, 200), all = draw(scene_of(objects), camera, 200);
        EXPECT_NEAR(all.sum("lines.A"), alone.sum("lines.A"), 4) << "seed " << seed;
    }
}

TEST(FineLines, ThePreviewLeavesThemOutUnlessAskedFor) {
    Scene scene = scene_of({placed(make_box({30, 0.2, 0.2}), 17), wall()});
    const Camera camera = pixel_camera(kSize, kSize);
    const auto draw_with = [&](std::optional<int> samples, std::optional<bool> fine_lines) {
        scene.abuffer.samples = samples;
        scene.abuffer.fine_lines = fine_lines;
        return draw(scene, camera, kSize);
    };
    EXPECT_EQ(largest_error(draw_with({}, {}), draw_with(2, true)), 0);
    EXPECT_EQ(largest_error(draw_with(2, {}), draw_with(2, false)), 0);
    EXPECT_GT(largest_error(draw_with(2, {}), draw_with(2, true)), 0.3);
    EXPECT_EQ(largest_error(draw_with(4, {}), draw_with(4, true)), 0);
    EXPECT_GT(largest_error(draw_with(4, {}), draw_with(4, false)), 0.1);
}

TEST(FineLines, HundredsOfTrianglesToAPixelAreLookedThrough) {
    constexpr int kFewPixels = 40;
    PolygonSoup bumpy = make_torus(0.8, 0.45, 500, 250);
    for (glm::dvec3& p : bumpy.positions) p += 0.05 * glm::sin(21.0 * glm::dvec3(p.y, p.z, p.x));
    Scene scene = scene_of({bumpy});
    for (const glm::dvec3 eye : {kEye, glm::dvec3(4.3, 0.7, 1.1)}) {
        const Camera camera = perspective_camera(eye, {0, 0, 0});
        const Drawing real = truth(scene, camera, kFewPixels, 32);
        const auto error_with = [&](bool has_fine_lines) {
            scene.abuffer.fine_lines = has_fine_lines;
            const Drawing drawn = draw(scene, camera, kFewPixels);
            double sum = 0;
            for (int y = 0; y < kFewPixels; ++y) {
                for (int x = 0; x < kFewPixels; ++x) sum += std::abs(drawn.line(x, y) - real.line(x, y));
            }
            return sum / real.sum("lines.A");
        };
        EXPECT_LT(error_with(true), 0.045);
        EXPECT_GT(error_with(false), 0.06);
    }
}

TEST(FineLines, ThreadsTilesAndCropsChangeNothing) {
    constexpr int kPicture = 110;
    const Scene scene = rough_scene(7, 90);
    const Camera camera = perspective_camera(kEye, {0, 0, 0});
    const auto render = [&](PixelRect crop, int threads, int tile_samples, std::uint64_t memory_bytes = 0) {
        const Frame frame = make_frame(scene, camera, kPicture, kPicture, crop);
        Film film({0, 0, kPicture, kPicture}, crop, LayerSet{true, true, true, true, true, true, true, true},
                  frame.criteria.classes);
        RunOptions options;
        options.threads = threads;
        options.tile_samples = tile_samples;
        options.memory_bytes = memory_bytes;
        render_abuffer(frame, options, film);
        return film.image();
    };
    const PixelRect all{0, 0, kPicture, kPicture};
    const Image whole = render(all, 1, 128);
    EXPECT_TRUE(same_bits(whole, render(all, 3, 128)));
    EXPECT_TRUE(same_bits(whole, render(all, 2, 32)));
    EXPECT_TRUE(same_bits(whole, render(all, 2, 32, 24 << 20)));
    for (const PixelRect crop :
         {PixelRect{37, 21, 84, 80}, PixelRect{51, 50, 52, 51}, PixelRect{0, 63, 110, 71}}) {
        const Image part = render(crop, 2, 64);
        for (const Channel& channel : part.channels()) {
            const Channel& full = *whole.find(channel.name);
            for (int y = 0; y < crop.height(); ++y) {
                for (int x = 0; x < crop.width(); ++x) {
                    ASSERT_EQ(part.value(channel, x, y), whole.value(full, x + crop.x0, y + crop.y0))
                        << channel.name << " " << x << "," << y;
                }
            }
        }
    }
}

}  // namespace
}  // namespace burin
