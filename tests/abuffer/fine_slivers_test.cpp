// Lines that samples miss, at slivers: folds narrower than the grid of corners, and needles.

#include <gtest/gtest.h>

#include "tests/abuffer/fine_drawings.h"

namespace burin::fine_slivers_test {
namespace {

using namespace test;

// At the vertex where it ends, rounding says which triangle is beside it.
TEST(FineSlivers, AContourEndsWhereItsFoldDoes) {
    Scene scene = scene_of({soup_of({{0.8173828125, 0.7860107421875, 2.028564453125},
                                     {0.8369140625, 0.7899169921875, 1.950439453125},
                                     {0.8251953125, 0.7703857421875, 1.946533203125},
                                     {0.8837890625, 0.6258544921875, 2.016845703125},
                                     {0.8876953125, 0.6453857421875, 1.958251953125},
                                     {0.8486328125, 0.7274169921875, 1.946533203125},
                                     {0.8017578125, 0.7469482421875, 1.919189453125}},
                                    {{5, 6, 2}, {5, 1, 0}, {3, 4, 5}, {3, 5, 0}})});
    scene.lines.classes = LineClass::silhouette;
    const Camera camera =
        perspective_camera({-0.71484375, 2.74609375, 4.2578125}, {1.29296875, 0.73828125, 2.25}, 22.125);
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

// Isosurfaces have such triangles where they pass by a corner of their grid. Rounding turns some of the triangles over.
TEST(FineSlivers, TrianglesSmallerThanTheGridOfCornersHaveNoContours) {
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
            const Drawing drawn = draw_fine(scene, pixel_camera(kFineSize, kFineSize), kFineSize);
            double ink = 0;
            for (int v = 19; v < 25; ++v) {
                for (int u = 19; u < 25; ++u) ink += drawn.at(is_hidden ? "lines_hidden.A" : "lines.A", u, v);
            }
            EXPECT_EQ(ink, 0) << "seed " << seed << (is_hidden ? ", hidden" : "");
        }
    }
}

// What is left where vertices were merged, or a vertex lies in the middle of another triangle's edge.
TEST(FineSlivers, NeedlesOnAnEdgeMakeNoLines) {
    constexpr double kDots = 2;  // where a sample falls on a needle
    for (const int needles : {1, 2}) {
        for (std::uint64_t seed = 0; seed < 40; ++seed) {
            Random random(seed);
            // Two halves of a square that are level, and needles on the edge between them.
            PolygonSoup square =
                soup_of({{-12, -12, 0}, {12, -12, 0}, {12, 12, 0}, {-12, 12, 0}}, {{0, 1, 2}, {0, 2, 3}});
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
                const Drawing drawn = draw_fine(scene, pixel_camera(kFineSize, kFineSize), kFineSize);
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
TEST(FineSlivers, ACreaseBetweenPatchesGoesOnBesideANeedle) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        const double along = random.real(-8, 8);
        const glm::dvec3 beside = glm::dvec3(along, 0, 0) + 1e-5 * random.direction();
        // A floor with a needle at its border, and a wall that is not stitched to it.
        const PolygonSoup corner = soup_of({{-12, 0, 0},
                                            {12, 0, 0},
                                            {12, 12, 0},
                                            {-12, 12, 0},
                                            beside,
                                            {-12.5, 0, 0},
                                            {12.5, 0, 0},
                                            {12.5, 0, 12},
                                            {-12.5, 0, 12}},
                                           {{0, 1, 2, 3}, {0, 4, 1}, {5, 6, 7, 8}});
        const PolygonSoup turned = transformed(corner, [&](glm::dvec3 p) {
            return glm::dvec3(glm::rotate(glm::dmat4(1.0), -0.8, glm::dvec3(1, 0, 0)) * glm::dvec4(p, 1));
        });
        const double angle = random.real(0, 360), a = glm::radians(angle);
        const Drawing drawn =
            draw_fine(scene_of({placed(turned, angle)}), pixel_camera(kFineSize, kFineSize), kFineSize);
        const glm::dvec2 middle(22.13, kFineSize - 21.86), way(std::cos(a), -std::sin(a));
        EXPECT_EQ(drawn.drawn_share(middle - 11.0 * way, middle + 11.0 * way, 0), 1.0) << "seed " << seed;
    }
}

// A needle at one border of a strip narrower than a sample: the strip's other border is no patch that goes on there.
TEST(FineSlivers, ANarrowStripKeepsItsBorderBesideANeedle) {
    for (const double distance : {2.0, 3.0, 6.0, 12.0}) {
        const auto ink = [&](bool has_needle) {
            const double third = 1.0 / 3, low = 0.05, high = 0.0532;
            PolygonSoup strip = soup_of({{-1, -low, 0},
                                         {-1, -0.0468, 1e-4},
                                         {-third, -third * low, 0},
                                         {-third, 0.0032 - third * low, 1e-4},
                                         {third, third * low, 0},
                                         {third, 0.0032 + third * low, 1e-4},
                                         {1, low, 0},
                                         {1, high, 1e-4},
                                         {0.05, 0.0025, 2e-7}},
                                        {{0, 2, 3}, {0, 3, 1}, {2, 8, 3}, {8, 4, 5}, {8, 5, 3}, {4, 6, 7}, {4, 7, 5}});
            if (has_needle) strip.add_polygon(std::vector<std::uint32_t>{2, 4, 8});
            const Drawing drawn(scene_of({strip}), perspective_camera({0.3, 0.2, distance}, {0, 0, 0}), 160, 120,
                                {0, 0, 160, 120}, 2, render_abuffer);
            double sum = 0;
            for (int y = 0; y < 120; ++y) {
                for (int x = 0; x < 160; ++x) sum += drawn.line(x, y);
            }
            return sum;
        };
        EXPECT_GT(ink(true) / ink(false), 0.98) << distance;
    }
}

}  // namespace
}  // namespace burin::fine_slivers_test
