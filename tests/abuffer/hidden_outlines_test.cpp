// Outlines behind other surfaces, over walls that are seen edge-on or nearly so.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/shapes.h"
#include "tests/support/layers.h"
#include "tests/support/random.h"

namespace burin::hidden_outlines_test {
namespace {

using namespace test;

// Two plates with a wall between them that is seen edge-on, behind a sheet: the wall's upper edge is an outline, once.
// At an outline triangles are seen edge-on, and which of them lies outermost by less than vertices are snapped is
// chance: none of them hides the outline.
TEST(HiddenLines, AnOutlineIsNotHiddenByItsOwnRim) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        const PolygonSoup body = make_torus(1, 0.45, 90, 44);
        const glm::dvec3 eye = 8.0 * random.direction();
        PolygonSoup sheet;
        const glm::dvec3 right = glm::normalize(glm::cross(eye, glm::dvec3(0.1, 1, 0.2))),
                         up = glm::normalize(glm::cross(right, eye));
        for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
            sheet.positions.push_back(0.5 * eye + 5.0 * (corner.x * right + corner.y * up));
        sheet.add_polygon(std::vector<std::uint32_t>{0, 1, 2, 3});
        const Camera camera = perspective_camera(eye, {0, 0, 0});
        const double seen_px = sum(draw(scene_of({body}), camera), "lines.A");
        Scene behind = scene_of({body, sheet});
        behind.lines.style.hidden.style = HiddenStyle::solid;
        EXPECT_GT(Layers(behind, camera).hidden_px(1), seen_px - 2) << "seed " << seed;
    }
}

TEST(HiddenLines, OutlineOverAWallThatIsSeenEdgeOn) {
    const PolygonSoup step = soup_of({{20, 20, 30},
                                      {90.3, 20, 30},
                                      {110.7, 200, 30},
                                      {20, 200, 30},
                                      {90.3, 20, 0},
                                      {110.7, 200, 0},
                                      {200, 20, 0},
                                      {200, 200, 0}},
                                     {{0, 1, 2, 3}, {1, 4, 5, 2}, {4, 6, 7, 5}});
    Scene scene =
        scene_of({step, soup_of({{10, 10, 100}, {230, 10, 100}, {230, 230, 100}, {10, 230, 100}}, {{0, 1, 2, 3}})});
    scene.lines.classes = LineClass::silhouette;
    const Layers layers(scene, pixel_camera(kSize, kSize));
    EXPECT_NEAR(layers.all_hidden_px(), glm::distance(glm::dvec2(90.3, 20), glm::dvec2(110.7, 200)), 0.1);
    EXPECT_NEAR(layers.hidden_px(1), layers.all_hidden_px(), 1e-9);
}

// However many rows the wall has: it brings a walk nowhere. Behind it the surface goes on deeper, or turns back.
TEST(HiddenLines, OutlineOfABodySeenAlongItsWalls) {
    for (const int rows : {1, 3, 20, 60, 600}) {
        for (const bool turns_back : {false, true}) {
            PolygonSoup body;
            const auto corner = [](std::size_t k) {
                return glm::dvec2(k == 0 || k == 3 ? 60.3 : 180.6, k < 2 ? 60.2 : 170.7);
            };
            for (int row = 0; row <= rows; ++row) {
                for (std::size_t k = 0; k < 4; ++k)
                    body.positions.emplace_back(corner(k).x, corner(k).y, 30 - 30.0 * row / rows);
            }
            body.add_polygon(std::vector<std::uint32_t>{0, 1, 2, 3});
            for (std::uint32_t first = 0; first < 4 * static_cast<std::uint32_t>(rows); first += 4) {
                for (std::uint32_t k = 0; k < 4; ++k)
                    body.add_polygon(std::vector<std::uint32_t>{first + k, first + 4 + k, first + 4 + (k + 1) % 4,
                                                                first + (k + 1) % 4});
            }
            const auto last = static_cast<std::uint32_t>(4 * rows), around = last + 4;
            if (turns_back) {
                body.add_polygon(std::vector<std::uint32_t>{last + 3, last + 2, last + 1, last});
            } else {
                for (const auto& [x, y] : {std::pair(20.0, 20.0), {220.0, 20.0}, {220.0, 220.0}, {20.0, 220.0}})
                    body.positions.emplace_back(x, y, 0);
                for (std::uint32_t k = 0; k < 4; ++k)
                    body.add_polygon(
                        std::vector<std::uint32_t>{around + k, around + (k + 1) % 4, last + (k + 1) % 4, last + k});
            }
            Scene scene = scene_of(
                {body, soup_of({{10, 10, 100}, {230, 10, 100}, {230, 230, 100}, {10, 230, 100}}, {{0, 1, 2, 3}})});
            scene.lines.classes = LineClass::silhouette;
            scene.lines.style.hidden.style = HiddenStyle::solid;
            // In the picture: rows that stand for one another may be drawn in one place.
            const double ink = sum(draw(scene, pixel_camera(kSize, kSize)), "lines_hidden.A");
            EXPECT_NEAR(ink, 2 * (120.3 + 110.5), 1) << rows << " rows" << (turns_back ? ", and back" : "");
        }
    }
}

