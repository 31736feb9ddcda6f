// Hidden lines where surfaces are in contact, or nearly so.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/shapes.h"
#include "tests/support/layers.h"
#include "tests/support/random.h"

namespace burin::hidden_contacts_test {
namespace {

using namespace test;

TEST(HiddenContacts, ABorderThatIsASeamInPart) {
    for (const double length : {60.0, 90.0, 110.0, 160.0, 200.0}) {
        std::vector<PolygonSoup> objects{
            soup_of({{20, 100, 0}, {220, 100, 0}, {220, 160, 0}, {20, 160, 0}}, {{0, 1, 2, 3}})};
        constexpr int kPatches = 4;
        for (int i = 0; i < kPatches; ++i) {
            const double from = 20 + length * i / kPatches, to = 20 + length * (i + 1) / kPatches,
                         low = i % 2 == 0 ? 60 : 40;
            const auto first = static_cast<std::uint32_t>(objects[0].positions.size());
            for (const auto& [x, y] : {std::pair(from, low), {to, low}, {to, 100.0}, {from, 100.0}})
                objects[0].positions.emplace_back(x, y, 0);
            objects[0].add_polygon(std::vector<std::uint32_t>{first, first + 1, first + 2, first + 3});
        }
        objects.push_back(soup_of({{10, 10, 100}, {230, 10, 100}, {230, 230, 100}, {10, 230, 100}}, {{0, 1, 2, 3}}));
        const Layers layers(scene_of(objects), pixel_camera(kSize, kSize));
        // Three sides and what is left of the fourth; the patches' lower sides, their first and last, and three steps.
        const double expected = (200 + 60 + 60) + (200 - length) + length + 40 + 60 + 3 * 20;
        EXPECT_NEAR(layers.hidden_px(1, LineClass::border), expected, 0.5) << length;
    }
}

// Borders above each other on the screen, near each other in space for their length, but with a step that is seen.
TEST(HiddenContacts, TreadsOfAStairWithoutRisers) {
    constexpr int kTreads = 5;
    const PolygonSoup roof = soup_of({{5, 5, 200}, {235, 5, 200}, {235, 235, 200}, {5, 235, 200}}, {{0, 1, 2, 3}});
    for (const double step : {3.0, 6.0, 9.5}) {
        for (const double overlap : {-0.4, 0.0, 0.4}) {
            PolygonSoup stair;
            for (int i = 0; i < kTreads; ++i) {
                const double low = 20 + 40 * i, high = low + 40 + overlap, z = step * i;
                const auto first = static_cast<std::uint32_t>(stair.positions.size());
                for (const auto& [x, y] : {std::pair(20.0, low), {220.0, low}, {220.0, high}, {20.0, high}})
                    stair.positions.emplace_back(x, y, z);
                stair.add_polygon(std::vector<std::uint32_t>{first, first + 1, first + 2, first + 3});
            }
            Scene seen = scene_of({stair}), hidden = scene_of({stair, roof});
            seen.lines.classes = hidden.lines.classes = LineClass::border;
            hidden.lines.style.hidden.style = HiddenStyle::solid;
            // Two borders 0.4 px from each other cover 1.4 px. Where sides meet, half pixels are covered twice.
            const double expected =
                200 * (kTreads + 1 + (kTreads - 1) * std::abs(overlap)) + 2 * (kTreads * 40 + overlap);
            EXPECT_NEAR(sum(draw(hidden, pixel_camera(kSize, kSize)), "lines_hidden.A"), expected, 8)
                << "steps of " << step << ", overlap " << overlap;
            if (overlap > 0) continue;  // the lower one of the two is hidden
            EXPECT_NEAR(sum(draw(seen, pixel_camera(kSize, kSize)), "lines.A"), expected, 8)
                << "steps of " << step << ", overlap " << overlap;
        }
    }
}

// What stands on the other side of a floor is hidden from its feet on, wherever edges of the floor's triangles run, and
// whether it is of one mesh with it or not.
TEST(HiddenContacts, WhatStandsOnTheOtherSideOfAFloor) {
    const PolygonSoup box = moved(make_box({80, 80, 60}), {100, 100, -30}),
                      wall = soup_of({{170, 60, 0}, {170, 180, 0}, {170, 180, -50}, {170, 60, -50}}, {{0, 1, 2, 3}});
    const auto floor = [](std::vector<double> columns) {
        PolygonSoup soup;
        for (const double x : columns) {
            for (const double y : {20.0, 220.0}) soup.positions.emplace_back(x, y, 0);
        }
        for (std::uint32_t i = 0; i + 1 < columns.size(); ++i)
            soup.add_polygon(std::vector<std::uint32_t>{2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
        return soup;
    };
    const auto drawn = [](std::vector<PolygonSoup> objects, bool is_one_mesh) {
        if (is_one_mesh) objects = {joined(objects)};
        Scene scene = scene_of(objects);
        scene.lines.classes = LineClassSet(LineClass::border) | LineClass::crease;
        scene.lines.style.hidden.style = HiddenStyle::solid;
        return draw(scene, perspective_camera({120, 90, 500}, {120, 110, 0}, 30));
    };
    // Under a roof all lines are hidden. Where a visible line crosses a hidden one, both have ink.
    constexpr double kCrossings = 12;
    const PolygonSoup roof =
        soup_of({{-500, -500, 300}, {900, -500, 300}, {900, 900, 300}, {-500, 900, 300}}, {{0, 1, 2, 3}});
    // The foot of a wall of its own is a line between objects, which is not asked for here.
    const auto expected = [&](bool is_one_mesh) {
        std::vector<PolygonSoup> objects{floor({20, 220}), box, wall};
        if (is_one_mesh) objects = {joined(objects)};
        objects.push_back(roof);
        return sum(drawn(objects, false), "lines_hidden.A");
    };
    EXPECT_NEAR(expected(true), expected(false) + 105, 3) << "the foot of the wall";
    for (const std::vector<double>& columns : {std::vector<double>{20, 220}, {20, 60, 140, 170, 220}}) {
        for (const bool is_one_mesh : {false, true}) {
            const Image image = drawn({floor(columns), box, wall}, is_one_mesh);
            const double ink = sum(image, "lines.A") + sum(image, "lines_hidden.A");
            EXPECT_NEAR(ink, expected(is_one_mesh), kCrossings) << columns.size() << (is_one_mesh ? ", one mesh" : "");
        }
        // What comes before the floor is seen in it, so the box's outline there is a line between objects, too; the
        // wall is behind the floor all the same.
        const double outline_px = 4 * 80 * (0.5 * kSize / std::tan(glm::radians(15.0))) / 500;
        const Image image = drawn({box, wall, floor(columns)}, false);
        EXPECT_NEAR(sum(image, "lines.A") + sum(image, "lines_hidden.A"), expected(false) - outline_px, kCrossings)
            << columns.size();
        // However the floor is wound.
        PolygonSoup turned;
        const PolygonSoup plain = floor(columns);
        turned.positions = plain.positions;
        for (std::size_t i = 0; i < plain.polygon_count(); ++i) {
            std::vector<std::uint32_t> corners(plain.polygon(i).begin(), plain.polygon(i).end());
            std::reverse(corners.begin() + 1, corners.end());
            turned.add_polygon(corners);
        }
        const Image other = drawn({turned, box, wall}, true);
        EXPECT_NEAR(sum(other, "lines.A") + sum(other, "lines_hidden.A"), expected(true), kCrossings) << columns.size();
    }
}

// An edge that two bodies have in common has the faces in front, as if corners were not shared.
TEST(HiddenContacts, TheFootOfAnUprightAtTheEdgeOfAPlate) {
    const auto bracket = [](double gap) {
        return joined({moved(make_box({2, 1, 2}), {1, 0.5, 1}), moved(make_box({2, 1, 0.5}), {1, 1.5, 0.25 + gap})});
    };
    for (const glm::dvec3 direction : {glm::dvec3(5.77, -5.77, 5.77), {4, -5, 6.5}, {-4, -5.5, 5}}) {
        const glm::dvec3 middle(1, 1, 1);
        Camera camera = perspective_camera(middle + direction, middle);
        camera.orthographic = true;
        camera.height = 4;
        for (const double gap : {0.0, 0.125}) {
            Scene scene = scene_of({bracket(gap)});
            scene.lines.style.hidden.style = HiddenStyle::solid;
            const Image image = draw(scene, camera);
            const Frame frame = make_frame(scene, camera, kSize, kSize, {0, 0, kSize, kSize});
            int found = 0;
            for (int i = 1; i < 20; ++i) {
                const glm::dvec2 at = pixel_of(frame, camera, {0.1 * i, 1, 0.5 + gap});
                double ink = 0;
                for (int y = -1; y <= 1; ++y) {
                    for (int x = -1; x <= 1; ++x)
                        ink = std::max(ink, value(image, "lines_hidden.A", static_cast<int>(at.x) + x,
                                                  static_cast<int>(at.y) + y));
                }
                found += ink > 0.3;
            }
            EXPECT_EQ(found, 19) << direction.x << ", " << gap;
        }
    }
}

// Cells of a heap share edges; walls between them that are seen edge-on are walls all the same.
TEST(HiddenContacts, ANotchOfCellsSeenAlongItsWalls) {
    const auto cell = [](int x, int y, int z) { return moved(make_box({1, 1, 1}), {x + 0.5, y + 0.5, z + 0.5}); };
    const PolygonSoup cells = joined({cell(0, 0, 0), cell(0, 0, 1), cell(0, 0, 2), cell(1, 0, 0), cell(1, 0, 2)});
    for (const double tilt : {0.0, 0.01}) {
        const glm::dvec3 middle(1, 0.5, 1.5);
        Camera camera = perspective_camera(middle + glm::dvec3(tilt, 0, -10), middle);
        camera.orthographic = true;
        camera.height = 4;
        Scene scene = scene_of({cells});
        scene.lines.style.hidden.style = HiddenStyle::solid;
        const Image image = draw(scene, camera);
        // The notch's inner edge, in the middle of the picture: 60 px.
        double ink = 0;
        for (int y = kSize / 2 - 28; y < kSize / 2 + 28; ++y) {
            for (int x = kSize / 2 - 3; x < kSize / 2 + 3; ++x) ink += value(image, "lines_hidden.A", x, y);
        }
        EXPECT_GT(ink, 55) << tilt;  // tilted, its upper and lower edge are a bit apart
    }
}

// What dips below a floor at a third of a degree is hidden from where they meet, not from 1/16 pixel below it.
TEST(HiddenContacts, BeginWhereSurfacesCrossAtASlightAngle) {
    constexpr double kSlope = 0.005;
    const PolygonSoup floor = soup_of({{5, 5, 0}, {235, 5, 0}, {235, 235, 0}, {5, 235, 0}}, {{0, 1, 2, 3}});
    const auto on_ridge = [](double x, double y) { return glm::dvec3(x, y, kSlope * (x - 120)); };
    const PolygonSoup ridge = soup_of(
        {on_ridge(20, 60.3), on_ridge(220, 61.2), {220, 160, -100}, {20, 160, -100}, {220, 20, -40}, {20, 20, -40}},
        {{0, 1, 2, 3}, {1, 0, 5, 4}});
    for (const bool is_one_mesh : {false, true}) {
        Scene scene = scene_of(is_one_mesh ? std::vector{joined({floor, ridge})} : std::vector{floor, ridge});
        scene.lines.classes = LineClass::crease;
        scene.lines.style.hidden.style = HiddenStyle::solid;
        const Image image = draw(scene, pixel_camera(kSize, kSize));
        EXPECT_NEAR(sum(image, "lines_hidden.A"), 100, 1.5) << is_one_mesh;
        double seen_below = 0;
        for (int y = 170; y < 190; ++y) {
            for (int x = 0; x < 119; ++x) seen_below += value(image, "lines.A", x, y);
        }
        EXPECT_NEAR(seen_below, 0, 0.5) << is_one_mesh;
    }
}

// Pages on one fold, nearer to each other than two pixels: their borders run along each other and are no seam.
TEST(HiddenContacts, PagesThatLieOnEachOtherHaveTheirOutline) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        Random random(seed);
        std::vector<glm::dvec3> corners{{0, 0, 0}, {0, 1, 0}};
        std::vector<std::vector<std::uint32_t>> pages;
        const double width = random.real(0.5, 0.8);
        for (const glm::dvec2 end : {glm::dvec2(1, 0), {width, 0}, {-0.5, 0.2}, {width, 0.01}}) {
            const auto first = static_cast<std::uint32_t>(corners.size());
            corners.emplace_back(end.x, 1, end.y);
            corners.emplace_back(end.x, 0, end.y);
            pages.push_back({0, 1, first, first + 1});
        }
        const PolygonSoup book = soup_of(corners, pages);
        const glm::dvec3 middle(0.3, 0.5, 0),
            eye = middle + 2.5 * glm::normalize(glm::dvec3(random.real(-0.5, 0.5), random.real(-0.5, 0.5), 1));
        const Camera camera = perspective_camera(eye, middle);
        const PolygonSoup cover = soup_of({{-3, -3, 1}, {3, -3, 1}, {3, 3, 1}, {-3, 3, 1}}, {{0, 1, 2, 3}});
        const double seen_px = sum(draw(scene_of({book}), camera), "lines.A");
        Scene behind = scene_of({book, cover});
        behind.lines.style.hidden.style = HiddenStyle::solid;
        EXPECT_GT(Layers(behind, camera).hidden_px(1), seen_px - 3) << "seed " << seed;
    }
}

// A border that ends in contact with a surface is no border when it is seen, and none behind a sheet either.
TEST(HiddenContacts, BordersThatEndOnASurfaceAreNone) {
    const PolygonSoup floor = soup_of({{20, 20, 0}, {220, 20, 0}, {220, 220, 0}, {20, 220, 0}}, {{0, 1, 2, 3}});
    const PolygonSoup sheet = soup_of({{0, 0, 50}, {240, 0, 50}, {240, 240, 50}, {0, 240, 50}}, {{0, 1, 2, 3}});
    for (const double tilt : {0.0, 0.1, 0.6, 1.5}) {  // of a ramp: at the steepest there is a crease
        const PolygonSoup ramp = soup_of(
            {{80, 80, 0.3}, {160, 80, 0.3}, {160, 160, 0.3 + 80 * tilt}, {80, 160, 0.3 + 80 * tilt}}, {{0, 1, 2, 3}});
        const double seen = sum(draw(scene_of({joined({floor, ramp})}), pixel_camera(kSize, kSize)), "lines.A");
        Scene behind = scene_of(
            {joined({floor, ramp}), transformed(sheet, [](glm::dvec3 p) { return p + glm::dvec3(0, 0, 100); })});
        behind.lines.style.hidden.style = HiddenStyle::solid;
        EXPECT_NEAR(sum(draw(behind, pixel_camera(kSize, kSize)), "lines_hidden.A"), seen, 2) << tilt;
    }
}

// A sheet in front of another one by less than two pixels has no border either, whatever else there is behind them; but
// a sheet behind a larger one has its border.
TEST(HiddenContacts, ASheetCloselyInFrontOfAnotherHasNoBorder) {
    const auto square = [](double low, double high, double z) {
        return soup_of({{low, low, z}, {high, low, z}, {high, high, z}, {low, high, z}}, {{0, 1, 2, 3}});
    };
    const PolygonSoup cover = square(0, 240, 300);
    const auto hidden_px = [&](const std::vector<PolygonSoup>& sheets) {
        Scene scene = scene_of({joined(sheets), cover});
        scene.lines.style.hidden.style = HiddenStyle::solid;
        const PreparedScene prepared = prepare_for_abuffer(scene, 1);  // else no triangles are left out
        return Layers(scene, pixel_camera(kSize, kSize), 2, &prepared).hidden_px(1);
    };
    for (const double gap : {0.03, 0.07, 0.4, 1.0, 1.9}) {
        EXPECT_NEAR(hidden_px({square(20, 220, 0), square(80, 160, gap)}), 800, 1) << gap;
        EXPECT_NEAR(hidden_px({square(20, 220, 0), square(80, 160, gap), square(200, 210, -50)}), 800, 1) << gap;
    }
    EXPECT_NEAR(hidden_px({square(20, 220, 0), square(80, 160, 2.5)}), 1120, 1);
    for (const double gap : {0.4, 1.0, 1.9}) {
        Scene scene = scene_of({joined({square(20, 220, 0), square(80, 160, -gap)})});
        scene.lines.style.hidden.style = HiddenStyle::solid;
        EXPECT_NEAR(Layers(scene, pixel_camera(kSize, kSize)).hidden_px(1), 320, 1) << gap;
    }
}

// Where a mesh has two polygons in one plane, the edge of one over the other is a line for nobody, whichever comes
// first.
TEST(HiddenContacts, WhatLiesFlatWithinAMeshHasNoOutline) {
    const PolygonSoup floor = soup_of({{20, 20, 0}, {220, 20, 0}, {220, 220, 0}, {20, 220, 0}}, {{0, 1, 2, 3}});
    const PolygonSoup decal = soup_of({{80, 80, 0}, {160, 83, 0}, {163, 160, 0}, {80, 161, 0}}, {{0, 1, 2, 3}});
    for (const auto& soups : {std::vector{floor, decal}, {decal, floor}}) {
        Scene scene = scene_of({joined(soups)});
        scene.lines.style.hidden.style = HiddenStyle::solid;
        const Image image = draw(scene, pixel_camera(kSize, kSize));
        EXPECT_EQ(sum(image, "lines_hidden.A"), 0);
        EXPECT_NEAR(sum(image, "lines.A"), 800, 1);
    }
}

// Cubes of one mesh that share faces, edges and corners: where more than two polygons meet, the ones in front say
// whether there is a line. Behind a sheet the same lines have one layer in front that are seen without it.
TEST(HiddenContacts, CubesThatShareFacesHaveTheLinesThatAreSeen) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        Random random(seed);
        std::vector<PolygonSoup> cubes;
        for (int i = 0; i < 18; ++i) {
            if (random.integer(0, 2) > 0)
                cubes.push_back(moved(make_box({1, 1, 1}), {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 0.5}));
        }
        glm::dvec3 eye;  // where no faces are so narrow that their lines lie on each other
        do eye = 10.0 * random.direction();
        while (std::min({std::abs(eye.x), std::abs(eye.y), std::abs(eye.z)}) < 1.5);
        const Camera camera = ortho_camera(eye, 6);
        PolygonSoup sheet;
        const glm::dvec3 right = glm::normalize(glm::cross(eye, glm::dvec3(0.1, 1, 0.2))),
                         up = glm::normalize(glm::cross(right, eye));
        for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
            sheet.positions.push_back(0.5 * eye + 9.0 * (corner.x * right + corner.y * up));
        }
        sheet.add_polygon(std::vector<std::uint32_t>{0, 1, 2, 3});
        const double seen_px = sum(draw(scene_of({joined(cubes)}), camera), "lines.A");
        Scene behind = scene_of({joined(cubes), sheet});
        behind.lines.style.hidden.style = HiddenStyle::solid;
        EXPECT_NEAR(Layers(behind, camera).hidden_px(1), seen_px, 0.02 * seen_px)
            << "seed " << seed;  // where lines meet, ink counts once
    }
}

TEST(HiddenContacts, BodiesThatStandFlushHideNothingOfEachOther) {
    const PolygonSoup left = moved(make_box({80, 80, 60}), {80, 120, -30}),
                      right = moved(make_box({80, 60, 60}), {160, 110, -30});
    for (const bool is_left_first : {true, false}) {
        Scene scene = scene_of(is_left_first ? std::vector{left, right} : std::vector{right, left});
        scene.lines.style.hidden.style = HiddenStyle::solid;
        const Layers layers(scene, pixel_camera(kSize, kSize));
        double nearest = -1e300;
        for (const WholeLine& line : layers.pass.lines())
            nearest = std::max({nearest, line.nearness_from, line.nearness_to});
        EXPECT_FALSE(layers.pass.parts().empty());
        for (const LinePart& p : layers.pass.parts()) {
            const WholeLine& line = layers.pass.lines()[p.line];
            EXPECT_LT(line.nearness_at(0.5 * (p.begin + p.end)), nearest - 1) << "an edge of the upper faces";
        }
    }
}

}  // namespace
}  // namespace burin::hidden_contacts_test