/// A step down along y whose wall leans back by some 1/256 pixel, in rows and columns of triangles, turned around the
/// middle.
PolygonSoup leaning_step(double height, double lean_px, std::uint32_t rows, std::uint32_t columns, double angle) {
    PolygonSoup soup;
    soup.object_names = {"step"};
    for (std::uint32_t j = 0; j <= columns; ++j) {
        const double y = -80 + 160.0 * j / columns;
        soup.positions.emplace_back(-80, y, height);
        for (std::uint32_t i = 0; i <= rows; ++i)
            soup.positions.emplace_back(-lean_px * i / rows, y, height - height * i / rows);
        soup.positions.emplace_back(80, y, 0);
    }
    const std::uint32_t width = rows + 3;
    for (std::uint32_t j = 0; j < columns; ++j) {
        for (std::uint32_t i = 0; i + 1 < width; ++i) {
            const std::uint32_t a = width * j + i;
            soup.add_polygon(std::vector<std::uint32_t>{a, a + 1, a + width + 1});
            soup.add_polygon(std::vector<std::uint32_t>{a, a + width + 1, a + width});
        }
    }
    return transformed(std::move(soup), [=](glm::dvec3 p) {
        return glm::dvec3(120.13 + std::cos(angle) * p.x - std::sin(angle) * p.y,
                          120.86 + std::sin(angle) * p.x + std::cos(angle) * p.y, p.z);
    });
}

// Snapping turns some triangles of such a wall over. The outline is one line, seen or hidden.
TEST(HiddenLines, OutlineOverAWallThatLeansBack) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const auto rows = static_cast<std::uint32_t>(random.integer(1, 4)),
                   columns = static_cast<std::uint32_t>(random.integer(1, 4));
        const PolygonSoup step =
            leaning_step(random.real(8, 50), random.real(0, 3) / 256, rows, columns, random.real(0, 6));
        const auto drawn = [](const std::vector<PolygonSoup>& objects) {
            Scene scene = scene_of(objects);
            scene.lines.classes = LineClass::silhouette;
            scene.lines.style.hidden.style = HiddenStyle::solid;
            return draw(scene, pixel_camera(kSize, kSize));
        };
        const Image seen = drawn({step});
        EXPECT_LT(sum(seen, "lines_hidden.A"), 0.5) << "seed " << seed;
        const PolygonSoup sheet =
            soup_of({{-500, -500, 100}, {500, -500, 100}, {500, 500, 100}, {-500, 500, 100}}, {{0, 1, 2, 3}});
        EXPECT_NEAR(sum(drawn({step, sheet}), "lines_hidden.A"), sum(seen, "lines.A"), 1.5) << "seed " << seed;
    }
}

}  // namespace
}  // namespace burin::hidden_outlines_test
